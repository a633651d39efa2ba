//! Tests of a ray against eight boxes, eight triangles, eight pieces of curves or points, and analytic shapes, at one lane and in registers.

pub(crate) mod block_tests;
pub(crate) mod joint;
pub(crate) mod lanes8;
pub(crate) mod leaf;
pub(crate) mod line_ray;
mod octahedral;
pub(crate) mod packet_ray;
mod packet_triangles;
pub(crate) mod point_block;
pub(crate) mod prepared;
pub(crate) mod scalar;
pub(crate) mod segment_block;
pub(crate) mod segment_leaves;
mod segments;
pub(crate) mod shape;
pub(crate) mod smooth;
mod smooth_scalar;
pub(crate) mod transform;
pub(crate) mod triangle_block;
pub(crate) mod wide;
