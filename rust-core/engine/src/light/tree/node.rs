//! A node in eight words, and the estimate of what its lights bring to a point, on lanes.

use super::bound::Bound;
use crate::light::choice::{EMITTER_FLOOR, lifted, widened};
use crate::light::vector::{Vector, narrow};
use gonio_simd::{F, Lanes, M, U, Vec3};

/// Values of a node: centre (3), radius, strength, axis, cosines, and what is below.
pub(super) const WORDS: usize = 8;

/// In the last word: a light instead of children.
const LEAF: u32 = 1 << 31;
const COSINE: u32 = 1 << 30;
const TWO_SIDED: u32 = 1 << 29;
const COUNT_SHIFT: u32 = 25;
/// The first child or the light, in the last word.
const INDEX: u32 = (1 << COUNT_SHIFT) - 1;
/// Steps of coordinates and cosines in sixteen bits.
const STEPS: f32 = 32767.0;
/// What an axis in sixteen bits a coordinate and a cosine in as many may be wrong by, in cosine.
const SLACK: f64 = 2e-4;

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
    let spread = bound.normals.spread.cos() - SLACK;
    let edge = (bound.normals.spread + bound.edge).min(std::f64::consts::PI).cos() - SLACK;
    let switches = if bound.cosine { COSINE } else { 0 } | if bound.two_sided { TWO_SIDED } else { 0 };
    // A hair larger than told: its corners were rounded to single precision.
    let radius = (bound.radius * 1.0001) as f32;
    let axis = octahedral(bound.normals.axis);
    let packed = [pair(axis[0].round(), axis[1].round()), pair(step_down(spread), step_down(edge)), below | switches];
    let [axis, cosines, last] = packed.map(f32::from_bits);
    [x, y, z, radius, bound.strength as f32, axis, cosines, last]
}

/// The largest sixteen-bit cosine not above.
fn step_down(cosine: f64) -> f32 {
    (cosine.max(-1.0) * f64::from(STEPS)).floor() as f32
}

fn pair(low: f32, high: f32) -> u32 {
    u32::from(low as i16 as u16) | u32::from(high as i16 as u16) << 16
}

/// A unit vector on the octahedron, in steps (Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", 2014).
fn octahedral(v: Vector) -> [f32; 2] {
    let [x, y, z] = narrow(v);
    let scale = 1.0 / (x.abs() + y.abs() + z.abs()).max(f32::MIN_POSITIVE);
    let (x, y) = (x * scale, y * scale);
    let folded = if z < 0.0 { [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)] } else { [x, y] };
    folded.map(|x| x * STEPS)
}

/// A node in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<L: Lanes> {
    centre: Vec3<L>,
    radius: F<L>,
    strength: F<L>,
    axis: U<L>,
    cosines: U<L>,
    last: U<L>,
}

impl<L: Lanes> Node<L> {
    /// The node of each lane.
    #[inline(always)]
    pub(super) fn gather(l: L, words: &[f32], node: U<L>) -> Self {
        let base = node * WORDS as u32;
        let [x, y] = l.gather_pairs(words, base);
        let [z, radius] = l.gather_pairs(words, base + 2);
        let [strength, axis] = l.gather_pairs(words, base + 4);
        let [cosines, last] = l.gather_pairs(words, base + 6);
        Self { centre: Vec3::new(x, y, z), radius, strength, axis: axis.to_bits(), cosines: cosines.to_bits(), last: last.to_bits() }
    }
    /// One node for all lanes.
    #[inline(always)]
    pub(super) fn splat(l: L, words: &[f32; WORDS]) -> Self {
        let [x, y, z, radius, strength, axis, cosines, last] = *words;
        let centre = Vec3::splat(l, [x, y, z]);
        let bits = |x: f32| l.u(x.to_bits());
        Self { centre, radius: l.f(radius), strength: l.f(strength), axis: bits(axis), cosines: bits(cosines), last: bits(last) }
    }
    /// Another node where `mask` is set.
    #[inline(always)]
    pub(super) fn replaced_by(&self, other: &Self, mask: M<L>) -> Self {
        Self {
            centre: mask.select(other.centre, self.centre),
            radius: mask.select(other.radius, self.radius),
            strength: mask.select(other.strength, self.strength),
            axis: mask.select(other.axis, self.axis),
            cosines: mask.select(other.cosines, self.cosines),
            last: mask.select(other.last, self.last),
        }
    }
    #[inline(always)]
    pub(super) fn is_leaf(&self) -> M<L> {
        (self.last & LEAF).ne(0)
    }
    /// The light of a leaf, the first child of another node.
    #[inline(always)]
    pub(super) fn index(&self) -> U<L> {
        self.last & INDEX
    }
    /// Children.
    #[inline(always)]
    pub(super) fn count(&self) -> U<L> {
        (self.last >> COUNT_SHIFT) & 15
    }
    /// About the illuminance at `p` on a surface of normal `n` (zero: no surface), zero only where none of the light can arrive.
    #[inline(always)]
    pub(super) fn illuminance(&self, l: L, p: Vec3<L>, n: Vec3<L>) -> F<L> {
        let towards = self.centre - p;
        let squared = towards.length_squared().max(f32::MIN_POSITIVE);
        let distance = squared.sqrt();
        let direction = towards * distance.recip();
        let sine = (self.radius / distance).min(1.0);
        let cosine = (1.0 - sine * sine).safe_sqrt();
        let inside = squared.le(self.radius * self.radius);
        let facing = n.dot(direction);
        let receiver = self.typical(l, widened(l, facing, sine, cosine), facing, inside);

        let [spread, edge] = self.cosines();
        let leaving = -self.axis().dot(direction);
        let leaving = (self.last & TWO_SIDED).ne(0).select(leaving.abs(), leaving);
        let nearest = widened(l, leaving, sine, cosine);
        let fading = widened(l, nearest, (1.0 - spread * spread).safe_sqrt(), spread);
        let fading = self.typical(l, fading, leaving, inside).max(EMITTER_FLOOR);
        let emitter = (self.last & COSINE).ne(0).select(fading, l.f(1.0)).keep_if(inside | nearest.ge(edge));
        let widening = inside.select(self.mean_square(squared), squared).max(f32::MIN_POSITIVE);
        (self.strength * lifted(l, n, receiver) * emitter / widening).min(1e30)
    }
    /// A cosine between the best that any light of the node may have and that of its middle; all directions occur from inside.
    #[inline(always)]
    fn typical(&self, l: L, best: F<L>, middle: F<L>, inside: M<L>) -> F<L> {
        let single = inside.select(l.f(1.0), best);
        let several = inside.select(l.f(0.6), 0.5 * (best + middle.max(0.0)));
        self.is_leaf().select(single, several)
    }
    /// Squared distance that stands for the lights around a point inside the node's sphere: about the harmonic mean over a full ball; no light comes
    /// nearer than its own size.
    #[inline(always)]
    fn mean_square(&self, squared: F<L>) -> F<L> {
        let own = self.radius * self.radius;
        self.is_leaf().select(own, (own + squared) * (1.0 / 3.0))
    }
    /// Cosines of the normals' spread and of the angle beyond which nothing is sent.
    #[inline(always)]
    fn cosines(&self) -> [F<L>; 2] {
        unpack(self.cosines)
    }
    #[inline(always)]
    fn axis(&self) -> Vec3<L> {
        let [x, y] = unpack(self.axis);
        let z = 1.0 - x.abs() - y.abs();
        let fold = (-z).max(0.0);
        Vec3::new(x - fold.copysign(x), y - fold.copysign(y), z).normalize()
    }
}

/// Two numbers of sixteen bits.
#[inline(always)]
fn unpack<L: Lanes>(packed: U<L>) -> [F<L>; 2] {
    [(packed << 16).sar(16), packed.sar(16)].map(
        #[inline(always)]
        |x| x.i32_to_float() * (1.0 / STEPS),
    )
}
