//! Tests of a ray against eight boxes, eight triangles and analytic shapes, at one lane and in registers.

pub(crate) mod block_tests;
pub(crate) mod lanes8;
pub(crate) mod prepared;
pub(crate) mod scalar;
pub(crate) mod shape;
pub(crate) mod transform;
pub(crate) mod triangle_block;
pub(crate) mod wide;
