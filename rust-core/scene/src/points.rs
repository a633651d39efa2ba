//! Points with a size: particles and point clouds.

use super::{Origin, Primvar};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What is seen of points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum PointShape {
    /// Spheres.
    #[default]
    Sphere,
    /// Flat discs that face each ray.
    Disc,
}

/// Points in their own space.
///
/// Elements of primvars: `Constant` and `Uniform` one value; `Varying` and `Vertex` one a point.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Points {
    /// Where they came from.
    pub origin: Origin,
    /// Centres, local units.
    #[serde(with = "super::blob")]
    pub points: Arc<[[f32; 3]]>,
    /// Diameters, local units: one component.
    pub widths: Primvar,
    /// Shading normals (three components, one a point) in place of those of the shape.
    #[serde(default)]
    pub normals: Option<Primvar>,
    /// What is seen.
    pub shape: PointShape,
    /// Other named values.
    pub primvars: Vec<Primvar>,
}

impl Points {
    /// The primvar called `name`.
    pub fn primvar(&self, name: &str) -> Option<&Primvar> {
        self.primvars.iter().find(|primvar| primvar.name == name)
    }
    /// Bytes held by the arrays.
    pub fn memory(&self) -> usize {
        let primvars = std::iter::once(&self.widths).chain(&self.normals).chain(&self.primvars);
        self.points.len() * 12 + primvars.map(Primvar::memory).sum::<usize>()
    }
}
