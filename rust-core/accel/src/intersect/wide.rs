//! `Lanes8` in vector registers.

use super::lanes8::Lanes8;
use super::leaf::Leaf;
use super::prepared::{Padded, PreparedRay};
use super::transform::Affine;
use crate::tree::node::{Node, WIDTH};
use fearless_simd::{f32x4, f32x8, mask32x8, prelude::*};

/// Eight lanes of a vector level.
#[derive(Clone, Copy)]
pub(crate) struct Wide<S: Simd>(pub(crate) S);

impl<S: Simd> Lanes8 for Wide<S> {
    #[inline(always)]
    fn prepare(self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<PreparedRay> {
        let simd = self.0;
        let mut ray = PreparedRay::NOTHING;
        let [origin, direction] = [f32x4::from_slice(simd, &origin), f32x4::from_slice(simd, &direction)];
        ray.prepare(simd, origin, direction, t_min, t_max).then_some(ray)
    }

    #[inline(always)]
    fn image(self, map: &Affine, ray: &PreparedRay, t_max: f32) -> Option<PreparedRay> {
        let [origin, direction] = map.images(self.0, &ray.origin, &ray.direction);
        let mut image = PreparedRay::NOTHING;
        image.prepare(self.0, origin, direction, ray.t_min, t_max).then_some(image)
    }

    #[inline(always)]
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32 {
        let (enter, met) = intersect_boxes(self.0, node, ray, t_max);
        enter.store_slice(near);
        met.to_bitmask() as u32
    }

    #[inline(always)]
    fn leaf<L: Leaf>(self, leaf: L, ray: &PreparedRay, t_max: f32, found: &mut L::Found) -> u32 {
        leaf.intersect(self.0, ray, t_max, found)
    }
}

/// Distances to the boxes of a node, and those that the ray meets.
#[inline(always)]
pub(crate) fn intersect_boxes<S: Simd>(simd: S, node: &Node, ray: &PreparedRay, t_max: f32) -> (f32x8<S>, mask32x8<S>) {
    let numbers = node.numbers();
    let [x, y, z, _] = ray.near_rows;
    let [fx, fy, fz, _] = ray.far_rows;
    let enter_x = plane(simd, numbers, x, ray.reciprocal[0], ray.near_offset[0]);
    let enter_y = plane(simd, numbers, y, ray.reciprocal[1], ray.near_offset[1]);
    let enter_z = plane(simd, numbers, z, ray.reciprocal[2], ray.near_offset[2]);
    let leave_x = plane(simd, numbers, fx, ray.reciprocal[0], ray.far_offset[0]);
    let leave_y = plane(simd, numbers, fy, ray.reciprocal[1], ray.far_offset[1]);
    let leave_z = plane(simd, numbers, fz, ray.reciprocal[2], ray.far_offset[2]);
    let enter = enter_x.max(enter_y).max(enter_z.max(f32x8::splat(simd, ray.t_min)));
    let leave = leave_x.min(leave_y).min(leave_z.min(f32x8::splat(simd, t_max)));
    (enter, enter.simd_le(leave))
}

/// Distances to one plane of each box.
#[inline(always)]
fn plane<S: Simd>(simd: S, numbers: &[f32; 8 * WIDTH], row: u32, reciprocal: f32, offset: f32) -> f32x8<S> {
    // The mask says that eight numbers follow, so that nothing has to be checked.
    f32x8::from_slice(simd, &numbers[(row & 56) as usize..][..WIDTH]).mul_add(f32x8::splat(simd, reciprocal), f32x8::splat(simd, offset))
}
