//! One of the models at work: relative luminance in a direction, and its sum over a level surface.

use super::{CieSky, HosekWilkie, PerezSky};
use crate::colour::luminance;
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps from the zenith to the horizon and in half a turn.
const STEPS: [usize; 2] = [360, 180];

/// How luminance is spread over the sky.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one of them a sky")]
pub(super) enum Distribution {
    /// No light.
    Dark,
    /// Relative to the zenith.
    Cie(CieSky),
    /// In units of its own.
    Perez(PerezSky),
    /// In cd/m².
    HosekWilkie(HosekWilkie),
}

impl Distribution {
    /// Luminance towards a height above the horizon of sine `up`, `angle` radians from the sun.
    pub(super) fn luminance(&self, up: f64, angle: f64) -> f64 {
        match self {
            Self::Dark => 0.0,
            Self::Cie(sky) => sky.relative_luminance(up, angle),
            Self::Perez(sky) => sky.relative_luminance(up, angle),
            Self::HosekWilkie(sky) => luminance(sky.radiance(up, angle)),
        }
    }

    /// Illuminance of a level surface under a sun `zenith_angle` radians from the zenith.
    pub(super) fn horizontal(&self, zenith_angle: f64) -> f64 {
        let (sun_flat, sun_up) = zenith_angle.sin_cos();
        let mut sum = 0.0;
        for row in 0..STEPS[0] {
            let (flat, up) = (FRAC_PI_2 * (row as f64 + 0.5) / STEPS[0] as f64).sin_cos();
            for column in 0..STEPS[1] {
                let cosine = up * sun_up + flat * sun_flat * (PI * (column as f64 + 0.5) / STEPS[1] as f64).cos();
                sum += flat * up * self.luminance(up, cosine.clamp(-1.0, 1.0).acos());
            }
        }
        PI * PI * sum / (STEPS[0] * STEPS[1]) as f64
    }
}
