//! Where rays end that have gone out: at what layer, and how far from the opening.

use super::{
    figures::{Layer, Outside},
    looks::{Looks, Opening},
    met::Met,
};
use crate::measure::vector::{Vector, add, dot, length, scaled, unit};

/// Cosine of the slope up to which what is met below the horizon is ground: 30°.
const LEVEL: f64 = 0.866_025_403_784_438_6;
/// Sine of the height from which on a ray counts as above the horizon, and less as below.
const HORIZON: f64 = 1e-6;
/// Sine of the slope up to which an opening is a wall's, and distances are counted across it.
const UPRIGHT: f64 = 0.9;

impl Looks<'_> {
    /// The end of a ray that meets nothing.
    pub(super) fn open(&self, direction: Vector, by_hole: bool) -> Outside {
        let height = dot(direction, self.axes[2]).clamp(-1.0, 1.0);
        let is_near = self.task.horizon_deg > 0.0 && height.asin().to_degrees().abs() <= self.task.horizon_deg + HORIZON;
        let layer = match height {
            _ if is_near => Layer::Landscape,
            height if height < -HORIZON => Layer::Ground,
            _ => Layer::Sky,
        };
        Outside { layer, distance_m: f64::INFINITY, by_hole, is_open: true }
    }

    /// The end of a ray at what it meets. Ground below the horizon stands in nobody's way.
    pub(super) fn end(&self, direction: Vector, met: &Met, opening: Opening) -> Outside {
        let up = self.axes[2];
        let is_below = dot(direction, up) < -HORIZON;
        let is_level = || is_below && dot(self.normal(met), up).abs() >= LEVEL;
        let is_ground = self.prims.is_ground(met.set).unwrap_or_else(is_level);
        let layer = if is_ground { Layer::Ground } else { Layer::Landscape };
        let far = scaled(direction, f64::from(met.t) - opening.at);
        let distance_m = if is_ground && is_below { f64::INFINITY } else { self.on_plan(far, opening.normal) };
        Outside { layer, distance_m, by_hole: opening.is_hole, is_open: false }
    }

    /// Metres of a way on the plan: across an upright opening, else along the way.
    fn on_plan(&self, way: Vector, normal: Option<Vector>) -> f64 {
        let up = self.axes[2];
        let level = |of: Vector| add(of, scaled(up, -dot(of, up)));
        let upright = normal.filter(|normal| dot(*normal, up).abs() < UPRIGHT).and_then(|normal| unit(level(normal)));
        upright.map_or_else(|| length(level(way)), |normal| dot(way, normal).abs())
    }
}
