//! `Lanes8` in plain Rust, for the scalar level.

use super::lanes8::Lanes8;
use super::leaf::Leaf;
use super::prepared::{Padded, PreparedRay};
use super::transform::Affine;
use crate::tree::node::{Node, WIDTH};

/// Boxes and leaves in loops over plain numbers.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

impl Lanes8 for Scalar {
    #[inline(always)]
    fn prepare(self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<PreparedRay> {
        PreparedRay::new(origin, direction, t_min, t_max)
    }

    #[inline(always)]
    fn image(self, map: &Affine, ray: &PreparedRay, t_max: f32) -> Option<PreparedRay> {
        PreparedRay::new(map.point(ray.origin), map.direction(ray.direction), ray.t_min, t_max)
    }

    #[inline(always)]
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32 {
        let mut far = [t_max; WIDTH];
        *near = [ray.t_min; WIDTH];
        for axis in 0..3 {
            let near_planes = &node.bounds[ray.near_rows[axis] as usize / WIDTH];
            let far_planes = &node.bounds[ray.far_rows[axis] as usize / WIDTH];
            for slot in 0..WIDTH {
                let enter = near_planes[slot] * ray.reciprocal[axis] + ray.near_offset[axis];
                let leave = far_planes[slot] * ray.reciprocal[axis] + ray.far_offset[axis];
                near[slot] = if enter > near[slot] { enter } else { near[slot] };
                far[slot] = if leave < far[slot] { leave } else { far[slot] };
            }
        }
        let mut mask = 0;
        for slot in 0..WIDTH {
            mask |= u32::from(near[slot] <= far[slot]) << slot;
        }
        mask
    }

    #[inline(always)]
    fn leaf<L: Leaf>(self, leaf: L, ray: &PreparedRay, t_max: f32, found: &mut L::Found) -> u32 {
        leaf.intersect_scalar(ray, t_max, found)
    }
}
