//! How finely a mesh is cut when the scene is compiled.

use serde::{Deserialize, Serialize};

/// Triangles cut until their edges are short enough.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Dicing {
    /// Longest edges in pixels of the camera that renders.
    pub pixels: f32,
    /// Longest edges in units of the mesh's space; above 0 it counts in place of the pixels.
    pub length: f32,
    /// How often an edge is cut in two at most.
    pub levels: u32,
    /// Whether new points lie on curves through the points with their normals, as of a subdivision surface; else on the triangles.
    pub smooth: bool,
}

impl Default for Dicing {
    fn default() -> Self {
        Self { pixels: 1.0, length: 0.0, levels: Self::MOST_LEVELS, smooth: true }
    }
}

impl Dicing {
    /// Most levels.
    pub const MOST_LEVELS: u32 = 12;
}
