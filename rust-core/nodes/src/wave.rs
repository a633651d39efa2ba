//! Blender's Wave Texture.

use crate::finite::finite;
use crate::fractal::{MOST_DETAIL, NoiseKind, Octaves, fractal};
use crate::periodic::sine;
use core::f32::consts::{FRAC_PI_2, TAU};
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// Phase a unit of length.
const FREQUENCY: f32 = 20.0;

/// What waves are in line with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum WaveShape {
    /// Bands across the x axis.
    #[default]
    BandsX,
    /// Bands across the y axis.
    BandsY,
    /// Bands across the z axis.
    BandsZ,
    /// Bands across the diagonal.
    BandsDiagonal,
    /// Rings about the x axis.
    RingsX,
    /// Rings about the y axis.
    RingsY,
    /// Rings about the z axis.
    RingsZ,
    /// Spheres about the origin.
    RingsSpherical,
}

/// How a wave rises and falls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum WaveProfile {
    /// A sine.
    #[default]
    Sine,
    /// Up in a line, down at once.
    Saw,
    /// Up and down in lines.
    Triangle,
}

/// Bands or rings, distorted by noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct WaveTexture {
    /// What waves are in line with.
    pub shape: WaveShape,
    /// How a wave rises and falls.
    pub profile: WaveProfile,
}

impl WaveTexture {
    /// The inputs' names.
    pub const INPUTS: [&str; 9] = ["x", "y", "z", "scale", "distortion", "detail", "detail_scale", "detail_roughness", "phase"];
    /// The value, which is the colour's components too.
    pub const OUTPUTS: usize = 1;

    /// The value at the points, in [0, 1].
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 9]) -> [F<L>; 1] {
        let [x, y, z, scale, distortion, detail, detail_scale, roughness, phase] = *inputs;
        let mut p = [x, y, z];
        for x in &mut p {
            // Cycles's: whole numbers lie on no edge.
            *x = (*x * scale + 0.000_001) * 0.999_999;
        }
        let mut angle = self.distance(p) + phase;
        if !distortion.eq(0.0).all() {
            for x in &mut p {
                *x *= detail_scale;
            }
            let (one, detail) = (l.f(1.0), detail.clamp(0.0, MOST_DETAIL));
            let octaves = Octaves { detail, roughness, lacunarity: l.f(2.0), offset: one, gain: one };
            let noise = fractal(l, NoiseKind::Fbm, true, p, &octaves) * 2.0 - 1.0;
            angle += (distortion * noise).keep_if(!distortion.eq(0.0));
        }
        [finite(self.height(angle)).saturate()]
    }

    /// The way across the waves, as a phase.
    #[inline(always)]
    fn distance<L: Lanes>(&self, [x, y, z]: [F<L>; 3]) -> F<L> {
        match self.shape {
            WaveShape::BandsX => x * FREQUENCY,
            WaveShape::BandsY => y * FREQUENCY,
            WaveShape::BandsZ => z * FREQUENCY,
            WaveShape::BandsDiagonal => (x + y + z) * (0.5 * FREQUENCY),
            WaveShape::RingsX => (y * y + z * z).sqrt() * FREQUENCY,
            WaveShape::RingsY => (x * x + z * z).sqrt() * FREQUENCY,
            WaveShape::RingsZ => (x * x + y * y).sqrt() * FREQUENCY,
            WaveShape::RingsSpherical => (x * x + y * y + z * z).sqrt() * FREQUENCY,
        }
    }

    /// The height at a phase.
    #[inline(always)]
    fn height<L: Lanes>(&self, angle: F<L>) -> F<L> {
        let turns = angle / TAU;
        match self.profile {
            WaveProfile::Sine => 0.5 + 0.5 * sine(angle - FRAC_PI_2),
            WaveProfile::Saw => turns - turns.floor(),
            WaveProfile::Triangle => (turns - (turns + 0.5).floor()).abs() * 2.0,
        }
    }
}
