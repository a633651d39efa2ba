//! `Lanes8` in vector registers.

use super::lanes8::Lanes8;
use super::node::{Node, WIDTH};
use super::prepared::PreparedRay;
use super::triangle_block::{BlockHits, TriangleBlock};
use fearless_simd::{f32x8, prelude::*};

/// Eight lanes of a vector level.
#[derive(Clone, Copy)]
pub(super) struct Wide<S: Simd>(pub(super) S);

impl<S: Simd> Lanes8 for Wide<S> {
    #[inline(always)]
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32 {
        let simd = self.0;
        let [x, y, z] = ray.near_rows;
        let enter_x = plane(simd, node, x, ray.reciprocal[0], ray.near_offset[0]);
        let enter_y = plane(simd, node, y, ray.reciprocal[1], ray.near_offset[1]);
        let enter_z = plane(simd, node, z, ray.reciprocal[2], ray.near_offset[2]);
        let leave_x = plane(simd, node, opposite(x), ray.reciprocal[0], ray.far_offset[0]);
        let leave_y = plane(simd, node, opposite(y), ray.reciprocal[1], ray.far_offset[1]);
        let leave_z = plane(simd, node, opposite(z), ray.reciprocal[2], ray.far_offset[2]);
        let enter = enter_x.max(enter_y).max(enter_z.max(f32x8::splat(simd, ray.t_min)));
        let leave = leave_x.min(leave_y).min(leave_z.min(f32x8::splat(simd, t_max)));
        enter.store_slice(near);
        enter.simd_le(leave).to_bitmask() as u32
    }

    #[inline(always)]
    fn triangles(self, block: &TriangleBlock, ray: &PreparedRay, t_max: f32, hits: &mut BlockHits) -> u32 {
        let simd = self.0;
        let sheared = ShearedRay::new(simd, ray);
        let a = sheared.corner(simd, &block.vertices[0]);
        let b = sheared.corner(simd, &block.vertices[1]);
        let c = sheared.corner(simd, &block.vertices[2]);
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let inside = u.min(v).min(w).simd_ge(0.0) | u.max(v).max(w).simd_le(0.0);
        if inside.to_bitmask() == 0 {
            return 0;
        }
        let inverse = f32x8::splat(simd, 1.0) / (u + v + w);
        let t = u.mul_add(a[2], v.mul_add(b[2], w * c[2])) * inverse * ray.shear[2];
        let hit = inside & t.simd_gt(ray.t_min) & t.simd_le(t_max);
        t.store_slice(&mut hits.t);
        (v * inverse).store_slice(&mut hits.u);
        (w * inverse).store_slice(&mut hits.v);
        hit.to_bitmask() as u32
    }
}

/// The row of the planes on the other side.
#[inline(always)]
pub(super) fn opposite(row: usize) -> usize {
    if row < 3 { row + 3 } else { row - 3 }
}

/// Distances to one plane of each box.
#[inline(always)]
fn plane<S: Simd>(simd: S, node: &Node, row: usize, reciprocal: f32, offset: f32) -> f32x8<S> {
    f32x8::from_slice(simd, &node.bounds[row]).mul_add(f32x8::splat(simd, reciprocal), f32x8::splat(simd, offset))
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
        let [x, y, z] = ray.axes;
        let origin = [f32x8::splat(simd, ray.origin[x]), f32x8::splat(simd, ray.origin[y]), f32x8::splat(simd, ray.origin[z])];
        let slopes = [f32x8::splat(simd, -ray.shear[0]), f32x8::splat(simd, -ray.shear[1])];
        ShearedRay { axes: ray.axes, origin, slopes }
    }

    /// One corner of eight triangles in the ray's space.
    #[inline(always)]
    fn corner(&self, simd: S, rows: &[[f32; WIDTH]; 3]) -> [f32x8<S>; 3] {
        let [x, y, z] = self.axes;
        let z = f32x8::from_slice(simd, &rows[z]) - self.origin[2];
        let x = f32x8::from_slice(simd, &rows[x]) - self.origin[0];
        let y = f32x8::from_slice(simd, &rows[y]) - self.origin[1];
        [self.slopes[0].mul_add(z, x), self.slopes[1].mul_add(z, y), z]
    }
}
