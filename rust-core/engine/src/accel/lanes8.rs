//! The two inner operations of a walk with one ray, at the width of the data.

use super::node::{Node, WIDTH};
use super::prepared::PreparedRay;
use super::triangle_block::{BlockHits, TriangleBlock};

/// Tests of one ray against the eight boxes of a node, and against the eight triangles of a block.
pub(super) trait Lanes8: Copy {
    /// The slots whose boxes the ray meets up to `t_max`, as a mask; `near` receives the distances to all boxes.
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32;

    /// The triangles hit with `ray.t_min < t <= t_max`, as a mask; `hits` receives their distances and barycentric coordinates.
    fn triangles(self, block: &TriangleBlock, ray: &PreparedRay, t_max: f32, hits: &mut BlockHits) -> u32;
}
