//! Leaf of a tree of curves: up to eight pieces, each a cone with rounded ends or a flat ribbon, and their tests, on lanes.
//!
//! A piece is what a sphere sweeps whose centre goes from one end to the other while its radius changes evenly: the envelope is a cone that is
//! tangent to both end spheres. Pieces of a curve share their end spheres, so that the whole has no gaps. Of a shared sphere one piece has what lies
//! beyond both cones; surfaces are met from outside alone.
//!
//! All is worked out about the point of the axis that is nearest to the ray: numbers are as small as the radius there, and so are errors.

use crate::intersect::prepared::PreparedRay;
use crate::ray::NONE;
use crate::tree::node::WIDTH;
use bytemuck::{Pod, Zeroable};
use fearless_simd::{f32x8, mask32x8, prelude::*};

/// Up to eight pieces of curves; unused lanes hold NaN, which no test accepts.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct SegmentBlock {
    /// First end: `start[axis][lane]`.
    pub(crate) start: [[f32; WIDTH]; 3],
    /// From the first end to the second.
    pub(crate) axis: [[f32; WIDTH]; 3],
    /// Radius at the first end, and how much more it is at the second.
    pub(crate) radius: [[f32; WIDTH]; 2],
    /// Unit direction of the next piece; zero at the end of a curve.
    pub(crate) next: [[f32; WIDTH]; 3],
    /// Of the second end's sphere this piece has what lies no farther than this along `next`.
    pub(crate) limit: [f32; WIDTH],
    /// 1 for the first piece of a curve, which has the rounding of its first end, else 0.
    pub(crate) first: [f32; WIDTH],
    /// Numbers of the pieces, [`NONE`] in unused lanes.
    pub(crate) primitives: [u32; WIDTH],
}

/// A piece of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    /// Ends: x, y, z, radius.
    pub(crate) ends: [[f32; 4]; 2],
    /// The second end of the piece after this one, if the curve goes on.
    pub(crate) next: Option<[f32; 4]>,
    /// Whether the curve begins here.
    pub(crate) first: bool,
}

/// What a piece has of a shared sphere beyond its share, over the radius and over the coordinates: no ray passes between two pieces for rounding.
const OVERLAP: [f32; 2] = [1e-3, 4.0 * f32::EPSILON];

impl SegmentBlock {
    /// A block without pieces.
    pub(crate) const EMPTY: SegmentBlock = SegmentBlock {
        start: [[f32::NAN; WIDTH]; 3],
        axis: [[f32::NAN; WIDTH]; 3],
        radius: [[f32::NAN; WIDTH]; 2],
        next: [[0.0; WIDTH]; 3],
        limit: [0.0; WIDTH],
        first: [0.0; WIDTH],
        primitives: [NONE; WIDTH],
    };

    pub(crate) fn set(&mut self, lane: usize, segment: &Segment, primitive: u32) {
        let [a, b] = segment.ends;
        for k in 0..3 {
            self.start[k][lane] = a[k];
            self.axis[k][lane] = b[k] - a[k];
        }
        (self.radius[0][lane], self.radius[1][lane]) = (a[3], b[3] - a[3]);
        self.first[lane] = f32::from(segment.first);
        if let Some(next) = segment.next {
            let way = [0, 1, 2].map(|k| next[k] - b[k]);
            let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length > 0.0 {
                let largest = b[..3].iter().fold(0.0f32, |most, x| most.max(x.abs()));
                (0..3).for_each(|k| self.next[k][lane] = way[k] / length);
                // Where the next cone begins to touch the sphere.
                self.limit[lane] = b[3] * ((b[3] - next[3]) / length) + OVERLAP[0] * b[3] + OVERLAP[1] * largest;
            }
        }
        self.primitives[lane] = primitive;
    }

    /// A lane's axis, and its radius at a share of it.
    pub(crate) fn lane(&self, lane: usize, share: f32) -> ([f32; 3], f32) {
        let axis = [self.axis[0][lane], self.axis[1][lane], self.axis[2][lane]];
        (axis, share.mul_add(self.radius[1][lane], self.radius[0][lane]))
    }
}

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
type Vec8<S> = [f32x8<S>; 3];

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

#[inline(always)]
fn select3<S: Simd>(mask: mask32x8<S>, a: Vec8<S>, b: Vec8<S>) -> Vec8<S> {
    [mask.select(a[0], b[0]), mask.select(a[1], b[1]), mask.select(a[2], b[2])]
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
    fn new(simd: S, block: &SegmentBlock, ray: &LineRay<S>) -> Self {
        let axis = load3(simd, &block.axis);
        let radius = [f32x8::from_slice(simd, &block.radius[0]), f32x8::from_slice(simd, &block.radius[1])];
        let start = ray.foot(load3(simd, &block.start));
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
pub(super) fn intersect_tubes<S: Simd>(simd: S, block: &SegmentBlock, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let ray = LineRay::new(simd, ray, t_max);
    let near = Approach::new(simd, block, &ray);
    let [radius, growth] = near.radius;
    let widest = radius.max(radius + growth);
    if dot(near.out, near.out).simd_le(widest * widest).to_bitmask() == 0 {
        return 0;
    }
    let (body_t, body_share, body_out) = cone(simd, &near, &ray);
    let (end_t, end_out, end) = end_cap(simd, block, &near, &ray);
    let mut t = body_t;
    let end = end & end_t.simd_lt(t);
    t = end.select(end_t, t);
    let mut share = end.select(f32x8::splat(simd, END_CAP), body_share);
    let mut out = select3(end, end_out, body_out);
    let first = f32x8::from_slice(simd, &block.first).simd_gt(0.0);
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

#[inline(always)]
pub(super) fn store<S: Simd>(hits: &mut SmoothHits, t: f32x8<S>, along: f32x8<S>, out: Vec8<S>) {
    t.store_slice(&mut hits.t);
    along.store_slice(&mut hits.along);
    for k in 0..3 {
        out[k].store_slice(&mut hits.out[k]);
    }
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
fn end_cap<S: Simd>(simd: S, block: &SegmentBlock, near: &Approach<S>, ray: &LineRay<S>) -> (f32x8<S>, Vec8<S>, mask32x8<S>) {
    let radius = near.radius[0] + near.radius[1];
    let to = along(near.start.1, near.across, f32x8::splat(simd, 1.0));
    let (t, out, met) = sphere(near.start.0 + near.along_ray, to, radius, ray);
    let beyond = radius.mul_add(near.radius[1], dot(near.axis, out));
    let slack = radius * dot(near.axis, near.axis).sqrt() * -SEAM;
    let next = dot(load3(simd, &block.next), out);
    (t, out, met & beyond.simd_ge(slack) & next.simd_le(f32x8::from_slice(simd, &block.limit)))
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

/// The pieces that a ray meets as ribbons which face it, as a mask.
#[inline(always)]
pub(super) fn intersect_ribbons<S: Simd>(simd: S, block: &SegmentBlock, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let ray = LineRay::new(simd, ray, t_max);
    let near = Approach::new(simd, block, &ray);
    let radius = near.near_radius();
    let next = load3(simd, &block.next);
    // Between two pieces a part of a disc, so that there is no gap on the outer side of a bend.
    let goes_on = dot(next, next).simd_gt(0.0) | near.share[0].simd_le(1.0);
    let squared = radius * radius;
    let behind = ray.t_min.max(squared.sqrt() * ray.inverse.sqrt() * UNSEEN);
    let hit = dot(near.out, near.out).simd_le(squared)
        & radius.simd_gt(0.0)
        & near.share[0].simd_ge(0.0)
        & goes_on
        & near.t.simd_gt(behind)
        & near.t.simd_le(ray.t_max);
    store(hits, near.t, near.share[1], near.out);
    hit.to_bitmask() as u32
}
