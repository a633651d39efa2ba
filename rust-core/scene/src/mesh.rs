//! Triangle meshes with named values.

use super::Origin;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a primvar's values belong to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum PrimvarInterpolation {
    /// One value for the mesh.
    #[default]
    Constant,
    /// One value a triangle, or a curve.
    Uniform,
    /// One value a joint of a curve's spans; elsewhere one a point.
    Varying,
    /// One value a point.
    Vertex,
    /// One value a triangle corner, three a triangle.
    FaceVarying,
}

/// Named values on a mesh, 1 to 4 floats each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Primvar {
    /// The name without prefix: `st`, `displayColor`.
    pub name: String,
    /// What the values belong to.
    pub interpolation: PrimvarInterpolation,
    /// Floats a value, 1 to 4.
    pub components: u8,
    /// The values, `components` floats each.
    #[serde(with = "super::blob")]
    pub values: Arc<[f32]>,
    /// Index into the values for each element; `None` means in order.
    #[serde(default, with = "super::blob::optional")]
    pub indices: Option<Arc<[u32]>>,
}

impl Primvar {
    /// One float for all.
    pub fn constant(name: &str, value: f32) -> Self {
        Self { name: name.to_owned(), components: 1, values: Arc::from([value]), ..Self::default() }
    }
    /// Bytes held by the arrays.
    pub fn memory(&self) -> usize {
        self.values.len() * 4 + self.indices.as_ref().map_or(0, |i| i.len() * 4)
    }
}

/// A triangle mesh in its own space.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Mesh {
    /// Where it came from.
    pub origin: Origin,
    /// Points, local units.
    #[serde(with = "super::blob")]
    pub points: Arc<[[f32; 3]]>,
    /// Point indices, counter-clockwise seen from the front.
    #[serde(with = "super::blob")]
    pub triangles: Arc<[[u32; 3]]>,
    /// Shading normals (three components, `Vertex` or `FaceVarying`); `None` means the triangles are flat.
    pub normals: Option<Primvar>,
    /// Other named values; texture coordinates among them.
    pub primvars: Vec<Primvar>,
    /// Material slot of each triangle; `None` means slot 0.
    #[serde(default, with = "super::blob::optional")]
    pub slots: Option<Arc<[u16]>>,
    /// Face of the source mesh for each triangle; `None` means the triangle's own number.
    #[serde(default, with = "super::blob::optional")]
    pub faces: Option<Arc<[u32]>>,
}

impl Mesh {
    /// The primvar called `name`.
    pub fn primvar(&self, name: &str) -> Option<&Primvar> {
        self.primvars.iter().find(|primvar| primvar.name == name)
    }
    /// Bytes held by the arrays.
    pub fn memory(&self) -> usize {
        self.points.len() * 12
            + self.triangles.len() * 12
            + self.normals.iter().chain(&self.primvars).map(Primvar::memory).sum::<usize>()
            + self.slots.as_ref().map_or(0, |s| s.len() * 2)
            + self.faces.as_ref().map_or(0, |f| f.len() * 4)
    }
}
