//! Ray tracing acceleration: two levels of 8-wide bounding volume hierarchies.
//!
//! A [`Blas`] (bottom-level acceleration structure) holds the triangles of one mesh, a [`Tlas`] (top-level acceleration structure) the instances of
//! many. Incoherent rays traverse the tree alone, eight boxes or triangles at a time, or as a stream of many rays (`stream.rs`) where that is
//! measured to be faster (`stream_tuner.rs`). Coherent rays traverse it in packets of sixteen. All are watertight and find the same nearest hit:
//! boxes are widened by a bound on the rounding errors (`prepared.rs`), triangles are tested by edge functions whose signs are never wrong
//! (`triangle_block.rs`), and equal distances are settled by the lower instance and primitive number.

mod build;
mod hit_callback;
mod intersect;
mod ray;
#[cfg(test)]
mod tests;
mod traverse;
mod tree;

pub use intersect::block_tests::BlockTests;
pub use intersect::shape::Shape;
pub use ray::{Covered, Hits, NONE, RayBatch, TransparentHit};
pub use tree::blas::{Blas, BlasMemory, Care};
pub use tree::instance::{Geometry, Instance};
pub use tree::tlas::Tlas;

use std::sync::atomic::{AtomicBool, Ordering};

/// The build was cancelled through its flag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

impl Cancelled {
    /// Fails once the flag is set.
    fn check(cancel: &AtomicBool) -> Result<(), Cancelled> {
        if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }
}

impl std::fmt::Display for Cancelled {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("cancelled")
    }
}

impl std::error::Error for Cancelled {}
