//! The figures of a point.

use super::counts::Count;
use serde::{Deserialize, Serialize};

/// Numbers of a point.
pub(super) const NUMBERS: usize = 14;

/// A point's year. Shares are of the used hours, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Mean illuminance of the used hours, lx.
    pub mean_lx: f64,
    /// Daylight autonomy: the share with at least 300 lx.
    pub da_300: f64,
    /// Continuous daylight autonomy: hours below 300 lx count in part.
    pub cda_300: f64,
    /// Useful daylight illuminance: the share below 100 lx.
    pub udi_below_100: f64,
    /// The share from 100 to below 300 lx.
    pub udi_100_300: f64,
    /// The share from 300 to 3000 lx.
    pub udi_300_3000: f64,
    /// The share above 3000 lx.
    pub udi_above_3000: f64,
    /// The share from 100 to 3000 lx.
    pub udi_100_3000: f64,
    /// Used hours with direct sun of at least 1000 lx; `None` where direct light is not known.
    pub hours_direct_1000: Option<f64>,
    /// Daylight factor under the traditional overcast sky, per cent.
    pub daylight_factor: f64,
    /// Shares of the brighter half of the year's hours with at least 100, 300, 500 and 750 lx (EN 17037).
    pub daylight_hours_100_300_500_750: [f64; 4],
}

impl Point {
    /// Of what was counted in `used` used steps and `half` steps of the bright half.
    pub(super) fn new(count: &Count, used: usize, half: usize, step_hours: f64, has_direct: bool, daylight_factor: f64) -> Self {
        let share = |steps: f64| steps / used as f64;
        let useful = count.supplementary + count.autonomous;
        let (bright, used_steps) = (f64::from(count.exceeded), used as f64);
        Self {
            mean_lx: share(count.sum),
            da_300: share(f64::from(count.enough)),
            cda_300: share(count.credit),
            udi_below_100: share(used_steps - bright - f64::from(useful)),
            udi_100_300: share(f64::from(count.supplementary)),
            udi_300_3000: share(f64::from(count.autonomous)),
            udi_above_3000: share(bright),
            udi_100_3000: share(f64::from(useful)),
            hours_direct_1000: has_direct.then_some(f64::from(count.direct) * step_hours),
            daylight_factor,
            daylight_hours_100_300_500_750: count.bright_half.map(|steps| f64::from(steps) / half as f64),
        }
    }

    /// Its numbers in a row.
    pub(super) fn numbers(&self) -> [f64; NUMBERS] {
        let [low, middle, high, highest] = self.daylight_hours_100_300_500_750;
        [
            self.mean_lx,
            self.da_300,
            self.cda_300,
            self.udi_below_100,
            self.udi_100_300,
            self.udi_300_3000,
            self.udi_above_3000,
            self.udi_100_3000,
            self.hours_direct_1000.unwrap_or(0.0),
            self.daylight_factor,
            low,
            middle,
            high,
            highest,
        ]
    }

    /// The same with other numbers.
    pub(super) fn with(&self, numbers: [f64; NUMBERS]) -> Self {
        let [mean_lx, da_300, cda_300, below, low, middle, above, useful, direct, daylight_factor, half @ ..] = numbers;
        Self {
            mean_lx,
            da_300,
            cda_300,
            udi_below_100: below,
            udi_100_300: low,
            udi_300_3000: middle,
            udi_above_3000: above,
            udi_100_3000: useful,
            hours_direct_1000: self.hours_direct_1000.map(|_| direct),
            daylight_factor,
            daylight_hours_100_300_500_750: half,
        }
    }
}
