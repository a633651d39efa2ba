//! `Lanes8` in vector registers.

use super::lanes8::Lanes8;
use super::line_ray::SmoothHits;
use super::prepared::{Padded, PreparedRay};
use super::smooth::SmoothLeaf;
use super::transform::Affine;
use super::triangle_block::{BlockHits, TriangleBlock};
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
    fn triangles(self, block: &TriangleBlock, ray: &PreparedRay, t_max: f32, hits: &mut BlockHits) -> u32 {
        let simd = self.0;
        let sheared = ShearedRay::new(simd, ray);
        let numbers = block.numbers();
        let a = sheared.corner(simd, numbers, 0);
        let b = sheared.corner(simd, numbers, 1);
        let c = sheared.corner(simd, numbers, 2);
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let inside = u.min(v).min(w).simd_ge(0.0) | u.max(v).max(w).simd_le(0.0);
        // No early way out where none is inside: nobody foresees that branch, and it costs more than this division.
        let inverse = f32x8::splat(simd, 1.0) / (u + v + w);
        let t = u.mul_add(a[2], v.mul_add(b[2], w * c[2])) * inverse * ray.shear[2];
        let hit = inside & t.simd_gt(ray.t_min) & t.simd_le(t_max);
        t.store_slice(&mut hits.t);
        (v * inverse).store_slice(&mut hits.u);
        (w * inverse).store_slice(&mut hits.v);
        hit.to_bitmask() as u32
    }

    #[inline(always)]
    fn smooth(self, leaf: SmoothLeaf<'_>, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
        leaf.intersect(self.0, ray, t_max, hits)
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

/// A ray's start and slopes in the order of its axes.
struct ShearedRay<S: Simd> {
    axes: [usize; 3],
    origin: [f32x8<S>; 3],
    slopes: [f32x8<S>; 2],
}

impl<S: Simd> ShearedRay<S> {
    #[inline(always)]
    fn new(simd: S, ray: &PreparedRay) -> Self {
        let [x, y, z, _] = ray.start;
        // The masks say that a corner has this coordinate, so that nothing has to be checked.
        let axes = [(ray.axes[0] & 24) as usize, (ray.axes[1] & 24) as usize, (ray.axes[2] & 24) as usize];
        let origin = [f32x8::splat(simd, x), f32x8::splat(simd, y), f32x8::splat(simd, z)];
        let slopes = [f32x8::splat(simd, -ray.shear[0]), f32x8::splat(simd, -ray.shear[1])];
        ShearedRay { axes, origin, slopes }
    }

    /// One corner of eight triangles in the ray's space.
    #[inline(always)]
    fn corner(&self, simd: S, numbers: &[f32; 10 * WIDTH], corner: usize) -> [f32x8<S>; 3] {
        let [x, y, z] = self.axes;
        let z = f32x8::from_slice(simd, &numbers[24 * corner + z..][..8]) - self.origin[2];
        let x = f32x8::from_slice(simd, &numbers[24 * corner + x..][..8]) - self.origin[0];
        let y = f32x8::from_slice(simd, &numbers[24 * corner + y..][..8]) - self.origin[1];
        [self.slopes[0].mul_add(z, x), self.slopes[1].mul_add(z, y), z]
    }
}
