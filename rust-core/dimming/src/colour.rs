//! Light with its colour, and how it mixes.

use crate::{
    estimate::Estimate,
    problem::{Area, Point},
};
use gonio_spectrum::{cct_of_xyz, isotherm};
use serde::Serialize;

/// Light with its colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Light {
    /// How much there is, lx.
    pub lux: Estimate,
    /// X over Y (CIE 1931).
    pub x: Estimate,
    /// Z over Y.
    pub z: Estimate,
}

/// What a point gets of light with its colour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Colour {
    /// Of what is not dimmed.
    pub fixed: Light,
    /// Of each group at level 1.
    pub of_groups: Vec<Light>,
}

impl Light {
    pub(crate) fn is_finite(&self) -> bool {
        [self.lux, self.x, self.z].iter().all(Estimate::is_finite)
    }

    /// A weighted sum of its tristimulus values, with the error of its amount and that of its colour.
    fn weighed(&self, [of_x, of_y, of_z]: [f64; 3]) -> Estimate {
        let (lux, sum) = (self.lux.value, of_x * self.x.value + of_y + of_z * self.z.value);
        let of_colour = (lux * of_x * self.x.error).hypot(lux * of_z * self.z.error);
        Estimate::new(lux * sum, (sum * self.lux.error).hypot(of_colour))
    }
}

impl Colour {
    fn weighed(&self, weights: [f64; 3]) -> Point {
        Point { fixed: self.fixed.weighed(weights), of_groups: self.of_groups.iter().map(|light| light.weighed(weights)).collect() }
    }
}

/// Part of a temperature by which isotherms are told apart.
const STEP: f64 = 1e-3;

/// X + 15 Y + 3 Z, by which the 1960 diagram divides.
const DIVISOR: [f64; 3] = [1.0, 15.0, 3.0];

impl Area {
    /// What is above zero where the mean light of the points is cooler than so many kelvin: linear in the levels.
    pub(crate) fn cooler_than(&self, kelvin: f64) -> Point {
        self.weighed(isotherm(kelvin))
    }

    /// What that is divided by at given levels, so that it is about a relative temperature.
    pub(crate) fn divisor(&self, levels: &[f64]) -> f64 {
        self.weighed(DIVISOR).at(levels).value
    }

    /// The correlated colour temperature of the mean light of the points, K; not a number where that is not white.
    pub(crate) fn temperature(&self, levels: &[f64]) -> Estimate {
        let sum = |weights: [f64; 3]| self.weighed(weights).at(levels).value;
        let xyz = [sum([1.0, 0.0, 0.0]), sum([0.0, 1.0, 0.0]), sum([0.0, 0.0, 1.0])];
        let Some((kelvin, _)) = Some(xyz).filter(|xyz| xyz[1] > 0.0).and_then(cct_of_xyz) else {
            return Estimate::new(f64::NAN, f64::NAN);
        };
        // Off the blackbodies isotherms are nearer to one another, or further apart.
        let side = |ratio: f64| self.cooler_than(kelvin * ratio).at(levels);
        let slope = (side(1.0 - STEP).value - side(1.0 + STEP).value) / (2.0 * STEP);
        Estimate::new(kelvin, kelvin * side(1.0).error / slope.abs())
    }

    /// The mean of the points.
    fn weighed(&self, weights: [f64; 3]) -> Point {
        let points = self.colours.iter().map(|colour| colour.weighed(weights)).collect();
        Self { name: String::new(), points, colours: Vec::new() }.mean()
    }
}
