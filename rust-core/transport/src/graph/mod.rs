//! Node graphs run over batches of hits.

mod arithmetic;
mod columns;
mod curve;
mod evaluate;
mod light_path;
mod normals;
mod program;
mod shading;
mod vector;

pub use columns::{GraphScratch, OutputColumns, SurfaceColumns};
pub use curve::Curve;
pub use evaluate::evaluate;
pub use light_path::LightPathValue;
pub use program::{Arithmetic, HitValue, Output, Program, Quantity, Source, Step, VectorOperation};

/// Hits of one material that are shaded together; the columns of a chunk stay in the first-level cache.
pub const CHUNK: usize = 256;
