//! Illuminances at points, maintained, in lx.

use crate::{line::Line, road::Reach};
use std::f64::consts::PI;

/// Height in metres at which faces are looked at.
pub(crate) const FACE: f64 = 1.5;

/// Rounding of a distance that is exactly the reach.
const SLACK: f64 = 1e-9;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Measurand {
    /// On the ground.
    Horizontal,
    /// Of a hemisphere on the ground.
    Hemispherical,
    /// Of an upright half cylinder 1.5 m high that faces along x (1) or against it (−1).
    Semicylindrical(f64),
    /// Of an upright plane 1.5 m high that faces so.
    Vertical(f64),
}

impl Measurand {
    fn height(self) -> f64 {
        match self {
            Self::Horizontal | Self::Hemispherical => 0.0,
            Self::Semicylindrical(_) | Self::Vertical(_) => FACE,
        }
    }

    /// Share of the intensity over the squared distance that counts; the unit vector goes to the luminaire.
    fn weight(self, [x, y, z]: [f64; 3]) -> f64 {
        match self {
            Self::Horizontal => z,
            Self::Hemispherical => (1.0 + z) / 4.0,
            Self::Semicylindrical(facing) => (x.hypot(y) + facing * x) / PI,
            Self::Vertical(facing) => (facing * x).max(0.0),
        }
    }
}

/// The illuminance at a place of the road, by the luminaires within the reach of it in plan.
pub(crate) fn illuminance(lines: &[Line<'_>], reach: &Reach, [x, y]: [f64; 2], measurand: Measurand) -> f64 {
    let point = [x, y, measurand.height()];
    let of_line = |line: &Line<'_>| {
        let radius = reach.illuminance * line.row.height;
        let half = (radius * radius * (1.0 + SLACK) - (line.y - y).powi(2)).max(-1.0);
        let [from, to] = if half < 0.0 { [x + 1.0, x] } else { [x - half.sqrt(), x + half.sqrt()] };
        let sum: f64 = line
            .between(from, to)
            .filter(|at| (at - x).powi(2) <= half)
            .map(|at| {
                let ray = line.ray(at, point);
                let length = ray.square.sqrt();
                ray.intensity / ray.square * measurand.weight(ray.to.map(|part| part / length))
            })
            .sum();
        sum * line.row.maintenance_factor
    };
    lines.iter().map(of_line).sum()
}
