//! Ray tracing acceleration: two levels of 8-wide bounding volume hierarchies.
//!
//! A [`Blas`] holds the triangles of one mesh, a [`SceneBvh`] the instances of many. Incoherent rays walk the tree each its own way, eight
//! boxes or triangles at a time, many of them under way at once (`stream.rs`) where that is found to be faster (`trial.rs`); coherent rays walk
//! it in packets of sixteen. All walks are watertight and find the same nearest hit: boxes are widened by a bound on the rounding errors
//! (`prepared.rs`), triangles are tested by edge functions whose signs are never wrong (`triangle_block.rs`), and equal distances are settled by
//! the lower instance and primitive number.

mod apart;
mod blas;
mod block_tests;
mod build;
mod clusters;
mod collapse;
mod collector;
mod division;
mod emit;
mod flat_tree;
mod flight;
mod instance;
mod instance_walk;
mod join;
mod lanes8;
mod node;
mod packet;
mod packet_query;
mod packet_ray;
mod packet_walk;
mod part;
mod placement;
mod prepared;
mod query;
mod ray;
mod refit;
mod scalar;
mod scene_bvh;
mod shape;
mod stream;
#[cfg(test)]
mod tests;
mod top;
mod transform;
mod trial;
mod triangle_block;
mod walk;
mod wide;

pub use blas::{Blas, BlasMemory, Care};
pub use block_tests::BlockTests;
pub use instance::{Geometry, Instance};
pub use ray::{Covered, Hits, NONE, PassedHit, RayBatch};
pub use scene_bvh::SceneBvh;
pub use shape::Shape;

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
