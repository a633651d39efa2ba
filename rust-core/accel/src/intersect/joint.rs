//! How a piece of a curve is joined to its neighbours, in a word: whether the curve begins here, where the next piece goes, and how fast it thins.
//!
//! | bits | |
//! | --- | --- |
//! | 0 to 23 | octahedral coordinates of the direction of the next piece, 12 bits each |
//! | 24 to 30 | how much less the radius is at its end, over its length: −1 to 1 in 126 steps, rounded up; [`LAST`] where there is none |
//! | 31 | the curve begins here |

use super::line_ray::Vec8;
use super::octahedral::{from_octahedral, octahedral};
use crate::tree::node::WIDTH;
use fearless_simd::{f32x8, mask32x8, prelude::*, u32x8};

const COORDINATE: u32 = (1 << 12) - 1;
const TAPER_SHIFT: u32 = 24;
/// Steps of the taper on either side of zero.
const STEPS: f32 = 63.0;
/// The taper of no next piece.
const LAST: u32 = 127;
const FIRST: u32 = 1 << 31;

/// What a piece has of a shared sphere beyond its share, over the radius and over the coordinates: no ray passes between two pieces for rounding,
/// nor for the next piece's direction in so few bits (6e-4 at most).
pub(super) const OVERLAP: [f32; 2] = [2e-3, 4.0 * f32::EPSILON];

/// A piece's word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Joint(pub(crate) u32);

impl Joint {
    /// Of a piece without neighbours.
    pub(crate) const ALONE: Joint = Joint(LAST << TAPER_SHIFT | FIRST);

    /// Of a piece that ends at `end` (x, y, z, radius), before one that ends at `next`; `first` of its curve.
    pub(crate) fn new(end: &[f32; 4], next: Option<[f32; 4]>, first: bool) -> Self {
        let begins = if first { FIRST } else { 0 };
        Joint(begins | next.and_then(|next| towards(end, &next)).unwrap_or(LAST << TAPER_SHIFT))
    }

    /// Whether the curve begins here.
    pub(super) fn is_first(self) -> bool {
        self.0 & FIRST != 0
    }

    /// Direction of the next piece, not unit, its length, and its taper.
    pub(super) fn next(self) -> Option<([f32; 3], f32, f32)> {
        let taper = (self.0 >> TAPER_SHIFT) & LAST;
        if taper == LAST {
            return None;
        }
        let [x, y] = [0, 12].map(|shift| ((self.0 >> shift) & COORDINATE) as f32 * (2.0 / COORDINATE as f32) - 1.0);
        let way = from_octahedral([x, y]);
        Some((way, way.iter().map(|x| x * x).sum::<f32>().sqrt(), taper as f32 / STEPS - 1.0))
    }
}

/// The bits of the way to the next piece's end; `None` where it is no way.
fn towards(end: &[f32; 4], next: &[f32; 4]) -> Option<u32> {
    let way = [0, 1, 2].map(|k| next[k] - end[k]);
    let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
    let [x, y] = octahedral(way);
    if !(length > 0.0 && x.is_finite() && y.is_finite()) {
        return None;
    }
    let bits = |x: f32| (0.5f32.mul_add(x.clamp(-1.0, 1.0), 0.5) * COORDINATE as f32).round() as u32;
    // A cone that begins to touch the sphere later leaves more of it to the piece before.
    let taper = (((end[3] - next[3]) / length).clamp(-1.0, 1.0) + 1.0) * STEPS;
    Some(bits(x) | bits(y) << 12 | (taper.ceil() as u32).min(LAST - 1) << TAPER_SHIFT)
}

/// The joints of eight pieces.
pub(super) struct Joints<S: Simd> {
    /// Direction of the next piece, not unit, and its length.
    next: Vec8<S>,
    length: f32x8<S>,
    taper: f32x8<S>,
    is_last: mask32x8<S>,
}

impl<S: Simd> Joints<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, joints: &[u32; WIDTH]) -> Self {
        let words = u32x8::from_slice(simd, joints);
        let x = coordinate(words & COORDINATE);
        let y = coordinate((words >> 12) & COORDINATE);
        let z = 1.0 - x.abs() - y.abs();
        let fold = (-z).max(0.0);
        let next = [x - fold.copysign(x), y - fold.copysign(y), z];
        let taper: u32x8<S> = (words >> TAPER_SHIFT) & LAST;
        Joints {
            next,
            length: super::line_ray::dot(next, next).sqrt(),
            taper: taper.to_float::<f32x8<S>>() * (1.0 / STEPS) - 1.0,
            is_last: taper.simd_eq(LAST),
        }
    }

    /// Whether what lies at `out` from the shared sphere's centre belongs to the piece before: it is not beyond where the next cone begins to touch
    /// the sphere. `size` are the largest coordinates there.
    #[inline(always)]
    pub(super) fn has(&self, out: Vec8<S>, radius: f32x8<S>, size: f32x8<S>) -> mask32x8<S> {
        let limit = radius * (self.taper + OVERLAP[0]) + size * OVERLAP[1];
        self.is_last | super::line_ray::dot(self.next, out).simd_le(limit * self.length)
    }

    /// Whether `out` lies on the side of a bend where a disc fills what is between two ribbons.
    #[inline(always)]
    pub(super) fn is_outer(&self, out: Vec8<S>, radius: f32x8<S>) -> mask32x8<S> {
        !self.is_last & super::line_ray::dot(self.next, out).simd_le(radius * self.length * OVERLAP[0])
    }
}

#[inline(always)]
fn coordinate<S: Simd>(bits: u32x8<S>) -> f32x8<S> {
    bits.to_float::<f32x8<S>>() * (2.0 / COORDINATE as f32) - 1.0
}

/// The pieces that begin a curve.
#[inline(always)]
pub(super) fn firsts<S: Simd>(simd: S, joints: &[u32; WIDTH]) -> mask32x8<S> {
    (u32x8::from_slice(simd, joints) & FIRST).simd_eq(FIRST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_hold_what_a_piece_needs_of_the_next() {
        let end = [1.0, -2.0, 0.5, 0.3];
        for way in [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.3, -0.4, -0.866], [-0.6, 0.0, 0.8], [-0.577, -0.577, -0.577]] {
            for taper in [-1.0f32, -0.3, 0.0, 0.01, 0.5, 0.99] {
                let next = [end[0] + way[0], end[1] + way[1], end[2] + way[2], end[3] - taper];
                let (found, length, found_taper) = Joint::new(&end, Some(next), false).next().expect("there is a next one");
                let off: f32 = (0..3).map(|k| (found[k] / length - way[k]).powi(2)).sum::<f32>().sqrt();
                assert!(off < 1e-3, "{way:?}: {found:?}");
                assert!(found_taper >= taper - 1e-3 && found_taper < taper + 0.017, "{taper}: {found_taper}");
            }
        }
        assert!(Joint::new(&end, None, true).next().is_none());
        assert!(Joint::new(&end, Some(end), true).next().is_none() && Joint::new(&end, None, true).is_first());
    }
}
