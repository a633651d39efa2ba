//! MaterialX's standard noises: gradient noise and fractals, in two and three dimensions (1.39's reference in GLSL).
//!
//! The nodes' amplitude and pivot are left to arithmetic: value · amplitude + pivot.

use crate::finite::all_finite;
use crate::perlin::{noise2, noise3};
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// The most octaves of a fractal.
const MOST_OCTAVES: u32 = 32;
/// How far a noise is moved for its fourth channel, and a fractal for its second or fourth.
const NOISE_SHIFT: [f32; 3] = [19.0, 73.0, 29.0];
const FRACTAL_SHIFT: [f32; 3] = [19.0, 193.0, 17.0];

#[inline(always)]
fn shifted<L: Lanes>(mut p: [F<L>; 3], shift: [f32; 3]) -> [F<L>; 3] {
    for (x, shift) in p.iter_mut().zip(shift) {
        *x += shift;
    }
    p
}

/// Gradient noise of `C` channels in two dimensions, or three where `solid`.
#[inline(always)]
fn gradient_noise<L: Lanes, const C: usize>(solid: bool, p: [F<L>; 3]) -> [F<L>; C] {
    if solid { noise3(p) } else { noise2([p[0], p[1]]) }
}

/// Gradient noise, about in [-1, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MxNoise {
    /// 2 (`x` and `y`) or 3.
    pub dimensions: u8,
    /// Channels wanted, from 1 to 4; the others are 0.
    pub channels: u8,
}

impl MxNoise {
    /// The inputs' names.
    pub const INPUTS: [&str; 3] = ["x", "y", "z"];
    /// Four channels.
    pub const OUTPUTS: usize = 4;

    /// The channels at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, p: &[F<L>; 3]) -> [F<L>; 4] {
        let solid = self.dimensions == 3;
        let mut out = [l.f(0.0); 4];
        if self.channels > 1 {
            [out[0], out[1], out[2]] = gradient_noise(solid, *p);
        }
        match self.channels {
            1 => [out[0]] = gradient_noise(solid, *p),
            2 => out[2] = l.f(0.0),
            4 => [out[3]] = gradient_noise(solid, shifted(*p, NOISE_SHIFT)),
            _ => {}
        }
        all_finite(out)
    }
}

/// A sum of octaves of gradient noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MxFractal {
    /// 2 (`x` and `y`) or 3.
    pub dimensions: u8,
    /// Channels wanted, from 1 to 4; the others are 0.
    pub channels: u8,
}

impl MxFractal {
    /// The inputs' names; octaves are cut to a whole number and held to 32.
    pub const INPUTS: [&str; 6] = ["x", "y", "z", "octaves", "lacunarity", "diminish"];
    /// Four channels.
    pub const OUTPUTS: usize = 4;

    /// The channels at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 6]) -> [F<L>; 4] {
        let [x, y, z, ..] = *inputs;
        let p = [x, y, z];
        let mut out = [l.f(0.0); 4];
        if self.channels > 2 {
            [out[0], out[1], out[2]] = self.sum(l, p, inputs);
        }
        // Single channels are the first of one or two, and the last of two or four.
        let single = match self.channels {
            1 => 0..1,
            2 => 0..2,
            4 => 3..4,
            _ => 0..0,
        };
        for channel in single {
            let from = if channel == 0 { p } else { shifted(p, FRACTAL_SHIFT) };
            [out[channel]] = self.sum(l, from, inputs);
        }
        all_finite(out)
    }

    #[inline(always)]
    fn sum<L: Lanes, const C: usize>(&self, l: L, mut p: [F<L>; 3], inputs: &[F<L>; 6]) -> [F<L>; C] {
        let [.., octaves, lacunarity, diminish] = *inputs;
        let mut out = [l.f(0.0); C];
        let mut amplitude = l.f(1.0);
        for octave in 1..=MOST_OCTAVES {
            let counted = octaves.ge(octave as f32);
            if !counted.any() {
                break;
            }
            let noise = gradient_noise::<L, C>(self.dimensions == 3, p);
            let share = amplitude.keep_if(counted);
            for (out, noise) in out.iter_mut().zip(noise) {
                *out = noise.mul_add(share, *out);
            }
            amplitude *= diminish;
            for x in &mut p {
                *x *= lacunarity;
            }
        }
        out
    }
}
