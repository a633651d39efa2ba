//! Placed meshes.

use super::{MaterialId, MeshId, Origin, Primvar, Transform};
use serde::{Deserialize, Serialize};

/// Which rays see an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Visibility {
    /// Seen by camera rays.
    pub camera: bool,
    /// Blocks shadow rays.
    pub shadow: bool,
    /// Seen by scattered rays.
    pub indirect: bool,
}

impl Default for Visibility {
    fn default() -> Self {
        Self { camera: true, shadow: true, indirect: true }
    }
}

/// One mesh placed once or many times, with the same materials.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Instances {
    /// Where they came from.
    pub origin: Origin,
    /// What is placed.
    pub mesh: MeshId,
    /// A material for each slot of the mesh; missing ones give the default material.
    pub materials: Vec<MaterialId>,
    /// Local to world, metres, one an instance.
    pub transforms: Vec<Transform>,
    /// Named values of the placement (`Constant`: one for all; `Uniform`: one an instance) that stand in where the mesh has none of the name.
    pub primvars: Vec<Primvar>,
    /// Which rays see them.
    pub visibility: Visibility,
}
