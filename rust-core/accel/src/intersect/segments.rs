//! Tests of a ray against eight pieces of curves, on lanes: as cones with rounded ends, or as ribbons that face it.
//!
//! All is worked out about the point of the axis that is nearest to the ray: numbers are as small as the radius there, and so are errors.

use super::joint::{Joints, firsts};
use super::line_ray::{END_CAP, LineRay, START_CAP, SmoothHits, UNSEEN, Vec8, along, dot, sphere, store};
use super::prepared::PreparedRay;
use super::segment_block::{Segments, row};
use crate::tree::node::WIDTH;
use fearless_simd::{f32x8, mask32x8, prelude::*};

#[inline(always)]
fn select3<S: Simd>(mask: mask32x8<S>, a: Vec8<S>, b: Vec8<S>) -> Vec8<S> {
    [mask.select(a[0], b[0]), mask.select(a[1], b[1]), mask.select(a[2], b[2])]
}

/// Rows of a leaf; lanes without a piece hold NaN, which no test accepts.
struct Rows<'a, S: Simd> {
    simd: S,
    leaf: Segments<'a>,
    there: mask32x8<S>,
}

impl<'a, S: Simd> Rows<'a, S> {
    #[inline(always)]
    fn new(simd: S, leaf: Segments<'a>) -> Self {
        let lanes = f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        Rows { simd, leaf, there: lanes.simd_lt(leaf.count() as f32) }
    }

    #[inline(always)]
    fn row(&self, row: usize) -> f32x8<S> {
        self.there.select(f32x8::from_slice(self.simd, self.leaf.eight_numbers(row)), f32x8::splat(self.simd, f32::NAN))
    }

    #[inline(always)]
    fn three(&self, row: usize) -> Vec8<S> {
        [self.row(row), self.row(row + 1), self.row(row + 2)]
    }

    /// The words of joints; of lanes without a piece they mean nothing.
    #[inline(always)]
    fn joints(&self) -> &'a [u32; WIDTH] {
        self.leaf.eight(row::JOINT)
    }
}

/// The ray and the axes of eight pieces where they are nearest.
struct Approach<S: Simd> {
    axis: Vec8<S>,
    radius: [f32x8<S>; 2],
    /// The axis without its part along the ray, and that part in units of the direction.
    across: Vec8<S>,
    along_ray: f32x8<S>,
    /// Where the ray is nearest to the first end, and the way from there to it.
    start: (f32x8<S>, Vec8<S>),
    /// The nearest share of the axis, not cut to the piece, and cut to it.
    share: [f32x8<S>; 2],
    /// The ray's distance there.
    t: f32x8<S>,
    /// From the axis to the ray there.
    out: Vec8<S>,
}

impl<S: Simd> Approach<S> {
    #[inline(always)]
    fn new(rows: &Rows<'_, S>, ray: &LineRay<S>) -> Self {
        let axis = rows.three(row::AXIS);
        let radius = [rows.row(row::RADIUS), rows.row(row::RADIUS + 1)];
        let start = ray.foot(rows.three(row::START));
        let along_ray = dot(axis, ray.direction) * ray.inverse;
        let across = along(axis, ray.direction, -along_ray);
        let raw = -dot(start.1, across) / dot(across, across).max(f32::MIN_POSITIVE);
        let share = raw.max(0.0).min(1.0);
        let way = along(start.1, across, share);
        Approach {
            axis,
            radius,
            across,
            along_ray,
            start,
            share: [raw, share],
            t: share.mul_add(along_ray, start.0),
            out: [-way[0], -way[1], -way[2]],
        }
    }

    /// The radius where the axis is nearest.
    #[inline(always)]
    fn near_radius(&self) -> f32x8<S> {
        self.share[1].mul_add(self.radius[1], self.radius[0])
    }
}

/// The pieces that a ray meets as rounded cones, as a mask.
#[inline(always)]
pub(super) fn intersect_tubes<S: Simd>(simd: S, leaf: Segments<'_>, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let (ray, rows) = (LineRay::new(simd, ray, t_max), Rows::new(simd, leaf));
    let near = Approach::new(&rows, &ray);
    let [radius, growth] = near.radius;
    let widest = radius.max(radius + growth);
    if dot(near.out, near.out).simd_le(widest * widest).to_bitmask() == 0 {
        return 0;
    }
    let (body_t, body_share, body_out) = cone(simd, &near, &ray);
    let (end_t, end_out, end) = end_cap(&rows, &near, &ray);
    let mut t = body_t;
    let end = end & end_t.simd_lt(t);
    t = end.select(end_t, t);
    let mut share = end.select(f32x8::splat(simd, END_CAP), body_share);
    let mut out = select3(end, end_out, body_out);
    let first = rows.there & firsts(simd, rows.joints());
    if first.to_bitmask() != 0 {
        let (start_t, start_out, start) = start_cap(simd, &near, &ray);
        let start = start & first & start_t.simd_lt(t);
        t = start.select(start_t, t);
        share = start.select(f32x8::splat(simd, START_CAP), share);
        out = select3(start, start_out, out);
    }
    let hit = t.simd_gt(ray.t_min) & t.simd_le(ray.t_max) & t.simd_lt(f32::INFINITY);
    store(hits, t, share, out);
    hit.to_bitmask() as u32
}

/// Where the ray enters the cones between the end spheres: distance (infinity where it does not), share of the axis, and the way out from there.
#[inline(always)]
fn cone<S: Simd>(simd: S, near: &Approach<S>, ray: &LineRay<S>) -> (f32x8<S>, f32x8<S>, Vec8<S>) {
    let growth = near.radius[1];
    let radius = near.near_radius();
    let slope = dot(near.axis, near.axis) - growth * growth;
    let inverse = f32x8::splat(simd, 1.0) / slope;
    let (axis_out, axis_ray) = (dot(near.axis, near.out), near.along_ray * ray.squared);
    let e = radius.mul_add(growth, axis_out);
    // Of the distance after the nearest point: a t² + 2 b t + c.
    let a = ray.squared * (dot(near.across, near.across) - growth * growth) * inverse;
    let b = -(e * axis_ray * inverse);
    let c = dot(near.out, near.out) - radius * radius - e * e * inverse;
    let discriminant = b * b - a * c;
    let root = discriminant.max(0.0).sqrt();
    let towards = b.simd_lt(0.0);
    let after = towards.select(c, -b - root) / towards.select(root - b, a);
    let more = (axis_ray.mul_add(after, e)) * inverse;
    let share = near.share[1] + more;
    let valid = discriminant.simd_ge(0.0) & slope.simd_gt(0.0) & share.simd_ge(0.0) & share.simd_le(1.0);
    let t = near.t + after;
    let valid = valid & t.simd_gt(ray.t_min) & t.simd_le(ray.t_max);
    let out = along(along(near.out, ray.direction, after), near.axis, -more);
    (valid.select(t, f32x8::splat(simd, f32::INFINITY)), share, out)
}

/// Slack where the cone's part of a piece meets that of its ends, over radius and length: both have the line between them.
pub(super) const SEAM: f32 = 1e-4;

/// Where the ray enters the second end's sphere, and whether that is the piece's part of it.
#[inline(always)]
fn end_cap<S: Simd>(rows: &Rows<'_, S>, near: &Approach<S>, ray: &LineRay<S>) -> (f32x8<S>, Vec8<S>, mask32x8<S>) {
    let radius = near.radius[0] + near.radius[1];
    let to = along(near.start.1, near.across, f32x8::splat(rows.simd, 1.0));
    let (t, out, met) = sphere(near.start.0 + near.along_ray, to, radius, ray);
    let beyond = radius.mul_add(near.radius[1], dot(near.axis, out));
    let slack = radius * dot(near.axis, near.axis).sqrt() * -SEAM;
    let end = along(rows.three(row::START), near.axis, f32x8::splat(rows.simd, 1.0));
    let size = end[0].abs().max(end[1].abs()).max(end[2].abs());
    (t, out, met & beyond.simd_ge(slack) & Joints::new(rows.simd, rows.joints()).has(out, radius, size))
}

/// Where the ray enters the first end's sphere, and whether that is the piece's part of it.
#[inline(always)]
fn start_cap<S: Simd>(_simd: S, near: &Approach<S>, ray: &LineRay<S>) -> (f32x8<S>, Vec8<S>, mask32x8<S>) {
    let radius = near.radius[0];
    let (t, out, met) = sphere(near.start.0, near.start.1, radius, ray);
    let beyond = radius.mul_add(near.radius[1], dot(near.axis, out));
    let slack = radius * dot(near.axis, near.axis).sqrt() * SEAM;
    (t, out, met & beyond.simd_le(slack))
}

/// The pieces that a ray meets as ribbons which face it, as a mask.
#[inline(always)]
pub(super) fn intersect_ribbons<S: Simd>(simd: S, leaf: Segments<'_>, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let (ray, rows) = (LineRay::new(simd, ray, t_max), Rows::new(simd, leaf));
    let near = Approach::new(&rows, &ray);
    let radius = near.near_radius();
    let squared = radius * radius;
    let behind = ray.t_min.max(squared.sqrt() * ray.inverse.sqrt() * UNSEEN);
    let hit = dot(near.out, near.out).simd_le(squared)
        & radius.simd_gt(0.0)
        & near.share[0].simd_ge(0.0)
        & near.t.simd_gt(behind)
        & near.t.simd_le(ray.t_max);
    let within = hit & near.share[0].simd_le(1.0);
    let mut mask = within.to_bitmask();
    if mask != hit.to_bitmask() {
        // Between two pieces a part of a disc, so that there is no gap on the outer side of a bend.
        mask = (within | (hit & Joints::new(simd, rows.joints()).is_outer(near.out, radius))).to_bitmask();
    }
    if mask != 0 {
        store(hits, near.t, near.share[1], near.out);
    }
    mask as u32
}
