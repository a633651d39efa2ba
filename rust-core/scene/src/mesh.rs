//! Triangle meshes with named values.

use super::{Dicing, Origin};
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
    /// Whether both are called alike and hold the very same arrays.
    pub fn holds_arrays_of(&self, other: &Self) -> bool {
        (&self.name, self.interpolation, self.components) == (&other.name, other.interpolation, other.components)
            && Arc::ptr_eq(&self.values, &other.values)
            && address(self.indices.as_deref()) == address(other.indices.as_deref())
    }
    /// Bytes held by the arrays.
    pub fn memory(&self) -> usize {
        self.values.len() * 4 + self.indices.as_ref().map_or(0, |i| i.len() * 4)
    }
}

fn address<T>(array: Option<&[T]>) -> Option<usize> {
    array.map(|array| array.as_ptr().addr())
}

/// A mesh at one time of the shutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshKey {
    /// Points, as many as the mesh has.
    #[serde(with = "super::blob")]
    pub points: Arc<[[f32; 3]]>,
    /// Values of the shading normals, as many as the mesh has; `None` leaves those as they are.
    #[serde(default, with = "super::blob::optional")]
    pub normals: Option<Arc<[f32]>>,
}

/// A triangle mesh in its own space.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Mesh {
    /// Where it came from.
    pub origin: Origin,
    /// Points, local units.
    #[serde(with = "super::blob")]
    pub points: Arc<[[f32; 3]]>,
    /// The mesh at evenly spaced times over the shutter, two or more; empty where it keeps its form.
    #[serde(default)]
    pub motion: Vec<MeshKey>,
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
    /// How finely it is cut when the scene is compiled; `None` leaves it as it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dicing: Option<Dicing>,
}

impl Mesh {
    /// A box between two corners, whose faces look outwards.
    pub fn of_box(min: [f32; 3], max: [f32; 3]) -> Self {
        let corner = |n: usize| [0, 1, 2].map(|axis| [min, max][n >> axis & 1][axis]);
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Self { points: (0..8).map(corner).collect(), triangles: triangles.into(), ..Self::default() }
    }
    /// What is wrong with the keys; no keys at all are right.
    pub fn key_problem(&self) -> Option<String> {
        if self.motion.is_empty() {
            return None;
        }
        let (points, values) = (self.points.len(), self.normals.as_ref().map_or(0, |normals| normals.values.len()));
        let fits = |key: &&MeshKey| key.points.len() == points && key.normals.as_ref().is_none_or(|normals| normals.len() == values);
        if self.motion.len() < 2 {
            return Some("one motion key was found, expected two or more".into());
        }
        if !self.motion.iter().all(|key| fits(&key)) {
            return Some("motion keys have other numbers of points or normals than the mesh".into());
        }
        let finite = self.motion.iter().all(|key| key.points.as_flattened().iter().all(|x| x.is_finite()));
        (!finite).then(|| "a motion key is not finite".into())
    }
    /// Whether both hold the very same arrays, and are diced alike.
    pub fn holds_arrays_of(&self, other: &Self) -> bool {
        let same_normals = match (&self.normals, &other.normals) {
            (Some(a), Some(b)) => a.holds_arrays_of(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        let same_key = |(a, b): (&MeshKey, &MeshKey)| {
            Arc::ptr_eq(&a.points, &b.points) && address(a.normals.as_deref()) == address(b.normals.as_deref())
        };
        same_normals
            && Arc::ptr_eq(&self.points, &other.points)
            && Arc::ptr_eq(&self.triangles, &other.triangles)
            && address(self.slots.as_deref()) == address(other.slots.as_deref())
            && self.dicing == other.dicing
            && (self.motion.len(), self.primvars.len()) == (other.motion.len(), other.primvars.len())
            && self.motion.iter().zip(&other.motion).all(same_key)
            && self.primvars.iter().zip(&other.primvars).all(|(a, b)| a.holds_arrays_of(b))
    }
    /// The primvar called `name`.
    pub fn primvar(&self, name: &str) -> Option<&Primvar> {
        self.primvars.iter().find(|primvar| primvar.name == name)
    }
    /// Bytes held by the arrays.
    pub fn memory(&self) -> usize {
        self.points.len() * 12
            + self.triangles.len() * 12
            + self.normals.iter().chain(&self.primvars).map(Primvar::memory).sum::<usize>()
            + self.motion.iter().map(|key| key.points.len() * 12 + key.normals.as_ref().map_or(0, |n| n.len() * 4)).sum::<usize>()
            + self.slots.as_ref().map_or(0, |s| s.len() * 2)
            + self.faces.as_ref().map_or(0, |f| f.len() * 4)
    }
}
