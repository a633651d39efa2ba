//! Ray tracing acceleration: TLAS and BLASes, two levels of 8-wide bounding volume hierarchies (BVH).
//!
//! A [`Blas`] (bottom-level acceleration structure) holds the triangles of one mesh, or curves or points, a [`Tlas`] (top-level acceleration structure) the instances of
//! many. In goes a [`RayBatch`], out come [`Hits`] ([`Tlas::first_hit`]) or which rays are blocked ([`Tlas::occluded`]).
//!
//! Coherent rays go in packets of sixteen. Incoherent rays go alone, eight boxes or triangles at a time, or in ray streams
//! (`traverse/stream.rs`) where these are measured to be faster (`traverse/stream_tuner.rs`).
//!
//! All are watertight and find the same nearest hit (closest hit). Boxes are widened by a bound on the rounding errors (`intersect/prepared.rs`). The edge
//! functions of triangles never have a wrong sign (`intersect/triangle_block.rs`). Equal distances go to the lower instance and primitive number.

mod blockers;
mod build;
mod cancelled;
mod hit_callback;
mod intersect;
mod packet_hits;
mod ray;
#[cfg(test)]
mod tests;
mod traverse;
mod tree;

pub use blockers::Blockers;
pub use cancelled::Cancelled;
pub use intersect::block_tests::BlockTests;
pub use intersect::shape::Shape;
pub use ray::{BEFORE_EDGE, Covered, Hits, NONE, Passed, RayBatch, RayMask, TransparentHit};
pub use traverse::beam::{Beam, BeamVisitor};
pub use tree::blas::{Blas, BlasMemory, Care};
pub use tree::instance::{Geometry, Instance};
pub use tree::moving::MovingInstance;
pub use tree::smooth_tree::{FIRST_PIECE, LAST_PIECE, Seen, Spheres};
pub use tree::tlas::Tlas;
