//! Light scattered once, by air and dust, and absorbed by ozone; wavelength by wavelength.

use super::{Atmosphere, Model, distance_to};
use crate::sky::colour::planck;
use gonio_formats::bsdf::cie_1931;
use std::f64::consts::PI;

/// Radii of the ground and of the top, m.
const GROUND: f64 = 6_360e3;
const TOP: f64 = 6_420e3;
/// Heights in which the air and the dust thin out to 1/e, m.
const AIR_HEIGHT: f64 = 8e3;
const DUST_HEIGHT: f64 = 1.2e3;
/// Dust: scattering in 1/m, extinction over scattering, and the mean cosine of the angle by which it scatters.
const DUST_SCATTERING: f64 = 2e-5;
const DUST_EXTINCTION: f64 = 1.11;
const DUST_MEAN_COSINE: f64 = 0.76;
/// Scattering by air at 1 µm, 1/m; it falls with the fourth power of the wavelength.
const AIR_SCATTERING: f64 = 1.131_17e-6;
/// Pieces of the way that is looked along.
const STEPS: usize = 32;
/// Wavelengths: first, step, nm.
const WAVELENGTHS: [f64; 2] = [380.0, 20.0];
/// Absorption by ozone at its densest, 1/m, at the wavelengths.
const OZONE_ABSORPTION: [f64; 21] = [
    3.251_268e-9,
    5.853_954e-9,
    1.977_191e-8,
    7.309_569e-8,
    2.008_456e-7,
    4.038_396e-7,
    6.355_134e-7,
    9.670_704e-7,
    1.547_974e-6,
    2.090_386e-6,
    2.461_281e-6,
    2.735_513e-6,
    2.151_259e-6,
    1.590_518e-6,
    1.123_562e-6,
    7.352_755e-7,
    4.645_013e-7,
    3.309_608e-7,
    2.251_261e-7,
    1.487_913e-7,
    1.682_862e-7,
];
/// Gauss and Laguerre's rule of eight points over a way to the top: places over its length, and weights with the exponential taken out.
const RULE: [[f64; 2]; 8] = [
    [0.170_279_632_305, 0.437_723_410_493],
    [0.903_701_776_799, 1.033_869_347_666],
    [2.251_086_629_866, 1.669_709_765_659],
    [4.266_700_170_288, 2.376_924_701_758],
    [7.045_905_402_393, 3.208_540_913_348],
    [10.758_516_010_181, 4.268_575_510_826],
    [15.740_678_641_278, 5.818_083_368_672],
    [22.863_131_736_889, 8.906_226_215_292],
];
/// The rule's length that the way to the top takes, so that its last point lies within.
const RULE_LENGTH: f64 = 25.0;

/// Even pieces of the way to the top, where the rule is not in use.
const PIECES: usize = 16;

/// Places on the way to the top and their weights, over its length.
type Rule = Vec<[f64; 2]>;

/// The rule over the way's length.
pub(super) fn gauss_laguerre() -> Rule {
    RULE.map(|pair| pair.map(|x| x / RULE_LENGTH)).to_vec()
}

/// The middles of even pieces.
pub(super) fn even_pieces() -> Rule {
    (0..PIECES).map(|piece| [(piece as f64 + 0.5) / PIECES as f64, 1.0 / PIECES as f64]).collect()
}

/// Lengths in the densest air, dust and ozone, m.
type Depths = [f64; 3];

/// One wavelength's coefficients, 1/m, and how the eye sees it.
struct Line {
    air: f64,
    ozone: f64,
    irradiance: f64,
    seen: [f64; 3],
}

/// The atmosphere, line by line.
pub(super) struct Single {
    radius: f64,
    amounts: [f64; 3],
    lines: Vec<Line>,
    rule: Rule,
}

impl Single {
    pub(super) fn new(of: &Atmosphere, rule: Rule) -> Self {
        let line = |(index, ozone): (usize, &f64)| {
            let nanometres = WAVELENGTHS[0] + WAVELENGTHS[1] * index as f64;
            Line {
                air: AIR_SCATTERING / (nanometres * 1e-3).powi(4),
                ozone: *ozone,
                irradiance: planck(nanometres),
                seen: cie_1931(nanometres).map(|value| value * WAVELENGTHS[1]),
            }
        };
        let lines = OZONE_ABSORPTION.iter().enumerate().map(line).collect();
        Self { radius: GROUND + of.altitude_m.clamp(1.0, TOP - GROUND - 1.0), amounts: [of.air, of.dust, of.ozone], lines, rule }
    }

    /// The sum over the wavelengths of the sun's light behind depths, times a factor for each.
    fn seen(&self, depths: Depths, factor: impl Fn(&Line) -> f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for line in &self.lines {
            let depth = line.air * depths[0] + DUST_EXTINCTION * DUST_SCATTERING * depths[1] + line.ozone * depths[2];
            let value = (-depth).exp() * line.irradiance * factor(line);
            sum = std::array::from_fn(|i| sum[i] + value * line.seen[i]);
        }
        sum
    }

    fn densities(&self, radius: f64) -> Depths {
        let height = radius - GROUND;
        let ozone = (1.0 - (height - 25e3).abs() / 15e3).max(0.0);
        [self.amounts[0] * (-height / AIR_HEIGHT).exp(), self.amounts[1] * (-height / DUST_HEIGHT).exp(), self.amounts[2] * ozone]
    }

    /// Depths from a place to the top, in a direction that rises with the sine `up` there.
    fn depths_to_top(&self, radius: f64, up: f64) -> Depths {
        let length = distance_to(radius, up, TOP).unwrap_or(0.0);
        let mut sum = [0.0; 3];
        for [place, weight] in &self.rule {
            let way = length * place;
            let densities = self.densities((radius * radius + way * way + 2.0 * radius * way * up).sqrt());
            sum = std::array::from_fn(|i| sum[i] + densities[i] * weight * length);
        }
        sum
    }
}

impl Model for Single {
    fn radiance(&self, direction: [f64; 3], sun: [f64; 3]) -> [f64; 3] {
        let up = direction[2];
        if up < 0.0 {
            return [0.0; 3];
        }
        let cosine: f64 = direction.iter().zip(sun).map(|(a, b)| a * b).sum();
        let [air_phase, dust_phase] = phases(cosine);
        let step = distance_to(self.radius, up, TOP).unwrap_or(0.0) / STEPS as f64;
        let (mut depths, mut sum) = ([0.0; 3], [0.0; 3]);
        for index in 0..STEPS {
            let way = (index as f64 + 0.5) * step;
            let place = [direction[0] * way, direction[1] * way, self.radius + up * way];
            let radius = place.iter().map(|x| x * x).sum::<f64>().sqrt();
            let densities = self.densities(radius);
            depths = std::array::from_fn(|i| depths[i] + step * densities[i]);
            let sun_up = place.iter().zip(sun).map(|(a, b)| a * b).sum::<f64>() / radius;
            // Earth stands in the way.
            if sun_up < 0.0 && distance_to(radius, sun_up, GROUND).is_some() {
                continue;
            }
            let to_sun = self.depths_to_top(radius, sun_up);
            let scattered = |line: &Line| step * (air_phase * densities[0] * line.air + dust_phase * densities[1] * DUST_SCATTERING);
            let light = self.seen(std::array::from_fn(|i| depths[i] + to_sun[i]), scattered);
            sum = std::array::from_fn(|i| sum[i] + light[i]);
        }
        sum
    }

    fn sun_irradiance(&self, elevation: f64) -> [f64; 3] {
        let [air, dust, _] = self.depths_to_top(self.radius, elevation.max(0.0).sin());
        // Blender's disc is not dimmed by ozone.
        self.seen([air, dust, 0.0], |_| 1.0)
    }
}

/// How air (Rayleigh) and dust (Cornette and Shanks) scatter by an angle, 1/sr.
fn phases(cosine: f64) -> [f64; 2] {
    let (g, square) = (DUST_MEAN_COSINE, 1.0 + cosine * cosine);
    let dust = 3.0 * (1.0 - g * g) * square / (8.0 * PI * (2.0 + g * g) * (1.0 + g * g - 2.0 * g * cosine).powf(1.5));
    [3.0 * square / (16.0 * PI), dust]
}
