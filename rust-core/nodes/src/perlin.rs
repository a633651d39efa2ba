//! Gradient noise in one to four dimensions: Perlin's of 2002 ("Improving Noise") with gradients chosen by Jenkins's hash instead of a table, as
//! OSL, Cycles and MaterialX have it.

use crate::hash::{hash1, hash2, hash3, hash4};
use crate::periodic::remainder;
use gonio_simd::{F, Lanes, U};

/// What the sums of gradients are scaled by in one to four dimensions.
pub const SCALES: [f32; 4] = [0.25, 0.6616, 0.982, 0.8344];
/// The period on each axis, so that numbers stay small enough for the cells to be resolved.
const PERIOD: f32 = 100_000.0;
/// From here on floats hold hardly more than whole numbers, where gradient noise is zero: points are moved to the middle of their cells.
const COARSE: f32 = 1_000_000.0;
const SIGN: u32 = 0x8000_0000;

/// A coordinate between two corners of its cell.
struct Axis<L: Lanes> {
    /// The numbers of the corners.
    corner: [U<L>; 2],
    /// The way from each corner to the point.
    way: [F<L>; 2],
    /// The second corner's weight.
    weight: F<L>,
}

impl<L: Lanes> Axis<L> {
    #[inline(always)]
    fn new(x: F<L>) -> Self {
        let below = x.floor();
        let number = below.to_i32();
        let t = x - below;
        let weight = (t * t) * (t * t.mul_add(t.mul_add(6.0, -15.0), 10.0));
        Self { corner: [number, number + 1], way: [t, t - 1.0], weight }
    }
}

/// The value with its sign turned where bit `bit` of the hash is set.
#[inline(always)]
fn turned<L: Lanes>(x: F<L>, hash: U<L>, bit: u32) -> F<L> {
    F::from_bits(x.to_bits() ^ ((hash << (31 - bit)) & SIGN))
}

/// The gradient that the hash chooses (±1 to ±8), along the way.
#[inline(always)]
fn gradient1<L: Lanes>(hash: U<L>, x: F<L>) -> F<L> {
    turned(((hash & 7) + 1).i32_to_float() * x, hash, 3)
}

/// As above, of the eight (±1, ±2) and (±2, ±1).
#[inline(always)]
fn gradient2<L: Lanes>(hash: U<L>, x: F<L>, y: F<L>) -> F<L> {
    let along_x = (hash & 4).eq(0);
    let (once, twice) = (along_x.select(x, y), along_x.select(y, x));
    turned(twice, hash, 1).mul_add(2.0, turned(once, hash, 0))
}

/// As above, of a cube's twelve edges, four of them twice.
#[inline(always)]
fn gradient3<L: Lanes>(hash: U<L>, x: F<L>, y: F<L>, z: F<L>) -> F<L> {
    let first = (hash & 8).eq(0).select(x, y);
    let second = (hash & 13).eq(12).select(x, z);
    let second = (hash & 12).eq(0).select(y, second);
    turned(first, hash, 0) + turned(second, hash, 1)
}

/// As above, of the 32 edges of a cube in four dimensions.
#[inline(always)]
fn gradient4<L: Lanes>(hash: U<L>, [x, y, z, w]: [F<L>; 4]) -> F<L> {
    let quarter = hash & 24;
    let first = quarter.eq(24).select(y, x);
    let second = (hash & 16).eq(0).select(y, z);
    let third = quarter.eq(0).select(z, w);
    turned(first, hash, 0) + turned(second, hash, 1) + turned(third, hash, 2)
}

#[inline(always)]
fn between<L: Lanes, const C: usize>(mut low: [F<L>; C], high: [F<L>; C], t: F<L>) -> [F<L>; C] {
    for (low, high) in low.iter_mut().zip(high) {
        *low = low.lerp(high, t);
    }
    low
}

#[inline(always)]
fn scaled<L: Lanes, const C: usize>(mut values: [F<L>; C], dimensions: usize) -> [F<L>; C] {
    for value in &mut values {
        *value *= SCALES[dimensions - 1];
    }
    values
}

#[inline(always)]
fn noise1<L: Lanes>(x: F<L>) -> F<L> {
    let x = Axis::new(x);
    let low = gradient1(hash1(x.way[0].lanes(), x.corner[0]), x.way[0]);
    let high = gradient1(hash1(x.way[0].lanes(), x.corner[1]), x.way[1]);
    low.lerp(high, x.weight) * SCALES[0]
}

/// The gradients' values of `C` channels at a corner.
#[inline(always)]
fn corner2<L: Lanes, const C: usize>(x: &Axis<L>, y: &Axis<L>, [i, j]: [usize; 2]) -> [F<L>; C] {
    let l = x.weight.lanes();
    let hash = hash2(l, x.corner[i], y.corner[j]);
    let mut out = [l.f(0.0); C];
    for (channel, out) in out.iter_mut().enumerate() {
        *out = gradient2(hash >> (8 * channel as u32), x.way[i], y.way[j]);
    }
    out
}

/// As above, in three dimensions.
#[inline(always)]
fn corner3<L: Lanes, const C: usize>(axes: &[Axis<L>; 3], [i, j, k]: [usize; 3]) -> [F<L>; C] {
    let [x, y, z] = axes;
    let l = x.weight.lanes();
    let hash = hash3(l, x.corner[i], y.corner[j], z.corner[k]);
    let mut out = [l.f(0.0); C];
    for (channel, out) in out.iter_mut().enumerate() {
        *out = gradient3(hash >> (8 * channel as u32), x.way[i], y.way[j], z.way[k]);
    }
    out
}

/// The values between the four corners of a square.
#[inline(always)]
fn square3<L: Lanes, const C: usize>(axes: &[Axis<L>; 3], k: usize) -> [F<L>; C] {
    let [x, y, _] = axes;
    let low = between(corner3(axes, [0, 0, k]), corner3(axes, [1, 0, k]), x.weight);
    let high = between(corner3(axes, [0, 1, k]), corner3(axes, [1, 1, k]), x.weight);
    between(low, high, y.weight)
}

/// The gradient's value at a corner.
#[inline(always)]
fn corner4<L: Lanes>(axes: &[Axis<L>; 4], [i, j, k, m]: [usize; 4]) -> F<L> {
    let [x, y, z, w] = axes;
    let hash = hash4(x.weight.lanes(), x.corner[i], y.corner[j], z.corner[k], w.corner[m]);
    gradient4(hash, [x.way[i], y.way[j], z.way[k], w.way[m]])
}

/// The value between the four corners of a square.
#[inline(always)]
fn square4<L: Lanes>(axes: &[Axis<L>; 4], k: usize, m: usize) -> F<L> {
    let [x, y, ..] = axes;
    let low = corner4(axes, [0, 0, k, m]).lerp(corner4(axes, [1, 0, k, m]), x.weight);
    let high = corner4(axes, [0, 1, k, m]).lerp(corner4(axes, [1, 1, k, m]), x.weight);
    low.lerp(high, y.weight)
}

/// Noise of `C` channels, at most four, each from eight bits of the hash, at a point not wrapped.
#[inline(always)]
pub fn noise2<L: Lanes, const C: usize>([x, y]: [F<L>; 2]) -> [F<L>; C] {
    let (x, y) = (Axis::new(x), Axis::new(y));
    let low = between(corner2(&x, &y, [0, 0]), corner2(&x, &y, [1, 0]), x.weight);
    let high = between(corner2(&x, &y, [0, 1]), corner2(&x, &y, [1, 1]), x.weight);
    scaled(between(low, high, y.weight), 2)
}

/// Noise of `C` channels, at most four, each from eight bits of the hash, at a point not wrapped.
#[inline(always)]
pub fn noise3<L: Lanes, const C: usize>([x, y, z]: [F<L>; 3]) -> [F<L>; C] {
    let axes = [Axis::new(x), Axis::new(y), Axis::new(z)];
    scaled(between(square3(&axes, 0), square3(&axes, 1), axes[2].weight), 3)
}

#[inline(always)]
fn noise4<L: Lanes>([x, y, z, w]: [F<L>; 4]) -> F<L> {
    let axes = [Axis::new(x), Axis::new(y), Axis::new(z), Axis::new(w)];
    let low = square4(&axes, 0, 0).lerp(square4(&axes, 1, 0), axes[2].weight);
    let high = square4(&axes, 0, 1).lerp(square4(&axes, 1, 1), axes[2].weight);
    low.lerp(high, axes[3].weight) * SCALES[3]
}

/// The point moved into Cycles's period, and where it is coarse to the middle of its cell.
#[inline(always)]
fn wrapped<L: Lanes, const N: usize>(mut p: [F<L>; N]) -> [F<L>; N] {
    let mut farthest = p[0].abs();
    for x in &p[1..] {
        farthest = farthest.max(x.abs());
    }
    if farthest.ge(PERIOD).any() {
        for x in &mut p {
            *x = remainder(*x, PERIOD) + x.lanes().f(0.5).keep_if(x.abs().ge(COARSE));
        }
    }
    p
}

/// Cycles's noise, about in [-1, 1], in `N` dimensions from one to four. Not finite where a coordinate is not.
#[inline(always)]
pub fn signed<L: Lanes, const N: usize>(l: L, p: [F<L>; N]) -> F<L> {
    match wrapped(p)[..] {
        [x] => noise1(x),
        [x, y] => noise2::<L, 1>([x, y])[0],
        [x, y, z] => noise3::<L, 1>([x, y, z])[0],
        [x, y, z, w] => noise4([x, y, z, w]),
        _ => l.f(0.0),
    }
}

/// As above, about in [0, 1].
#[inline(always)]
pub fn unsigned<L: Lanes, const N: usize>(l: L, p: [F<L>; N]) -> F<L> {
    signed(l, p).mul_add(0.5, 0.5)
}
