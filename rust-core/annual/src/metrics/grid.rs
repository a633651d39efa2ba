//! The figures of a grid of points.

use super::{
    counts::Counts,
    en17037::{AreaErrors, En17037, En17037Errors, Half, Method, by_factor, in_hours},
    errors::jackknife,
    point::Point,
};
use crate::{electric::Electric, schedule::Schedule, year::Year};
use serde::{Deserialize, Serialize};

/// Daylight autonomy that a point needs to count for sDA.
const AUTONOMY: f64 = 0.5;
/// Hours of direct sun beyond which a point counts for ASE.
const SUNNY_HOURS: f64 = 250.0;

/// What was found by all blocks of the coefficients, or without one of them.
pub(crate) struct Variant {
    pub(crate) counts: Counts,
    /// Daylight factors, per cent.
    pub(crate) factors: Vec<f64>,
}

/// A grid's year. Every point stands for the same area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Spatial daylight autonomy (LM-83): the share of points with 300 lx in at least half of the used hours.
    pub sda_300_50: f64,
    /// Annual sunlight exposure (LM-83): the share of points with direct sun of 1000 lx in more than 250 used hours; `None` where it is not known.
    pub ase_1000_250: Option<f64>,
    /// Mean of the points' illuminances, lx.
    pub mean_lx: f64,
    /// Mean of the points' shares of hours from 100 to 3000 lx.
    pub udi_100_3000: f64,
    /// Mean of the points' daylight autonomies, 300 lx.
    pub da_300: f64,
    /// Mean of the points' continuous daylight autonomies.
    pub cda_300: f64,
    /// Median of the daylight factors, per cent.
    pub median_daylight_factor: f64,
    /// Daylight provision.
    pub en17037: En17037,
    /// Electric light beside daylight, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub electric: Option<Electric>,
    /// Used hours of the year.
    pub used_hours: f64,
    /// By group of windows, used hours with its blinds closed; empty where there are no blinds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub closed_hours: Vec<f64>,
    /// The points in the order of the coefficients' rows.
    pub points: Vec<Point>,
    /// Standard errors of the figures above, where coefficients have blocks.
    pub standard_errors: Option<GridErrors>,
}

/// Standard errors of a grid's figures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GridErrors {
    /// Of [`Grid::sda_300_50`].
    pub sda_300_50: f64,
    /// Of [`Grid::ase_1000_250`].
    pub ase_1000_250: Option<f64>,
    /// Of [`Grid::mean_lx`].
    pub mean_lx: f64,
    /// Of [`Grid::udi_100_3000`].
    pub udi_100_3000: f64,
    /// Of [`Grid::da_300`].
    pub da_300: f64,
    /// Of [`Grid::cda_300`].
    pub cda_300: f64,
    /// Of [`Grid::median_daylight_factor`].
    pub median_daylight_factor: f64,
    /// Of the shares of points in [`Grid::en17037`].
    pub en17037: En17037Errors,
    /// Of [`Grid::electric`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub electric: Option<Electric>,
    /// Of [`Grid::points`].
    pub points: Vec<Point>,
}

impl Grid {
    /// By what was counted with all blocks, and without each of them.
    pub(crate) fn new(variants: &[Variant], year: &Year, schedule: &Schedule, half: &Half, has_direct: bool) -> Self {
        let used = schedule.count();
        let grid = |variant: &Variant| {
            let pairs = variant.counts.points.iter().zip(&variant.factors);
            let points = pairs.map(|(count, factor)| Point::new(count, used, half.count, year.step_hours, has_direct, *factor)).collect();
            let electric = variant.counts.loads.as_ref().map(|loads| loads.year(used, year.step_hours));
            Self { electric, ..Self::of_points(points, half, used as f64 * year.step_hours, has_direct) }
        };
        let mut whole = grid(&variants[0]);
        let without: Vec<Self> = variants[1..].iter().map(grid).collect();
        whole.standard_errors = (!without.is_empty()).then(|| whole.errors(&without));
        whole
    }

    fn of_points(points: Vec<Point>, half: &Half, used_hours: f64, has_direct: bool) -> Self {
        let share = |has: &dyn Fn(&Point) -> bool| points.iter().filter(|point| has(point)).count() as f64 / points.len() as f64;
        let mean = |of: &dyn Fn(&Point) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
        Self {
            sda_300_50: share(&|point| point.da_300 >= AUTONOMY),
            ase_1000_250: has_direct.then(|| share(&|point| point.hours_direct_1000.is_some_and(|hours| hours > SUNNY_HOURS))),
            mean_lx: mean(&|point| point.mean_lx),
            udi_100_3000: mean(&|point| point.udi_100_3000),
            da_300: mean(&|point| point.da_300),
            cda_300: mean(&|point| point.cda_300),
            median_daylight_factor: median(points.iter().map(|point| point.daylight_factor).collect()),
            en17037: En17037 {
                hourly: Method::new(points.iter().map(|point| in_hours(point.daylight_hours_100_300_500_750))),
                daylight_factor: Method::new(points.iter().map(|point| by_factor(point.daylight_factor, half.median_diffuse_lx))),
                median_diffuse_lx: half.median_diffuse_lx,
            },
            electric: None,
            used_hours,
            closed_hours: Vec::new(),
            points,
            standard_errors: None,
        }
    }

    /// Standard errors by what is found without each of the blocks.
    fn errors(&self, without: &[Self]) -> GridErrors {
        let error = |of: &dyn Fn(&Self) -> f64| jackknife(&without.iter().map(of).collect::<Vec<_>>());
        let point = |(index, point): (usize, &Point)| {
            let numbers: Vec<_> = without.iter().map(|grid| grid.points[index].numbers()).collect();
            point.with(std::array::from_fn(|number| jackknife(&numbers.iter().map(|numbers| numbers[number]).collect::<Vec<_>>())))
        };
        GridErrors {
            sda_300_50: error(&|grid| grid.sda_300_50),
            ase_1000_250: self.ase_1000_250.map(|_| error(&|grid| grid.ase_1000_250.unwrap_or(0.0))),
            mean_lx: error(&|grid| grid.mean_lx),
            udi_100_3000: error(&|grid| grid.udi_100_3000),
            da_300: error(&|grid| grid.da_300),
            cda_300: error(&|grid| grid.cda_300),
            median_daylight_factor: error(&|grid| grid.median_daylight_factor),
            en17037: En17037Errors {
                hourly: AreaErrors::new(&|level| error(&|grid| grid.en17037.hourly.area_100_300_500_750[level])),
                daylight_factor: AreaErrors::new(&|level| error(&|grid| grid.en17037.daylight_factor.area_100_300_500_750[level])),
            },
            electric: self
                .electric
                .map(|_| Electric::errors(&without.iter().filter_map(|grid| grid.electric).collect::<Vec<_>>(), jackknife)),
            points: self.points.iter().enumerate().map(point).collect(),
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    values.get(last / 2).map_or(0.0, |lower| 0.5 * (lower + values[last.div_ceil(2)]))
}
