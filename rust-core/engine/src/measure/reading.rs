//! What meters and grids show.

use super::{glare::Coverage, points::GridPoints, vector::Vector};
use crate::scene::{Grid, Measurand, Meter, Origin};

/// A value with its standard error, in the measurand's unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// The mean of all samples.
    pub value: f64,
    /// By the spread of the means of 16 parts of the samples. Parts share one well-spread sequence, so that the true error is rather less.
    pub standard_error: f64,
}

impl Reading {
    /// The mean of independent or better-spread parts.
    pub(super) fn of_parts(parts: impl Iterator<Item = f64> + Clone) -> Self {
        let count = parts.clone().count() as f64;
        let mean = parts.clone().sum::<f64>() / count;
        let squares: f64 = parts.map(|part| (part - mean).powi(2)).sum();
        Self { value: mean, standard_error: (squares / (count * (count - 1.0).max(1.0))).sqrt() }
    }

    /// Its share of another, in per cent.
    pub(super) fn percent_of(&self, whole: &Self) -> Self {
        let value = 100.0 * self.value / whole.value;
        let own = 100.0 * self.standard_error / whole.value;
        Self { value, standard_error: own.hypot(value * whole.standard_error / whole.value) }
    }
}

/// What a meter shows.
#[derive(Clone, Debug, PartialEq)]
pub struct MeterReading {
    /// The meter.
    pub meter: Meter,
    /// Its reading.
    pub reading: Reading,
    /// What a glare rating leaves out; none of other quantities.
    pub coverage: Option<Coverage>,
}

/// The figures of a grid. Least and greatest are those of noisy points: noise moves them outwards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Points measured.
    pub points: usize,
    /// Mean of all points.
    pub average: Reading,
    /// The least point.
    pub min: Reading,
    /// The greatest point.
    pub max: Reading,
}

impl Summary {
    fn new(readings: impl Iterator<Item = Reading> + Clone) -> Self {
        let count = readings.clone().count();
        let share = 1.0 / count.max(1) as f64;
        let average = readings.clone().map(|r| r.value).sum::<f64>() * share;
        let error = readings.clone().map(|r| r.standard_error.powi(2)).sum::<f64>().sqrt() * share;
        let by_value = |a: &Reading, b: &Reading| a.value.total_cmp(&b.value);
        Self {
            points: count,
            average: Reading { value: average, standard_error: error },
            min: readings.clone().min_by(by_value).unwrap_or_default(),
            max: readings.max_by(by_value).unwrap_or_default(),
        }
    }

    /// U₀ = E_min / E_avg (EN 12464-1); 0 where all is dark.
    pub fn uniformity(&self) -> f64 {
        ratio(self.min.value, self.average.value)
    }

    /// U_d = E_min / E_max; 0 where all is dark.
    pub fn diversity(&self) -> f64 {
        ratio(self.min.value, self.max.value)
    }
}

fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// What a grid shows.
#[derive(Clone, Debug, PartialEq)]
pub struct GridReading {
    /// Where the grid came from.
    pub origin: Origin,
    /// What was measured.
    pub measurand: Measurand,
    /// Points in a row, and rows.
    pub size: [usize; 2],
    /// Metres from point to point, along a row and from row to row.
    pub spacing: [f64; 2],
    /// Unit normal of the area.
    pub normal: Vector,
    /// Square metres of the whole surface, margins included, seen along the normal.
    pub area: f64,
    /// Position (world space, metres) and reading of each point, row by row; none where the area does not reach.
    pub points: Vec<Option<(Vector, Reading)>>,
    /// The figures.
    pub summary: Summary,
    /// What the glare ratings leave out, by point in the order of those that were measured; empty of other quantities.
    pub coverage: Vec<Coverage>,
}

impl GridReading {
    pub(super) fn new(grid: &Grid, points: GridPoints, found: &[(Reading, Option<Coverage>)]) -> Self {
        let readings = || found.iter().map(|(reading, _)| *reading);
        let mut next = readings();
        let placed = points.positions.iter().map(|position| position.and_then(|position| Some((position, next.next()?)))).collect();
        Self {
            origin: grid.origin.clone(),
            measurand: grid.measurand,
            size: points.size,
            spacing: points.spacing,
            normal: points.normal,
            area: points.area,
            points: placed,
            summary: Summary::new(readings()),
            coverage: found.iter().filter_map(|(_, coverage)| *coverage).collect(),
        }
    }

    /// In words what the ratings leave out; none where all is rated.
    pub fn coverage_note(&self) -> Option<String> {
        let out: Vec<&Coverage> = self.coverage.iter().filter(|coverage| coverage.left_out() > 0).collect();
        let share = out.iter().map(|coverage| coverage.share_left_out()).fold(0.0, f64::max);
        let most = out.iter().map(|coverage| coverage.left_out()).max()?;
        let points = format!("{} of {} points", out.len(), self.coverage.len());
        Some(format!(
            "sources left out (CIE 117) at {points}: {most} at most, up to {:.0} % of the sources' light at the eye",
            100.0 * share
        ))
    }

    /// The values row by row; not a number where the area does not reach.
    pub fn values(&self) -> Vec<f32> {
        self.points.iter().map(|point| point.map_or(f32::NAN, |(_, reading)| reading.value as f32)).collect()
    }
}
