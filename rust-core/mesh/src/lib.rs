//! Polygon meshes of any valence turned into triangle meshes with primvars.
//!
//! Front ends fill a [`PolygonMesh`], call [`PolygonMesh::checked`] to drop what is broken, optionally
//! [`refine::refine`] it, and [`triangulate`] the result. All functions are pure, deterministic and never panic on
//! bad input: what cannot be used is skipped and counted or comes back as a [`MeshProblem`].

mod dice;
mod ear_clip;
mod interpolation;
mod normals;
mod polygon;
mod primvar;
mod problem;
pub mod quadrics;
pub mod refine;
mod smoothing;
mod tangents;
mod triangulate;
mod triangulation;
mod validate;
mod vector;
mod weld;

#[cfg(test)]
mod tests;

pub use dice::{DiceLimits, Diced, DicedTriangle, Undiced, dice};
pub use interpolation::Interpolation;
pub use normals::{corner_normals, facet_normals, smooth_normals};
pub use polygon::PolygonMesh;
pub use primvar::FacePrimvar;
pub use problem::{MeshProblem, Severity};
pub use smoothing::Smoothing;
pub use tangents::corner_tangents;
pub use triangulate::triangulate;
pub use triangulation::Triangulation;
pub use weld::Weld;
