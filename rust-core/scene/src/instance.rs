//! Placed geometry.

use super::{CurvesId, Linking, MaterialId, MatteName, MeshId, Origin, PointsId, Primvar, Transform};
use serde::{Deserialize, Serialize};

/// Which rays see an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Visibility {
    /// Seen by camera rays.
    pub camera: bool,
    /// Blocks shadow rays.
    pub shadow: bool,
    /// Seen by diffusely scattered rays.
    pub diffuse: bool,
    /// Seen by rays of glossy reflection.
    pub glossy: bool,
    /// Seen by rays of transmission.
    pub transmission: bool,
    /// Seen by rays that media scattered.
    #[serde(default = "seen")]
    pub volume: bool,
}

fn seen() -> bool {
    true
}

impl Default for Visibility {
    fn default() -> Self {
        Self { camera: true, shadow: true, diffuse: true, glossy: true, transmission: true, volume: true }
    }
}

impl Visibility {
    /// Whether scattered rays of any kind see it.
    pub fn scattered(&self) -> bool {
        self.diffuse || self.glossy || self.transmission || self.volume
    }
}

/// What is placed; described as the number of a mesh, or as `{"curves": number}` or `{"points": number}`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Geometry {
    /// A triangle mesh.
    Mesh(MeshId),
    /// Curves.
    Curves {
        /// Their number.
        curves: CurvesId,
    },
    /// Points.
    Points {
        /// Their number.
        points: PointsId,
    },
}

impl Geometry {
    /// The mesh, if it is one.
    pub fn mesh(self) -> Option<MeshId> {
        match self {
            Self::Mesh(mesh) => Some(mesh),
            Self::Curves { .. } | Self::Points { .. } => None,
        }
    }
}

impl From<MeshId> for Geometry {
    fn from(mesh: MeshId) -> Self {
        Self::Mesh(mesh)
    }
}

impl From<CurvesId> for Geometry {
    fn from(curves: CurvesId) -> Self {
        Self::Curves { curves }
    }
}

impl From<PointsId> for Geometry {
    fn from(points: PointsId) -> Self {
        Self::Points { points }
    }
}

/// One mesh, or curves or points, placed once or many times, with the same materials.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Instances {
    /// Where they came from.
    pub origin: Origin,
    /// What is placed.
    #[serde(rename = "mesh")]
    pub geometry: Geometry,
    /// A material for each slot of a mesh, or the one of curves or points; missing ones give the default material.
    pub materials: Vec<MaterialId>,
    /// Local to world, metres, one an instance.
    pub transforms: Vec<Transform>,
    /// The same at evenly spaced times over the shutter, two or more; empty where they stand still.
    #[serde(default)]
    pub motion: Vec<Vec<Transform>>,
    /// Named values of the placement (`Constant`: one for all; `Uniform`: one an instance) that stand in where the mesh has none of the name.
    pub primvars: Vec<Primvar>,
    /// Which rays see them.
    pub visibility: Visibility,
    /// Cuts a hole into the coverage where the camera sees it.
    #[serde(default)]
    pub holdout: bool,
    /// Shows the camera nothing but how much darker the other objects make it.
    #[serde(default)]
    pub shadow_catcher: bool,
    /// Cosine under which grazing light starts from the surface that smooth normals tell of, not from the triangles; 0 is never.
    #[serde(default)]
    pub shadow_terminator: f32,
    /// What the object index pass shows.
    #[serde(default)]
    pub pass_index: u32,
    /// The light group that what they emit belongs to.
    #[serde(default)]
    pub light_group: String,
    /// What is lit by what they emit, and what casts shadows of it.
    #[serde(default, skip_serializing_if = "Linking::is_whole")]
    pub linking: Linking,
    /// What the placements are called in mattes, first placements rising from 0; empty where all are called after the origin.
    #[serde(default)]
    pub matte_names: Vec<MatteName>,
}

impl Instances {
    /// Placements that stand still, that all rays see, and that nothing else is said of.
    pub fn new(origin: Origin, geometry: impl Into<Geometry>, materials: Vec<MaterialId>, transforms: Vec<Transform>) -> Self {
        Self {
            origin,
            geometry: geometry.into(),
            materials,
            transforms,
            motion: Vec::new(),
            primvars: Vec::new(),
            visibility: Visibility::default(),
            holdout: false,
            shadow_catcher: false,
            shadow_terminator: 0.0,
            pass_index: 0,
            light_group: String::new(),
            linking: Linking::default(),
            matte_names: Vec::new(),
        }
    }
}
