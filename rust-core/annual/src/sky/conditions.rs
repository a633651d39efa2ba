//! Sun and sky of a step by its weather, with the limits of `gendaymtx`.

use super::{Quantity, SkyOptions};
use crate::{
    division::direction,
    sun::Sun,
    year::{Step, Year},
};
use gonio_formats::weather::Quantities;
use gonio_sky::{Clearness, Irradiance, diffuse_efficacy, direct_efficacy};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Irradiance outside the atmosphere at the mean distance, W/m².
const SOLAR_CONSTANT: f64 = 1367.0;
/// The same in lx.
const SOLAR_ILLUMINANCE: f64 = 127_500.0;
/// How near the zenith the sun may come for the spread over the sky, degrees.
const NEAREST_TO_ZENITH_DEG: f64 = 3.0;
/// Less light than this, direct and diffuse together, is night.
const NIGHT: f64 = 1e-4;
/// Turns of the search for irradiances, at most.
const TURNS: usize = 5;
/// The search ends when no irradiance changes by more, W/m².
const CHANGE: f64 = 10.0;

/// Sun and sky of a step, in lx, or in W/m² where the matrix is of solar radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// Where the sun stands, rotated as the matrix is.
    pub sun: Sun,
    /// Of a surface that faces the sun, by its disc.
    pub direct_normal: f64,
    /// Of a level surface, by the sky.
    pub diffuse_horizontal: f64,
    /// Of the sky.
    pub clearness: Clearness,
    /// Radians, of the sun as the spread over the sky sees it: 3 to 90 degrees.
    pub zenith_angle: f64,
}

impl Conditions {
    /// A sky without a sun's disc.
    pub(super) fn of_sky(sun: Sun, horizontal_lux: f64) -> Self {
        let clearness = Clearness { clearness: 1.0, brightness: Clearness::LEAST_BRIGHTNESS };
        Self { sun, direct_normal: 0.0, diffuse_horizontal: horizontal_lux, clearness, zenith_angle: zenith_angle(sun.altitude) }
    }

    /// Of a level surface, by sun and sky.
    pub fn horizontal(&self) -> f64 {
        self.diffuse_horizontal + self.direct_normal * self.sun.altitude.sin().max(0.0)
    }

    /// Unit vector towards the sun as the spread over the sky sees it.
    pub(super) fn limited_sun(&self) -> [f64; 3] {
        direction(FRAC_PI_2 - self.zenith_angle, self.sun.azimuth)
    }
}

fn zenith_angle(altitude: f64) -> f64 {
    (FRAC_PI_2 - altitude.max(0.0)).max(NEAREST_TO_ZENITH_DEG.to_radians())
}

/// What of the step the formulas need.
struct Air {
    zenith_angle: f64,
    air_mass: f64,
    normal: f64,
    dew_point_c: f64,
}

impl Air {
    fn new(step: &Step, options: &SkyOptions) -> Self {
        let zenith_angle = zenith_angle(step.sun.altitude);
        let (sin, cos) = (TAU * (f64::from(step.day_of_year) - 1.0) / 365.0).sin_cos();
        let eccentricity = 1.000_11 + 0.034_221 * cos + 0.001_28 * sin + 0.000_719 * (cos * cos - sin * sin) + 0.000_077 * 2.0 * sin * cos;
        Self {
            zenith_angle,
            // Kasten 1966.
            air_mass: 1.0 / (zenith_angle.cos() + 0.15 * (93.885 - zenith_angle.to_degrees()).powf(-1.253)),
            normal: SOLAR_CONSTANT * eccentricity,
            dew_point_c: options.dew_point_c.unwrap_or(step.dew_point_c),
        }
    }

    fn clearness(&self, irradiance: &Irradiance) -> Clearness {
        Clearness::new(irradiance, self.zenith_angle, self.air_mass, self.normal)
    }

    fn efficacies(&self, clearness: &Clearness) -> [f64; 2] {
        [direct_efficacy(clearness, self.zenith_angle, self.dew_point_c), diffuse_efficacy(clearness, self.zenith_angle, self.dew_point_c)]
    }

    /// Irradiances whose light is `direct` and `diffuse` lx, by the search of `gendaymtx`.
    fn irradiance(&self, direct: f64, diffuse: f64) -> (Irradiance, Clearness) {
        let begin = SOLAR_CONSTANT / SOLAR_ILLUMINANCE;
        let mut found = Irradiance { direct_normal: direct * begin, diffuse_horizontal: diffuse * begin };
        let mut before = Irradiance { direct_normal: 0.1, diffuse_horizontal: 0.1 };
        let mut clearness = self.clearness(&found);
        for _ in 0..TURNS {
            let changes = [found.direct_normal - before.direct_normal, found.diffuse_horizontal - before.diffuse_horizontal];
            if changes.iter().all(|change| change.abs() <= CHANGE) {
                break;
            }
            before = found;
            let [of_sun, of_sky] = self.efficacies(&clearness);
            // Where the sun's efficacy is none, the efficacy itself is taken for the irradiance, as Radiance has it.
            found = Irradiance { direct_normal: if of_sun > 0.1 { direct / of_sun } else { of_sun }, diffuse_horizontal: diffuse / of_sky };
            clearness = self.clearness(&found);
        }
        (found, clearness)
    }
}

/// Sun and sky of a step; `None` at night.
pub(super) fn conditions(year: &Year, step: &Step, options: &SkyOptions) -> Option<Conditions> {
    if step.direct + step.diffuse <= NIGHT {
        return None;
    }
    let air = Air::new(step, options);
    let sine = step.sun.altitude.sin();
    let is_level = year.quantities == Quantities::HorizontalIrradiance && step.sun.altitude > 1e-6;
    let direct = if is_level { step.direct / sine } else { step.direct };
    let (irradiance, clearness) = if year.quantities == Quantities::Illuminance {
        air.irradiance(direct, step.diffuse)
    } else {
        let irradiance = Irradiance { direct_normal: direct, diffuse_horizontal: step.diffuse };
        (irradiance, air.clearness(&irradiance))
    };
    let [direct_normal, diffuse_horizontal] = match (options.quantity, year.quantities) {
        (Quantity::SolarRadiance, _) => [irradiance.direct_normal, irradiance.diffuse_horizontal],
        (Quantity::Luminance, Quantities::Illuminance) => [direct, step.diffuse],
        (Quantity::Luminance, _) => {
            let [of_sun, of_sky] = air.efficacies(&clearness);
            [irradiance.direct_normal * of_sun, irradiance.diffuse_horizontal * of_sky]
        }
    };
    let sun = Sun { azimuth: step.sun.azimuth - options.rotation_deg.to_radians(), ..step.sun };
    Some(Conditions { sun, direct_normal, diffuse_horizontal, clearness, zenith_angle: air.zenith_angle })
}
