//! Fractal sums of gradient noise.

use crate::perlin;
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// The most octaves behind the first.
pub(crate) const MOST_DETAIL: f32 = 15.0;
/// A hybrid multifractal's weight below which further octaves are left out.
const LEAST_WEIGHT: f32 = 0.001;

/// How octaves are put together (Ebert, Musgrave, Peachey, Perlin and Worley, Texturing and Modeling, 3rd edition, chapter 16).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoiseKind {
    /// Fractal Brownian motion: the sum.
    #[default]
    Fbm,
    /// The product.
    Multifractal,
    /// Sums and products: valleys are smooth, peaks are rough.
    HybridMultifractal,
    /// Sharp ridges.
    RidgedMultifractal,
    /// Each octave scaled by the height so far.
    HeteroTerrain,
}

/// What varies from point to point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Octaves<L: Lanes> {
    /// Octaves behind the first in [0, [`MOST_DETAIL`]]; a fraction adds one in part.
    pub(crate) detail: F<L>,
    /// An octave's amplitude relative to the one before.
    pub(crate) roughness: F<L>,
    /// An octave's frequency relative to the one before.
    pub(crate) lacunarity: F<L>,
    /// Added to the noise by hybrid, ridged and terrain.
    pub(crate) offset: F<L>,
    /// What a hybrid's or ridge's height counts in the next octave.
    pub(crate) gain: F<L>,
}

/// A sum under way.
struct Sum<L: Lanes> {
    /// The value of all whole octaves; but for Brownian motion, with the last in part.
    value: F<L>,
    /// The next octave's amplitude.
    amplitude: F<L>,
    /// A hybrid's weight of the next octave, or a ridge's last signal.
    carry: F<L>,
    /// Brownian motion: amplitudes of whole octaves, and value and amplitude of the one in part.
    total: F<L>,
    part: [F<L>; 2],
}

impl<L: Lanes> Sum<L> {
    #[inline(always)]
    fn new(l: L, kind: NoiseKind) -> Self {
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let value = if kind == NoiseKind::Multifractal { one } else { zero };
        Self { value, amplitude: one, carry: one, total: zero, part: [zero; 2] }
    }

    /// One more octave: `share` of it, from none to all.
    #[inline(always)]
    fn add(&mut self, kind: NoiseKind, noise: F<L>, share: F<L>, first: bool, octaves: &Octaves<L>) {
        let amplitude = self.amplitude;
        match kind {
            NoiseKind::Fbm => {
                let whole = share.ge(1.0);
                let counted = amplitude.keep_if(whole);
                self.value = noise.mul_add(counted, self.value);
                self.total += counted;
                let rest = amplitude.keep_if(share.gt(0.0).and_not(whole));
                self.part = [noise.mul_add(rest, self.part[0]), self.part[1] + rest];
            }
            NoiseKind::Multifractal => self.value *= noise.mul_add(share * amplitude, 1.0),
            NoiseKind::HeteroTerrain if first => self.value = noise + octaves.offset,
            NoiseKind::HeteroTerrain => self.value += share * ((noise + octaves.offset) * amplitude * self.value),
            NoiseKind::HybridMultifractal => {
                let weight = self.carry.min(1.0);
                let signal = (noise + octaves.offset) * amplitude;
                let alive = self.carry.gt(LEAST_WEIGHT);
                self.value += (share * weight * signal).keep_if(alive);
                self.carry = alive.select(weight * (octaves.gain * signal), self.carry);
            }
            NoiseKind::RidgedMultifractal => {
                let ridge = (octaves.offset - noise.abs()).squared();
                let weight = if first { share } else { (self.carry * octaves.gain).saturate() };
                self.carry = ridge * weight;
                self.value += (self.carry * amplitude).keep_if(share.ge(1.0));
            }
        }
        self.amplitude = amplitude * octaves.roughness;
    }

    /// The value, of Brownian motion with the octave in part.
    #[inline(always)]
    fn finish(self, kind: NoiseKind, normalize: bool, detail: F<L>) -> F<L> {
        if kind != NoiseKind::Fbm {
            return self.value;
        }
        let (mut low, mut high) = (self.value, self.value + self.part[0]);
        if normalize {
            low = 0.5 * low / self.total + 0.5;
            high = 0.5 * high / (self.total + self.part[1]) + 0.5;
        }
        low.lerp(high, detail - detail.floor())
    }
}

/// The sum of octaves at a point.
#[inline(always)]
pub(crate) fn fractal<L: Lanes, const N: usize>(l: L, kind: NoiseKind, normalize: bool, p: [F<L>; N], octaves: &Octaves<L>) -> F<L> {
    let mut sum = Sum::new(l, kind);
    let (mut q, mut scale) = (p, l.f(1.0));
    for octave in 0..=MOST_DETAIL as u32 {
        let share = (octaves.detail - (octave as f32 - 1.0)).saturate();
        // A ridge has no octave in part, a hybrid ends early.
        let wanted = match kind {
            NoiseKind::RidgedMultifractal => share.ge(1.0),
            NoiseKind::HybridMultifractal => share.gt(0.0) & sum.carry.gt(LEAST_WEIGHT),
            _ => share.gt(0.0),
        };
        if !wanted.any() {
            break;
        }
        sum.add(kind, perlin::signed(l, q), share, octave == 0, octaves);
        // In the order of Cycles's operations, since a coordinate's last bits count in high octaves.
        scale *= octaves.lacunarity;
        for (q, p) in q.iter_mut().zip(p) {
            *q = if kind == NoiseKind::Fbm { scale * p } else { *q * octaves.lacunarity };
        }
    }
    sum.finish(kind, normalize, octaves.detail)
}
