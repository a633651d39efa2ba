//! The inner operations of traversal with one ray, at the width of the data.

use super::line_ray::SmoothHits;
use super::prepared::{Padded, PreparedRay};
use super::smooth::SmoothLeaf;
use super::transform::Affine;
use super::triangle_block::{BlockHits, TriangleBlock};
use crate::tree::node::{Node, WIDTH};

/// Making a ray ready, and testing it against the eight boxes of a node, and against the eight triangles of a block.
pub(crate) trait Lanes8: Copy {
    /// [`PreparedRay::new`].
    fn prepare(self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<PreparedRay>;

    /// The image of a ray, made ready up to `t_max`.
    fn image(self, map: &Affine, ray: &PreparedRay, t_max: f32) -> Option<PreparedRay>;

    /// The slots whose boxes the ray meets up to `t_max`, as a mask; `near` receives the distances to all boxes.
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32;

    /// The triangles hit with `ray.t_min < t <= t_max`, as a mask; `hits` receives their distances and barycentric coordinates.
    fn triangles(self, block: &TriangleBlock, ray: &PreparedRay, t_max: f32, hits: &mut BlockHits) -> u32;

    /// The pieces of curves or points of a leaf hit with `ray.t_min < t <= t_max`, as a mask.
    fn smooth(self, leaf: SmoothLeaf<'_>, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32;
}
