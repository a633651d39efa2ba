//! A node in eight words, and the estimate of what its lights bring to a point, on lanes.

use super::bound::{Bound, Cone};
use crate::light::choice::{EMITTER_FLOOR, lifted};
use crate::light::vector::narrow;
use gonio_simd::{F, Lanes, M, One, U, Vec3};

/// Values of a node: centre (3), radius, strength, axis, cosines, and what is below.
pub(super) const WORDS: usize = 8;

/// In the last word: a light instead of children.
const LEAF: u32 = 1 << 31;
const COSINE: u32 = 1 << 30;
const TWO_SIDED: u32 = 1 << 29;
const COUNT_SHIFT: u32 = 25;
/// The first child or the light, in the last word.
const INDEX: u32 = (1 << COUNT_SHIFT) - 1;
/// Steps of a sine or cosine in sixteen bits.
const STEPS: f32 = 32767.0;
/// Steps of an axis' coordinate in ten bits.
const AXIS_STEPS: f32 = 511.0;
/// What rounding the axis takes from a cosine at most.
const SLACK: f64 = 3e-3;

/// A leaf's words.
pub(super) fn leaf(bound: &Bound, light: u32) -> [f32; WORDS] {
    words(bound, LEAF | light & INDEX)
}

/// An inner node's words, its children yet to be set.
pub(super) fn inner(bound: &Bound) -> [f32; WORDS] {
    words(bound, 0)
}

/// Sets a node's children.
pub(super) fn set_children(words: &mut [f32], node: u32, first: usize, count: usize) {
    let last = &mut words[node as usize * WORDS + WORDS - 1];
    *last = f32::from_bits(last.to_bits() | (count as u32) << COUNT_SHIFT | first as u32);
}

/// The light of a leaf.
pub(super) fn light(words: &[f32; WORDS]) -> Option<u32> {
    let last = words[WORDS - 1].to_bits();
    (last & LEAF != 0).then_some(last & INDEX)
}

fn words(bound: &Bound, below: u32) -> [f32; WORDS] {
    let [x, y, z] = narrow(bound.centre);
    let Cone { axis, spread } = bound.normals;
    let sine = if spread < std::f64::consts::FRAC_PI_2 { spread.sin() } else { 1.0 };
    let edge = (spread + bound.edge).min(std::f64::consts::PI).cos();
    let switches = if bound.cosine { COSINE } else { 0 } | if bound.two_sided { TWO_SIDED } else { 0 };
    // A hair larger than told: its centre was rounded to single precision.
    let radius = (bound.radius * 1.0001) as f32;
    let [x_axis, y_axis, z_axis] = narrow(axis).map(|x| (x * AXIS_STEPS).round() as i32 as u32 & 1023);
    let packed = [x_axis | y_axis << 10 | z_axis << 20, pair((sine + SLACK).min(1.0), (edge - SLACK).max(-1.0)), below | switches];
    let [axis, angles, last] = packed.map(f32::from_bits);
    [x, y, z, radius, bound.strength as f32, axis, angles, last]
}

/// Two numbers of −1 to 1 in sixteen bits each, the first rounded up and the second down.
fn pair(first: f64, second: f64) -> u32 {
    let steps = f64::from(STEPS);
    u32::from((first * steps).ceil() as i16 as u16) | u32::from((second * steps).floor() as i16 as u16) << 16
}

/// What is below the node of each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Below<L: Lanes>(U<L>);

impl<L: Lanes> Below<L> {
    /// The node of each lane.
    #[inline(always)]
    pub(super) fn gather(l: L, words: &[f32], node: U<L>) -> Self {
        Self(l.gather(words, node * WORDS as u32 + (WORDS as u32 - 1)).to_bits())
    }
    /// Another node's where `mask` is set.
    #[inline(always)]
    pub(super) fn replaced_by(self, other: Self, mask: M<L>) -> Self {
        Self(mask.select(other.0, self.0))
    }
    #[inline(always)]
    pub(super) fn is_leaf(self) -> M<L> {
        (self.0 & LEAF).ne(0)
    }
    /// The light of a leaf, the first child of another node.
    #[inline(always)]
    pub(super) fn index(self) -> U<L> {
        self.0 & INDEX
    }
    /// Children.
    #[inline(always)]
    pub(super) fn count(self) -> U<L> {
        (self.0 >> COUNT_SHIFT) & 15
    }
}

/// A node in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<L: Lanes> {
    centre: Vec3<L>,
    radius: F<L>,
    strength: F<L>,
    /// About unit.
    axis: Vec3<L>,
    /// Sine of the normals' spread.
    spread: F<L>,
    /// Cosine of the angle beyond which nothing is sent.
    edge: F<L>,
    below: Below<L>,
}

impl<L: Lanes> Node<L> {
    /// The node of each lane.
    #[inline(always)]
    pub(super) fn gather(l: L, words: &[f32], node: U<L>) -> Self {
        let base = node * WORDS as u32;
        let [x, y, z, radius] = l.gather_quads(words, base);
        let [strength, axis, angles, last] = l.gather_quads(words, base + 4);
        let (axis, angles) = (axis.to_bits(), angles.to_bits());
        Self {
            centre: Vec3::new(x, y, z),
            radius,
            strength,
            axis: Vec3::new(coordinate(axis << 22), coordinate(axis << 12), coordinate(axis << 2)),
            spread: angle(angles << 16),
            edge: angle(angles),
            below: Below(last.to_bits()),
        }
    }
    /// One node for all lanes.
    #[inline(always)]
    pub(super) fn splat(l: L, node: &Node<One>) -> Self {
        let vector = |v: Vec3<One>| Vec3::new(l.f(v.x.0), l.f(v.y.0), l.f(v.z.0));
        let Node { centre, radius, strength, axis, spread, edge, below } = *node;
        let (centre, axis) = (vector(centre), vector(axis));
        Self {
            centre,
            radius: l.f(radius.0),
            strength: l.f(strength.0),
            axis,
            spread: l.f(spread.0),
            edge: l.f(edge.0),
            below: Below(l.u(below.0.0)),
        }
    }
    /// About the illuminance at `p` on a surface of normal `n` (zero: no surface), zero only where none of the light can arrive.
    #[inline(always)]
    pub(super) fn illuminance(&self, l: L, p: Vec3<L>, n: Vec3<L>) -> F<L> {
        let towards = self.centre - p;
        let squared = towards.length_squared().max(f32::MIN_POSITIVE);
        let nearness = squared.sqrt().recip();
        // The cosine of an angle less another one is at most the cosine of the one plus the sine of the other.
        let sine = (self.radius * nearness).min(1.0);
        let inside = squared.le(self.radius * self.radius);

        let facing = n.dot(towards) * nearness;
        let receiver = self.typical(l, facing + sine, facing, inside);
        let leaving = -self.axis.dot(towards) * nearness;
        let leaving = (self.below.0 & TWO_SIDED).ne(0).select(leaving.abs(), leaving);
        let nearest = (leaving + sine).max(-1.0);
        let fading = self.typical(l, nearest + self.spread, leaving, inside).max(EMITTER_FLOOR);
        let emitter = (self.below.0 & COSINE).ne(0).select(fading, l.f(1.0)).keep_if(inside | nearest.ge(self.edge));
        let widening = inside.select(self.mean_square(squared), squared);
        (self.strength * lifted(l, n, receiver) * emitter / widening).min(1e30)
    }
    /// A cosine between the best that any light of the node may have and that of its middle; all directions occur from inside.
    #[inline(always)]
    fn typical(&self, l: L, best: F<L>, middle: F<L>, inside: M<L>) -> F<L> {
        let best = best.min(1.0);
        let single = inside.select(l.f(1.0), best);
        let several = inside.select(l.f(0.6), 0.5 * (best + middle.max(0.0)));
        self.below.is_leaf().select(single, several)
    }
    /// Squared distance that stands for the lights around a point inside the node's sphere: about the harmonic mean over a full ball; no light comes
    /// nearer than its own size.
    #[inline(always)]
    fn mean_square(&self, squared: F<L>) -> F<L> {
        let own = self.radius * self.radius;
        self.below.is_leaf().select(own, (own + squared) * (1.0 / 3.0)).max(f32::MIN_POSITIVE)
    }
}

/// A sine or cosine in the upper sixteen bits.
#[inline(always)]
fn angle<L: Lanes>(bits: U<L>) -> F<L> {
    bits.sar(16).i32_to_float() * (1.0 / STEPS)
}

/// An axis' coordinate in the upper ten bits.
#[inline(always)]
fn coordinate<L: Lanes>(bits: U<L>) -> F<L> {
    bits.sar(22).i32_to_float() * (1.0 / AXIS_STEPS)
}
