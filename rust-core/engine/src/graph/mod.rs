//! Node graphs run over batches of hits.

mod evaluate;
mod program;

pub use evaluate::{GraphScratch, OutputColumns, SurfaceColumns, evaluate};
pub use program::{Arithmetic, Output, Program, Source, Step};

/// Hits of one material that are shaded together; the columns of a chunk stay in the first-level cache.
pub const CHUNK: usize = 256;
