//! A ray as the tests of curves and points need it, and what these tests find, on lanes.

use super::prepared::PreparedRay;
use crate::tree::node::WIDTH;
use fearless_simd::{f32x8, mask32x8, prelude::*};

/// Hits of eight lanes, valid in the lanes of a mask.
#[derive(Clone, Copy, Default)]
#[repr(C, align(32))]
pub(crate) struct SmoothHits {
    /// Distance in units of the ray's direction.
    pub(crate) t: [f32; WIDTH],
    /// Share of the axis; [`END_CAP`] and [`START_CAP`] on the rounded ends.
    pub(crate) along: [f32; WIDTH],
    /// From the axis, or the centre, to the hit.
    pub(crate) out: [[f32; WIDTH]; 3],
}

/// `SmoothHits::along` on the rounding of the second end.
pub(crate) const END_CAP: f32 = 2.0;
/// `SmoothHits::along` on the rounding of the first end.
pub(crate) const START_CAP: f32 = -2.0;

/// Three components of eight lanes.
pub(super) type Vec8<S> = [f32x8<S>; 3];

#[inline(always)]
pub(super) fn load3<S: Simd>(simd: S, rows: &[[f32; WIDTH]; 3]) -> Vec8<S> {
    [f32x8::from_slice(simd, &rows[0]), f32x8::from_slice(simd, &rows[1]), f32x8::from_slice(simd, &rows[2])]
}

#[inline(always)]
pub(super) fn dot<S: Simd>(a: Vec8<S>, b: Vec8<S>) -> f32x8<S> {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// `a + b s`.
#[inline(always)]
pub(super) fn along<S: Simd>(a: Vec8<S>, b: Vec8<S>, s: f32x8<S>) -> Vec8<S> {
    [b[0].mul_add(s, a[0]), b[1].mul_add(s, a[1]), b[2].mul_add(s, a[2])]
}

/// A ray as the tests of rounded shapes need it.
#[derive(Clone, Copy)]
pub(super) struct LineRay<S: Simd> {
    pub(super) origin: Vec8<S>,
    pub(super) direction: Vec8<S>,
    /// The direction's square, and one over it.
    pub(super) squared: f32x8<S>,
    pub(super) inverse: f32x8<S>,
    pub(super) t_min: f32x8<S>,
    pub(super) t_max: f32x8<S>,
}

impl<S: Simd> LineRay<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, ray: &PreparedRay, t_max: f32) -> Self {
        let [x, y, z, _] = ray.direction;
        let squared = x * x + y * y + z * z;
        LineRay {
            origin: [f32x8::splat(simd, ray.origin[0]), f32x8::splat(simd, ray.origin[1]), f32x8::splat(simd, ray.origin[2])],
            direction: [f32x8::splat(simd, x), f32x8::splat(simd, y), f32x8::splat(simd, z)],
            squared: f32x8::splat(simd, squared),
            inverse: f32x8::splat(simd, 1.0 / squared),
            t_min: f32x8::splat(simd, ray.t_min),
            t_max: f32x8::splat(simd, t_max),
        }
    }

    /// Where the ray is nearest to a point, and the way from there to the point.
    #[inline(always)]
    pub(super) fn foot(&self, point: Vec8<S>) -> (f32x8<S>, Vec8<S>) {
        let to = [point[0] - self.origin[0], point[1] - self.origin[1], point[2] - self.origin[2]];
        let t = dot(to, self.direction) * self.inverse;
        (t, along(to, self.direction, -t))
    }
}

/// Keeps what a test has found.
#[inline(always)]
pub(super) fn store<S: Simd>(hits: &mut SmoothHits, t: f32x8<S>, along: f32x8<S>, out: Vec8<S>) {
    t.store_slice(&mut hits.t);
    along.store_slice(&mut hits.along);
    for (part, row) in out.iter().zip(&mut hits.out) {
        part.store_slice(row);
    }
}

/// Where the ray enters spheres: `foot` is its distance where it is nearest to the centres, `to` the way from there to them.
#[inline(always)]
pub(super) fn sphere<S: Simd>(foot: f32x8<S>, to: Vec8<S>, radius: f32x8<S>, ray: &LineRay<S>) -> (f32x8<S>, Vec8<S>, mask32x8<S>) {
    let half_squared = (radius * radius - dot(to, to)) * ray.inverse;
    let half = half_squared.max(0.0).sqrt();
    let t = foot - half;
    let met = half_squared.simd_ge(0.0) & radius.simd_gt(0.0) & t.simd_gt(ray.t_min) & t.simd_le(ray.t_max);
    (t, along([-to[0], -to[1], -to[2]], ray.direction, -half), met)
}

/// A ray leaves flat shapes that face it behind unseen up to this distance over the radius: from anywhere on them they would be met again.
pub(super) const UNSEEN: f32 = 2.0;
