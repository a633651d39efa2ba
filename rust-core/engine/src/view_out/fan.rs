//! The directions in which an eye looks: steps around it, and in each of them steps up and down from the horizon.

use crate::measure::vector::{Vector, across, add, cross, scaled, unit};
use std::f64::consts::TAU;

/// All directions, azimuth by azimuth; those of an azimuth begin at the horizon and go away from it.
#[derive(Debug)]
pub(super) struct Fan {
    /// Steps around.
    pub(super) azimuths: usize,
    /// Radians above the horizon, the nearest to it first.
    pub(super) elevations: Vec<f64>,
    /// Radians from one elevation to the next.
    step: f64,
    /// Two level axes, and up; unit.
    pub(super) axes: [Vector; 3],
}

impl Fan {
    /// Steps of so many radians, or nearly so around, up to `field` radians from the horizon; `up` is none without a direction.
    pub(super) fn new(up: Vector, step: f64, field: f64) -> Option<Self> {
        let up = unit(up)?;
        let first = across(up, [1.0, 0.0, 0.0]);
        let count = (field / step + 1e-6) as usize;
        let aside = (1..=count).flat_map(|number| [number as f64 * step, -(number as f64) * step]);
        let elevations = std::iter::once(0.0).chain(aside).collect();
        Some(Self { azimuths: (TAU / step).round() as usize, elevations, step, axes: [first, cross(up, first), up] })
    }

    /// Radians from one azimuth to the next.
    pub(super) fn width(&self) -> f64 {
        TAU / self.azimuths as f64
    }

    /// Unit: one of the azimuths, in the middle of its step, one of the elevations.
    pub(super) fn direction(&self, azimuth: usize, elevation: usize) -> Vector {
        let (sin, cos) = ((azimuth as f64 + 0.5) * self.width()).sin_cos();
        let (height, level) = self.elevations[elevation].sin_cos();
        let [x, y, up] = self.axes;
        add(scaled(add(scaled(x, cos), scaled(y, sin)), level), scaled(up, height))
    }

    /// Steradians that a direction stands for.
    pub(super) fn solid_angle(&self, elevation: usize) -> f64 {
        self.width() * self.step * self.elevations[elevation].cos()
    }
}
