//! A node of the light tree in eight words, and the importance of its lights at a point, on lanes.

use super::bound::{Bound, Cone};
use crate::light_bounds::{EMITTER_FLOOR, lifted};
use crate::vector::narrow;
use crate::way::LightWay;
use gonio_simd::{F, Lanes, M, One, U, Vec3};

/// Values of a node: centre (3), half the box's edges, strength, axis, cosines, and what is below.
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
/// Steps of a length, and their exponent.
const LENGTH_STEPS: f64 = 256.0;
const LENGTH_SHIFT: i32 = 8;
/// The least exponent of lengths whose step is a normal number.
const LEAST_EXPONENT: i32 = -118;
/// Of the middle's squared distance, the share of the box's half diagonal's square that is added for its lights around the middle.
const SCATTERED: f32 = 0.5;
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
    let [x_axis, y_axis, z_axis] = narrow(axis).map(|x| (x * AXIS_STEPS).round() as i32 as u32 & 1023);
    let packed = [x_axis | y_axis << 10 | z_axis << 20, pair((sine + SLACK).min(1.0), (edge - SLACK).max(-1.0)), below | switches];
    let [axis, angles, last] = packed.map(f32::from_bits);
    [x, y, z, f32::from_bits(lengths(bound.half())), bound.strength as f32, axis, angles, last]
}

/// Three lengths in eight bits each, with the exponent of the longest in the upper eight, rounded up.
///
/// A hair longer than told, and none is nothing beside the others: the centre was rounded to single precision.
fn lengths(lengths: [f64; 3]) -> u32 {
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let exponent = (longest * 1.01).log2().ceil().clamp(f64::from(LEAST_EXPONENT), 126.0);
    let step = exponent.exp2() / LENGTH_STEPS;
    let least = if longest > 0.0 { 1.0 } else { 0.0 };
    let [x, y, z] = lengths.map(|length| (length * 1.0001 / step).ceil().clamp(least, LENGTH_STEPS - 1.0) as u32);
    x | y << 8 | z << 16 | ((exponent as i32 - LENGTH_SHIFT + 127) as u32) << 24
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
pub(crate) struct Node<L: Lanes> {
    centre: Vec3<L>,
    /// Half the box's edges.
    half: Vec3<L>,
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
        let [x, y, z, half] = l.gather_quads(words, base);
        let [strength, axis, angles, last] = l.gather_quads(words, base + 4);
        let (half, axis, angles) = (half.to_bits(), axis.to_bits(), angles.to_bits());
        let step = F::from_bits((half >> 24) << 23);
        Self {
            centre: Vec3::new(x, y, z),
            half: Vec3::new(length(half, step), length(half >> 8, step), length(half >> 16, step)),
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
        let Node { centre, half, strength, axis, spread, edge, below } = *node;
        let [centre, half, axis] = [centre, half, axis].map(vector);
        Self { centre, half, strength: l.f(strength.0), axis, spread: l.f(spread.0), edge: l.f(edge.0), below: Below(l.u(below.0.0)) }
    }
    /// Importance: about the illuminance at `p` on a surface of normal `n` (zero: no surface), zero only where none of the light can arrive.
    ///
    /// Cosines are means over the box, which for lamps of one ceiling are those of all of them, seen from the box's nearest point: near ones count most.
    #[inline(always)]
    pub(super) fn importance(&self, l: L, p: Vec3<L>, n: Vec3<L>) -> F<L> {
        let towards = self.centre - p;
        let squared = towards.length_squared().max(f32::MIN_POSITIVE);
        let scatter = self.half.length_squared() * SCATTERED;
        let nearness = self.gap(towards).length_squared().max(f32::MIN_POSITIVE).inverse_root();
        let receiver = (mean_above(n.dot(towards), self.reach(n)) * nearness).min(1.0);

        let leaving = -self.axis.dot(towards);
        let leaving = (self.below.0 & TWO_SIDED).ne(0).select(leaving.abs(), leaving);
        let distance = squared.sqrt();
        let slack = self.reach(self.axis) + self.spread * distance;
        let fading = (mean_above(leaving, slack) * nearness).clamp(EMITTER_FLOOR, 1.0);
        let flat = (self.below.0 & COSINE).ne(0);
        let in_front = !flat | (leaving + slack).ge(0.0);
        let in_beam = (squared * SCATTERED).le(scatter) | (leaving + self.half.x + self.half.y + self.half.z).ge(self.edge * distance);
        let emitter = flat.select(fading, l.f(1.0)).keep_if(in_front & in_beam);

        // One light comes no nearer than its own size; of several, some are farther than their middle.
        let widening = self.below.is_leaf().select(squared.max(scatter), squared + scatter);
        (self.strength * lifted(l, n, receiver) * emitter / widening.max(f32::MIN_POSITIVE)).min(1e30)
    }
    /// Importance for a whole way: about the illuminance integrated along it, never zero.
    #[inline(always)]
    pub(super) fn importance_along(&self, way: &LightWay<L>) -> F<L> {
        let size = self.half.length();
        (self.strength * way.seen_from(self.centre, size * 0.5).nearness()).min(1e30)
    }
    /// From the point to the box, along each axis.
    #[inline(always)]
    fn gap(&self, towards: Vec3<L>) -> Vec3<L> {
        Vec3::new(beyond(towards.x, self.half.x), beyond(towards.y, self.half.y), beyond(towards.z, self.half.z))
    }
    /// How far the box reaches along a direction from its middle.
    #[inline(always)]
    fn reach(&self, direction: Vec3<L>) -> F<L> {
        direction.x.abs() * self.half.x + direction.y.abs() * self.half.y + direction.z.abs() * self.half.z
    }
}

/// How much farther than half an edge it is to the box's middle.
#[inline(always)]
fn beyond<L: Lanes>(way: F<L>, half: F<L>) -> F<L> {
    (way.abs() - half).max(0.0)
}

/// About the mean of what is above zero of values spread evenly about `middle`, zero only if none is.
#[inline(always)]
fn mean_above<L: Lanes>(middle: F<L>, spread: F<L>) -> F<L> {
    middle.max((middle + spread).max(0.0) * 0.25)
}

/// A length of so many steps in the lower eight bits.
#[inline(always)]
fn length<L: Lanes>(bits: U<L>, step: F<L>) -> F<L> {
    (bits & 255).i32_to_float() * step
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
