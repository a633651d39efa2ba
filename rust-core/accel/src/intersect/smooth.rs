//! The leaves of trees of curves and points, of one shape each: which a ray meets, and where, in two numbers.
//!
//! The two numbers stand in the place of a triangle's barycentric coordinates and say all that there is to know of a hit, without the ray:
//!
//! | shape | u | v |
//! | --- | --- | --- |
//! | tube | share of the piece; on the rounded ends ±2 plus the normal's part along the axis | turn about the axis |
//! | ribbon | share of the piece | packed: share of the radius, −1 to 1; turn of the ribbon's side |
//! | sphere | first octahedral coordinate of the normal | second one |
//! | disc | packed: shares of the radius along two axes | packed: octahedral coordinates of the normal |
//!
//! A turn is a number from −2 to 2 in place of an angle ([`turn`]). Packed are two numbers in 15 bits each. The reader is `geometry/smooth.rs`
//! of `gonio-transport`.

use super::leaf::Leaf;
use super::line_ray::{END_CAP, START_CAP, SmoothHits};
use super::octahedral::{from_octahedral, octahedral};
use super::point_block::{PointBlock, intersect_discs, intersect_spheres};
use super::prepared::PreparedRay;
use super::segment_block::Segments;
use super::segment_leaves::SegmentLeaves;
use super::segments::{intersect_ribbons, intersect_tubes};
use super::smooth_scalar;
use crate::hit_callback::HitCallback;
use crate::ray::{Hit, NONE};
use crate::tree::instance::Owner;
use crate::tree::node::WIDTH;
use fearless_simd::Simd;
use gonio_simd::prefetch;

/// The leaves of a tree.
#[derive(Clone, Debug, Default)]
pub(crate) enum Smooth {
    /// A tree of triangles has none.
    #[default]
    Nothing,
    Tubes(SegmentLeaves),
    Ribbons(SegmentLeaves),
    Spheres(Vec<PointBlock>),
    Discs(Vec<PointBlock>),
}

/// A hit of a lane: primitive, and the two numbers.
pub(crate) type LaneHit = (u32, f32, f32);

impl Smooth {
    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        match self {
            Smooth::Nothing => true,
            Smooth::Tubes(leaves) | Smooth::Ribbons(leaves) => leaves.is_empty(),
            Smooth::Spheres(blocks) | Smooth::Discs(blocks) => blocks.is_empty(),
        }
    }

    /// Bytes held.
    pub(crate) fn memory(&self) -> usize {
        match self {
            Smooth::Nothing => 0,
            Smooth::Tubes(leaves) | Smooth::Ribbons(leaves) => leaves.memory(),
            Smooth::Spheres(blocks) | Smooth::Discs(blocks) => blocks.capacity() * size_of::<PointBlock>(),
        }
    }

    /// Has memory fetch a leaf.
    #[inline(always)]
    pub(crate) fn fetch(&self, index: usize) {
        match self {
            Smooth::Nothing => {}
            Smooth::Tubes(leaves) | Smooth::Ribbons(leaves) => leaves.fetch(index),
            Smooth::Spheres(blocks) | Smooth::Discs(blocks) => prefetch(blocks, index),
        }
    }

    /// A leaf.
    #[inline(always)]
    pub(crate) fn leaf(&self, index: usize) -> SmoothLeaf<'_> {
        match self {
            Smooth::Nothing => SmoothLeaf::Nothing,
            Smooth::Tubes(leaves) => SmoothLeaf::Tubes(leaves.leaf(index)),
            Smooth::Ribbons(leaves) => SmoothLeaf::Ribbons(leaves.leaf(index)),
            Smooth::Spheres(blocks) => SmoothLeaf::Spheres(&blocks[index]),
            Smooth::Discs(blocks) => SmoothLeaf::Discs(&blocks[index]),
        }
    }
}

/// A leaf of a tree, as it stands or at a ray's time.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SmoothLeaf<'a> {
    Nothing,
    Tubes(Segments<'a>),
    Ribbons(Segments<'a>),
    Spheres(&'a PointBlock),
    Discs(&'a PointBlock),
}

impl SmoothLeaf<'_> {
    /// The distance where a ray that enters the shape of a lane at `t` leaves it; of what is flat `t`.
    fn leaves(self, lane: usize, ray: &PreparedRay, t: f32) -> f32 {
        match self {
            SmoothLeaf::Tubes(leaf) => smooth_scalar::leaves(leaf, lane, ray).max(t),
            _ => t,
        }
    }

    /// Which primitive a lane has hit, and where on it.
    fn describe(self, lane: usize, ray: &PreparedRay, hits: &SmoothHits) -> LaneHit {
        let lane = lane % WIDTH;
        let out = [hits.out[0][lane], hits.out[1][lane], hits.out[2][lane]];
        match self {
            SmoothLeaf::Nothing => (NONE, 0.0, 0.0),
            SmoothLeaf::Tubes(leaf) => {
                let (axis, _) = leaf.lane(lane, 0.0);
                let (u, v) = on_tube(axis, hits.along[lane], out);
                (leaf.primitive(lane), u, v)
            }
            SmoothLeaf::Ribbons(leaf) => {
                let (axis, radius) = leaf.lane(lane, hits.along[lane]);
                (leaf.primitive(lane), hits.along[lane], on_ribbon(axis, radius, ray, out))
            }
            SmoothLeaf::Spheres(block) => {
                let [u, v] = octahedral(unit(out));
                (block.primitives[lane], u, v)
            }
            SmoothLeaf::Discs(block) => {
                let (u, v) = on_disc(block.radius[lane], ray, out);
                (block.primitives[lane], u, v)
            }
        }
    }
}

impl Leaf for SmoothLeaf<'_> {
    type Found = SmoothHits;

    #[inline(always)]
    fn intersect_scalar(self, ray: &PreparedRay, t_max: f32, found: &mut SmoothHits) -> u32 {
        smooth_scalar::intersect(self, ray, t_max, found)
    }

    #[inline(never)]
    fn intersect<S: Simd>(self, simd: S, ray: &PreparedRay, t_max: f32, found: &mut SmoothHits) -> u32 {
        simd.vectorize(
            #[inline(always)]
            || match self {
                SmoothLeaf::Nothing => 0,
                SmoothLeaf::Tubes(leaf) => intersect_tubes(simd, leaf, ray, t_max, found),
                SmoothLeaf::Ribbons(leaf) => intersect_ribbons(simd, leaf, ray, t_max, found),
                SmoothLeaf::Spheres(block) => intersect_spheres(simd, block, ray, t_max, found),
                SmoothLeaf::Discs(block) => intersect_discs(simd, block, ray, t_max, found),
            },
        )
    }

    #[inline(always)]
    fn report<C: HitCallback>(self, lane: usize, ray: &PreparedRay, found: &SmoothHits, owner: Owner, callback: &mut C) -> bool {
        let t = found.t[lane];
        // What an earlier lane of this leaf covers needs no description.
        if C::ORDERED && t > callback.t_max() {
            return false;
        }
        let (primitive, u, v) = self.describe(lane, ray, found);
        callback.add_smooth(Hit { t, u, v, primitive, instance: owner.id }, || self.leaves(lane, ray, t), owner.transparent)
    }
}

pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit vector; along z where there is none.
fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = dot(v, v).sqrt();
    let scaled = v.map(|x| x / length);
    if length > 0.0 && scaled.iter().all(|x| x.is_finite()) { scaled } else { [0.0, 0.0, 1.0] }
}

/// The first two axes of the frame about a unit vector: those of `gonio_simd::Frame::from_normal`.
fn frame(n: [f32; 3]) -> [[f32; 3]; 2] {
    let [x, y, z] = n;
    let sign = 1.0f32.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[sign * x * x * a + 1.0, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}

/// A direction in a plane as a number from −2 to 2: y over |x| + |y| where x is positive, else 2 less that, with the sign of y.
fn turn(x: f32, y: f32) -> f32 {
    let sum = x.abs() + y.abs();
    let share = if sum > 0.0 { y / sum } else { 0.0 };
    if x >= 0.0 { share } else { 2.0f32.copysign(y) - share }
}

/// The largest of 15 bits.
const FIFTEEN: f32 = 32767.0;

/// Two numbers from −1 to 1 in 15 bits each, as the bits of a number that no operation but a copy may see.
fn packed(x: f32, y: f32) -> f32 {
    let bits = |x: f32| (0.5f32.mul_add(x.clamp(-1.0, 1.0), 0.5) * FIFTEEN).round() as u32;
    f32::from_bits(bits(x) << 15 | bits(y))
}

/// What the reader finds of a number in 15 bits.
fn in_fifteen_bits(x: f32) -> f32 {
    (0.5f32.mul_add(x.clamp(-1.0, 1.0), 0.5) * FIFTEEN).round() * (2.0 / FIFTEEN) - 1.0
}

fn on_tube(axis: [f32; 3], along: f32, out: [f32; 3]) -> (f32, f32) {
    let axis = unit(axis);
    let [x, y] = frame(axis);
    let v = turn(dot(out, x), dot(out, y));
    let u = if along == END_CAP || along == START_CAP { along + dot(unit(out), axis).clamp(-1.0, 1.0) } else { along };
    (u, v)
}

fn on_ribbon(axis: [f32; 3], radius: f32, ray: &PreparedRay, out: [f32; 3]) -> f32 {
    let axis = unit(axis);
    let back = [-ray.direction[0], -ray.direction[1], -ray.direction[2]];
    let side = unit(cross(axis, back));
    let [x, y] = frame(axis);
    packed(dot(out, side) / radius, 0.5 * turn(dot(side, x), dot(side, y)))
}

fn on_disc(radius: f32, ray: &PreparedRay, out: [f32; 3]) -> (f32, f32) {
    let back = unit([-ray.direction[0], -ray.direction[1], -ray.direction[2]]);
    let [a, b] = octahedral(back);
    // Axes of the normal that the reader finds.
    let [x, y] = frame(unit(from_octahedral([in_fifteen_bits(a), in_fifteen_bits(b)])));
    (packed(dot(out, x) / radius, dot(out, y) / radius), packed(a, b))
}
