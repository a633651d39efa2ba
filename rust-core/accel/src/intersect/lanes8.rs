//! The inner operations of traversal with one ray, at the width of the data.

use super::leaf::Leaf;
use super::prepared::{Padded, PreparedRay};
use super::transform::Affine;
use crate::tree::node::{Node, WIDTH};

/// Making a ray ready, and testing it against the eight boxes of a node, and against the primitives of a leaf.
pub(crate) trait Lanes8: Copy {
    /// [`PreparedRay::new`].
    fn prepare(self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<PreparedRay>;

    /// The image of a ray, made ready up to `t_max`.
    fn image(self, map: &Affine, ray: &PreparedRay, t_max: f32) -> Option<PreparedRay>;

    /// The slots whose boxes the ray meets up to `t_max`, as a mask; `near` receives the distances to all boxes.
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32;

    /// The primitives of a leaf hit with `ray.t_min < t <= t_max`, as a mask; `found` receives what the test finds of each.
    fn leaf<L: Leaf>(self, leaf: L, ray: &PreparedRay, t_max: f32, found: &mut L::Found) -> u32;
}
