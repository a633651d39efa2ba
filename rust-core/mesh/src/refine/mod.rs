//! Uniform subdivision of polygon meshes: Catmull-Clark, Loop and bilinear, with creases, to a level and on to the limit
//! surface. The rules are those of UsdGeomMesh and OpenSubdiv 3.

mod bilinear;
mod catmull_clark;
mod face_varying;
mod limit_normals;
mod loop_scheme;
mod mask;
mod options;
mod pipeline;
mod result;
mod sector;
mod sharpness;
mod split;
mod stage;
mod topology;

pub use options::{BoundaryInterpolation, Creases, FaceVaryingInterpolation, RefineOptions, Scheme, TriangleRule};
pub use pipeline::refine;
pub use result::{RefineError, Refined};
