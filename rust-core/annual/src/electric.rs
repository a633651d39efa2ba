//! Electric light beside daylight, and what it takes in a year (EN 15193-1's LENI, without its tables).

use crate::{
    chunk::Chunk,
    error::{AnnualError, Result},
    schedule::Schedule,
};
use serde::{Deserialize, Serialize};

/// How lamps follow daylight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Control {
    /// They give what daylight lacks of the target, but no less than a share of their light while the room is used.
    Dimming,
    /// They are off where daylight alone is enough, and on where it is not.
    Switching,
}

/// Which daylight the control sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sensor {
    /// That of the darkest point: the target holds everywhere.
    Least,
    /// The mean of all points.
    Mean,
    /// Each point's own, by lamps of its own.
    Points,
}

/// The lamps of a room, which light all of it alike.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ElectricLight {
    /// Installed power over the area, W/m².
    pub power_w_m2: f64,
    /// What they give at full power and what is wanted, lx.
    pub target_lx: f64,
    /// How they follow daylight.
    pub control: Control,
    /// Share of their power that dimmed lamps take at least.
    pub least: f64,
    /// Which daylight counts.
    pub sensor: Sensor,
    /// Share of the used hours in which somebody is there and the lamps are not off for that.
    pub presence: f64,
    /// What controls and emergency lamps take besides, kWh/m² in a year.
    pub standby_kwh_m2: f64,
}

/// A year of electric light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Electric {
    /// Used hours with daylight, in which the lamps follow it.
    pub daylight_hours: f64,
    /// Used hours, weighed by the share of the lamps' power in each, before presence.
    pub full_load_hours: f64,
    /// Mean share of their power in the used hours with daylight (F_D); `None` without such hours.
    pub daylight_dependency: Option<f64>,
    /// Energy over the area, kWh/m² in a year (LENI).
    pub leni_kwh_m2: f64,
    /// The same without regard to daylight.
    pub leni_without_daylight_kwh_m2: f64,
}

impl Default for ElectricLight {
    /// Without power; dimmed to a tenth beside 500 lx, by the mean of all points.
    fn default() -> Self {
        let (control, sensor) = (Control::Dimming, Sensor::Mean);
        Self { power_w_m2: 0.0, target_lx: 500.0, control, least: 0.1, sensor, presence: 1.0, standby_kwh_m2: 0.0 }
    }
}

impl ElectricLight {
    pub(crate) fn check(&self) -> Result<()> {
        let within = |name: &'static str, value: f64, most: f64, unit: &str| {
            let is_right = (0.0..=most).contains(&value);
            if is_right { Ok(()) } else { Err(AnnualError::setting(name, format!("{value} was found, expected 0 to {most}{unit}"))) }
        };
        within("lighting-power", self.power_w_m2, 1e4, " W/m²")?;
        within("lighting-presence", self.presence, 1.0, "")?;
        within("lighting-standby", self.standby_kwh_m2, 1e4, " kWh/m²")?;
        within("lighting-least", self.least, 1.0, "")?;
        if self.target_lx > 0.0 && self.target_lx.is_finite() {
            Ok(())
        } else {
            Err(AnnualError::setting("lighting-target", format!("{} was found, expected lux above 0", self.target_lx)))
        }
    }

    /// The share of the lamps' power beside so much daylight, lx.
    fn load(&self, daylight: f64) -> f64 {
        match self.control {
            Control::Dimming => (1.0 - daylight / self.target_lx).clamp(self.least, 1.0),
            Control::Switching => f64::from(daylight < self.target_lx),
        }
    }
}

/// Loads of a year, chunk by chunk.
#[derive(Clone, Debug)]
pub(crate) struct Loads {
    light: ElectricLight,
    /// Used steps with daylight, and their loads.
    steps: usize,
    sum: f64,
}

impl Loads {
    pub(crate) fn new(light: ElectricLight) -> Self {
        Self { light, steps: 0, sum: 0.0 }
    }

    /// Counts a chunk's used steps; all of them have daylight.
    pub(crate) fn add(&mut self, chunk: &Chunk<'_>, schedule: &Schedule) {
        let count = chunk.steps.len();
        let points = chunk.total.len() / count.max(1);
        for (column, _) in chunk.steps.iter().enumerate().filter(|(_, step)| schedule.is_used(**step)) {
            let values = (0..points).map(|point| f64::from(chunk.total[point * count + column]));
            self.steps += 1;
            self.sum += match self.light.sensor {
                Sensor::Least => self.light.load(values.fold(f64::INFINITY, f64::min)),
                Sensor::Mean => self.light.load(values.sum::<f64>() / points as f64),
                Sensor::Points => values.map(|value| self.light.load(value)).sum::<f64>() / points as f64,
            };
        }
    }

    /// Of so many used steps in all.
    pub(crate) fn year(&self, used: usize, step_hours: f64) -> Electric {
        let ElectricLight { power_w_m2, presence, standby_kwh_m2, .. } = self.light;
        let full_load_hours = (self.sum + (used - self.steps) as f64) * step_hours;
        let energy = |hours: f64| power_w_m2 * presence * hours * 1e-3 + standby_kwh_m2;
        Electric {
            daylight_hours: self.steps as f64 * step_hours,
            full_load_hours,
            daylight_dependency: (self.steps > 0).then(|| self.sum / self.steps as f64),
            leni_kwh_m2: energy(full_load_hours),
            leni_without_daylight_kwh_m2: energy(used as f64 * step_hours),
        }
    }
}

impl Electric {
    /// Standard errors by what is found without each of the blocks.
    pub(crate) fn errors(without: &[Self], jackknife: impl Fn(&[f64]) -> f64) -> Self {
        let error = |of: &dyn Fn(&Self) -> f64| jackknife(&without.iter().map(of).collect::<Vec<_>>());
        let dependency = |found: &Self| found.daylight_dependency.unwrap_or(0.0);
        Self {
            daylight_hours: 0.0,
            full_load_hours: error(&|found| found.full_load_hours),
            daylight_dependency: without.first().and_then(|found| found.daylight_dependency).map(|_| error(&dependency)),
            leni_kwh_m2: error(&|found| found.leni_kwh_m2),
            leni_without_daylight_kwh_m2: 0.0,
        }
    }
}
