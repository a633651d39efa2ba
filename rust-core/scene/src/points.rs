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

/// Places of points at one time of the shutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointKey {
    /// As many as there are at the frame, local units.
    #[serde(with = "super::blob")]
    pub points: Arc<[[f32; 3]]>,
}

/// What is wrong with the keys of curves or points, of which there are so many; no keys at all are right.
pub fn point_key_problem(keys: &[PointKey], count: usize) -> Option<String> {
    if keys.is_empty() {
        return None;
    }
    if keys.len() < 2 {
        return Some("one motion key was found, expected two or more".into());
    }
    if let Some(key) = keys.iter().find(|key| key.points.len() != count) {
        return Some(format!("a motion key has {} points, expected {count}", key.points.len()));
    }
    let finite = keys.iter().all(|key| key.points.as_flattened().iter().all(|x| x.is_finite()));
    (!finite).then(|| "a motion key is not finite".into())
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
    /// Centres at evenly spaced times over the shutter, two or more; empty where they stand still.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<PointKey>,
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
        self.points.len() * 12 * (1 + self.motion.len()) + primvars.map(Primvar::memory).sum::<usize>()
    }
}
