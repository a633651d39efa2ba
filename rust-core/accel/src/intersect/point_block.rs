//! Leaf of a tree of points: up to eight spheres, or discs that face each ray, and their tests, on lanes.

use super::line_ray::{LineRay, SmoothHits, UNSEEN, dot, load3, sphere, store};
use crate::intersect::prepared::PreparedRay;
use crate::ray::NONE;
use crate::tree::node::WIDTH;
use bytemuck::{Pod, Zeroable};
use fearless_simd::{f32x8, prelude::*};

/// Up to eight points; unused lanes hold NaN, which no test accepts.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub(crate) struct PointBlock {
    /// Centres: `centre[axis][lane]`.
    pub(crate) centre: [[f32; WIDTH]; 3],
    pub(crate) radius: [f32; WIDTH],
    /// Numbers of the points, [`NONE`] in unused lanes.
    pub(crate) primitives: [u32; WIDTH],
}

impl PointBlock {
    /// A block without points.
    pub(crate) const EMPTY: PointBlock =
        PointBlock { centre: [[f32::NAN; WIDTH]; 3], radius: [f32::NAN; WIDTH], primitives: [NONE; WIDTH] };

    pub(crate) fn set(&mut self, lane: usize, point: [f32; 4], primitive: u32) {
        (0..3).for_each(|k| self.centre[k][lane] = point[k]);
        (self.radius[lane], self.primitives[lane]) = (point[3], primitive);
    }
}

/// The spheres that a ray enters, as a mask.
#[inline(always)]
pub(super) fn intersect_spheres<S: Simd>(simd: S, block: &PointBlock, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let ray = LineRay::new(simd, ray, t_max);
    let (foot, to) = ray.foot(load3(simd, &block.centre));
    let (t, out, met) = sphere(foot, to, f32x8::from_slice(simd, &block.radius), &ray);
    store(hits, t, f32x8::splat(simd, 0.0), out);
    met.to_bitmask() as u32
}

/// The discs that a ray meets, as a mask.
#[inline(always)]
pub(super) fn intersect_discs<S: Simd>(simd: S, block: &PointBlock, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let ray = LineRay::new(simd, ray, t_max);
    let (t, to) = ray.foot(load3(simd, &block.centre));
    let radius = f32x8::from_slice(simd, &block.radius);
    let behind = ray.t_min.max(radius * ray.inverse.sqrt() * UNSEEN);
    let hit = dot(to, to).simd_le(radius * radius) & radius.simd_gt(0.0) & t.simd_gt(behind) & t.simd_le(ray.t_max);
    store(hits, t, f32x8::splat(simd, 0.0), [-to[0], -to[1], -to[2]]);
    hit.to_bitmask() as u32
}
