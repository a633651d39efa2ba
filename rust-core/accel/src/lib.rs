//! Ray tracing acceleration: two levels of 8-wide bounding volume hierarchies.
//!
//! A [`Blas`] (bottom-level acceleration structure) holds the triangles of one mesh, a [`Tlas`] (top-level acceleration structure) the instances of
//! many. Incoherent rays traverse the tree alone, eight boxes or triangles at a time, or as a stream of many rays (`stream.rs`) where that is
//! measured to be faster (`stream_tuner.rs`). Coherent rays traverse it in packets of sixteen. All are watertight and find the same nearest hit:
//! boxes are widened by a bound on the rounding errors (`prepared.rs`), triangles are tested by edge functions whose signs are never wrong
//! (`triangle_block.rs`), and equal distances are settled by the lower instance and primitive number.

mod blas;
mod block_tests;
mod build;
mod clusters;
mod collapse;
mod division;
mod emit;
mod flat_tree;
mod hit_callback;
mod instance;
mod join;
mod lanes8;
mod loose_lights;
mod node;
mod packet_query;
mod packet_ray;
mod packet_scene;
mod packet_traverse;
mod part;
mod prepared;
mod query;
mod ray;
mod refit;
mod scalar;
mod shape;
mod stream;
mod stream_ray;
mod stream_tuner;
#[cfg(test)]
mod tests;
mod tlas;
mod tlas_input;
mod top;
mod transform;
mod traverse;
mod traverse_scene;
mod triangle_block;
mod wide;

pub use blas::{Blas, BlasMemory, Care};
pub use block_tests::BlockTests;
pub use instance::{Geometry, Instance};
pub use ray::{Covered, Hits, NONE, RayBatch, TransparentHit};
pub use shape::Shape;
pub use tlas::Tlas;

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
