//! Ray tracing acceleration: two levels of 8-wide bounding volume hierarchies.
//!
//! A [`Blas`] (bottom-level acceleration structure) holds the triangles of one mesh, a [`Tlas`] (top-level acceleration structure) the instances of
//! many. Incoherent rays traverse the tree alone, eight boxes or triangles at a time, or as a stream of many rays (`stream.rs`) where that is
//! measured to be faster (`stream_tuner.rs`). Coherent rays traverse it in packets of sixteen. All are watertight and find the same nearest hit:
//! boxes are widened by a bound on the rounding errors (`prepared.rs`), triangles are tested by edge functions whose signs are never wrong
//! (`triangle_block.rs`), and equal distances are settled by the lower instance and primitive number.

mod build;
mod cancelled;
mod hit_callback;
mod intersect;
mod ray;
#[cfg(test)]
mod tests;
mod traverse;
mod tree;

pub use cancelled::Cancelled;
pub use intersect::block_tests::BlockTests;
pub use intersect::shape::Shape;
pub use ray::{Covered, Hits, NONE, RayBatch, TransparentHit};
pub use tree::blas::{Blas, BlasMemory, Care};
pub use tree::instance::{Geometry, Instance};
pub use tree::tlas::Tlas;
