//! Daylight provision by EN 17037: target and minimum illuminance by the hourly method, and by daylight factors.

use crate::sky::SkyMatrix;
use serde::{Deserialize, Serialize};

/// Illuminances that are asked for, lx.
pub(super) const LEVELS: [f64; 4] = [100.0, 300.0, 500.0, 750.0];
/// Share of the area that has the target, and that has the minimum.
const TARGET_AREA: f64 = 0.5;
const MINIMUM_AREA: f64 = 0.95;
/// Share of the daylight hours in which it is there.
const HOURS: f64 = 0.5;

/// A recommendation of EN 17037.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// Not even the minimum.
    None,
    /// 300 lx, and 100 lx nearly everywhere.
    Minimum,
    /// 500 lx, and 300 lx nearly everywhere.
    Medium,
    /// 750 lx, and 500 lx nearly everywhere.
    High,
}

/// What one of the two methods finds: shares of the points that have an illuminance in half of the daylight hours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Method {
    /// Shares of points with 100, 300, 500 and 750 lx.
    pub area_100_300_500_750: [f64; 4],
    /// The recommendation that is met.
    pub level: Level,
}

/// Daylight provision of a grid for vertical and inclined openings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct En17037 {
    /// By illuminances, hour by hour.
    pub hourly: Method,
    /// By daylight factors over the factor that gives an illuminance at the median of the sky's light.
    pub daylight_factor: Method,
    /// Median of the sky's light on a level surface in the daylight hours, lx.
    pub median_diffuse_lx: f64,
}

/// Standard errors of the shares that a method finds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AreaErrors {
    /// Of [`Method::area_100_300_500_750`].
    pub area_100_300_500_750: [f64; 4],
}

/// Standard errors of daylight provision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct En17037Errors {
    /// Of [`En17037::hourly`].
    pub hourly: AreaErrors,
    /// Of [`En17037::daylight_factor`].
    pub daylight_factor: AreaErrors,
}

impl AreaErrors {
    /// By the error at each of the four illuminances.
    pub(super) fn new(error: &dyn Fn(usize) -> f64) -> Self {
        Self { area_100_300_500_750: [0, 1, 2, 3].map(error) }
    }
}

impl Method {
    /// Of points that have the illuminances or have not.
    pub(super) fn new(points: impl Iterator<Item = [bool; 4]>) -> Self {
        let (mut counts, mut all) = ([0_usize; 4], 0_usize);
        for point in points {
            counts.iter_mut().zip(point).for_each(|(count, has)| *count += usize::from(has));
            all += 1;
        }
        let area = counts.map(|count| count as f64 / all as f64);
        let met = |target: usize, minimum: usize| area[target] >= TARGET_AREA && area[minimum] >= MINIMUM_AREA;
        let level = match (met(1, 0), met(2, 1), met(3, 2)) {
            (_, _, true) => Level::High,
            (_, true, _) => Level::Medium,
            (true, ..) => Level::Minimum,
            _ => Level::None,
        };
        Self { area_100_300_500_750: area, level }
    }
}

/// Whether illuminances are there in enough of the daylight hours, by the shares of the hours.
pub(super) fn in_hours(shares: [f64; 4]) -> [bool; 4] {
    shares.map(|share| share >= HOURS)
}

/// Whether a daylight factor in per cent gives the illuminances at the median of the sky's light.
pub(super) fn by_factor(factor: f64, median_diffuse_lx: f64) -> [bool; 4] {
    LEVELS.map(|level| factor / 100.0 * median_diffuse_lx >= level)
}

/// The daylight hours: the half of the year's steps in which the sky gives the most light.
#[derive(Clone, Debug)]
pub(crate) struct Half {
    has: Vec<bool>,
    pub(super) count: usize,
    pub(super) median_diffuse_lx: f64,
}

impl Half {
    pub(crate) fn of(sky: &SkyMatrix<'_>) -> Self {
        let steps = sky.year().steps.len();
        let mut diffuse: Vec<(f64, usize)> =
            (0..steps).map(|step| (sky.conditions(step).map_or(0.0, |now| now.diffuse_horizontal), step)).collect();
        diffuse.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        diffuse.truncate(steps / 2);
        let mut has = vec![false; steps];
        diffuse.iter().for_each(|(_, step)| has[*step] = true);
        let middle = diffuse.len() / 2;
        let lower = diffuse.len().saturating_sub(1) / 2;
        let median_diffuse_lx = diffuse.get(middle).map_or(0.0, |(value, _)| 0.5 * (value + diffuse[lower].0));
        Self { has, count: diffuse.len(), median_diffuse_lx }
    }

    /// Whether a step is of the half.
    pub(crate) fn has(&self, step: usize) -> bool {
        self.has[step]
    }
}
