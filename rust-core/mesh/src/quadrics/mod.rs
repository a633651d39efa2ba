//! The shapes of UsdGeom as polygon meshes, with face-varying `normals` (exact) and `st`, wound outward.
//!
//! Sizes are taken as absolute values; NaN counts as 0. Shapes of revolution have `segments` faces around, 3 to 4096.

mod capsule;
mod cube;
mod cylinder;
mod lathe;
mod plane;
mod sphere;

pub use capsule::capsule;
pub use cube::cube;
pub use cylinder::{cone, cylinder};
pub use plane::plane;
pub use sphere::sphere;

use super::vector::Vec3;
use super::{FacePrimvar, Interpolation};

/// The axis a shape stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Along +X.
    X,
    /// Along +Y.
    Y,
    /// Along +Z.
    #[default]
    Z,
}

impl Axis {
    /// Turns a vector of a shape that stands on Z: a cyclic exchange, so that handedness stays.
    fn turn(self, [x, y, z]: Vec3) -> Vec3 {
        match self {
            Self::X => [z, x, y],
            Self::Y => [y, z, x],
            Self::Z => [x, y, z],
        }
    }
}

/// A size as the shapes use it.
fn extent(value: f32) -> f32 {
    if value.is_finite() { value.abs() } else { 0.0 }
}

/// The primvars `normals` and `st` of one element per face corner.
fn surface_primvars(normals: Vec<Vec3>, st: Vec<[f32; 2]>) -> Vec<FacePrimvar> {
    let face_varying = |name: &str, components, values| FacePrimvar {
        name: name.into(),
        interpolation: Interpolation::FaceVarying,
        components,
        values,
        indices: None,
    };
    vec![face_varying("normals", 3, normals.into_flattened()), face_varying("st", 2, st.into_flattened())]
}
