//! Displacement: how far a material's surface lies off the mesh.

use gonio_nodes::Input;
use serde::{Deserialize, Serialize};

/// What a displacement's value stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum DisplacementKind {
    /// A height along the smooth normal, in units of the mesh's space.
    #[default]
    Height,
    /// A vector in units of the mesh's space: along the tangent of the first texture coordinate, across it, and along the normal.
    Tangent,
    /// A vector in the mesh's space.
    Object,
    /// A vector in the world, metres.
    World,
}

/// How far points of the mesh move before anything is traced.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Displacement {
    /// The height, or the vector.
    pub value: Input,
    /// What it stands for.
    pub kind: DisplacementKind,
    /// The value at which nothing moves.
    pub midlevel: f32,
    /// Multiplies what the value is beyond the midlevel.
    pub scale: f32,
    /// Whether shading normals stay those of the mesh as it was, because the material bends them by the same heights.
    pub keep_normals: bool,
}

impl Default for Displacement {
    fn default() -> Self {
        Self { value: Input::Constant([0.0; 4]), kind: DisplacementKind::default(), midlevel: 0.0, scale: 1.0, keep_normals: false }
    }
}

impl Displacement {
    /// Whether it moves nothing anywhere.
    pub fn is_nothing(&self) -> bool {
        let at_rest = |value: [f32; 4]| value[..3].iter().all(|x| *x == self.midlevel);
        self.scale == 0.0 || matches!(self.value, Input::Constant(value) if at_rest(value))
    }
}
