//! Blender's Noise Texture.

use crate::finite::finite;
use crate::fractal::{MOST_DETAIL, NoiseKind, Octaves, fractal};
use crate::hash::{hash1, hash2, to_unit};
use crate::perlin;
use gonio_simd::{F, Lanes, One};
use serde::{Deserialize, Serialize};

/// Fractal gradient noise in one to four dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NoiseTexture {
    /// From 1 (`w` alone) to 4; 2 takes `x` and `y`.
    pub dimensions: u8,
    /// How octaves are put together.
    pub kind: NoiseKind,
    /// Whether Brownian motion is brought to [0, 1]; the other kinds never are.
    pub normalize: bool,
    /// Whether green and blue are wanted; if not, they are the value as well.
    pub color: bool,
}

impl Default for NoiseTexture {
    fn default() -> Self {
        Self { dimensions: 3, kind: NoiseKind::Fbm, normalize: true, color: true }
    }
}

/// The shift that makes an independent noise of the same one, on an axis: a number in [100, 200].
#[inline(always)]
fn shift(seed: usize, axis: usize, dimensions: usize) -> f32 {
    let (l, seed, axis) = (One, (seed as f32).to_bits(), (axis as f32).to_bits());
    let hash = if dimensions == 1 { hash1(l, l.u(seed)) } else { hash2(l, l.u(seed), l.u(axis)) };
    100.0 + to_unit(hash).0 * 100.0
}

#[inline(always)]
fn shifted<L: Lanes, const N: usize>(mut p: [F<L>; N], seed: usize) -> [F<L>; N] {
    for (axis, x) in p.iter_mut().enumerate() {
        *x += shift(seed, axis, N);
    }
    p
}

impl NoiseTexture {
    /// The inputs' names.
    pub const INPUTS: [&str; 11] = ["x", "y", "z", "w", "scale", "detail", "roughness", "lacunarity", "offset", "gain", "distortion"];
    /// Value, red (the same), green and blue.
    pub const OUTPUTS: usize = 4;

    /// Value and colour at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 11]) -> [F<L>; 4] {
        let [x, y, z, w, scale, ..] = *inputs;
        let (x, y, z, w) = (x * scale, y * scale, z * scale, w * scale);
        match self.dimensions {
            1 => self.at(l, [w], inputs),
            2 => self.at(l, [x, y], inputs),
            3 => self.at(l, [x, y, z], inputs),
            _ => self.at(l, [x, y, z, w], inputs),
        }
    }

    #[inline(always)]
    fn at<L: Lanes, const N: usize>(&self, l: L, p: [F<L>; N], inputs: &[F<L>; 11]) -> [F<L>; 4] {
        let [.., detail, roughness, lacunarity, offset, gain, distortion] = *inputs;
        let octaves = Octaves { detail: detail.clamp(0.0, MOST_DETAIL), roughness: roughness.max(0.0), lacunarity, offset, gain };
        let p = distorted(l, p, distortion);
        let mut color = [l.f(0.0); 3];
        for (channel, out) in color.iter_mut().enumerate().take(if self.color { 3 } else { 1 }) {
            let q = if channel == 0 { p } else { shifted(p, N + channel - 1) };
            *out = finite(fractal(l, self.kind, self.normalize, q, &octaves));
        }
        let [red, green, blue] = color;
        if self.color { [red, red, green, blue] } else { [red; 4] }
    }
}

/// The point moved by a noise of its own on each axis.
#[inline(always)]
fn distorted<L: Lanes, const N: usize>(l: L, mut p: [F<L>; N], distortion: F<L>) -> [F<L>; N] {
    if distortion.eq(0.0).all() {
        return p;
    }
    let from = p;
    for (axis, x) in p.iter_mut().enumerate() {
        *x += perlin::signed(l, shifted(from, axis)) * distortion;
    }
    p
}
