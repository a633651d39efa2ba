//! What meters and grids show.

use super::{eyes::EyeReadings, glare::Coverage, points::GridPoints, spectral::ColourReading, vector::Vector};
use crate::scene::{Grid, Measurand, Meter, Origin};
use std::sync::Arc;

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

    /// Where there is no figure.
    pub(super) const UNKNOWN: Self = Self { value: f64::NAN, standard_error: f64::NAN };

    /// With another's that is independent of it.
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { value: self.value + other.value, standard_error: self.standard_error.hypot(other.standard_error) }
    }

    /// So many times as much.
    pub(super) fn times(&self, factor: f64) -> Self {
        Self { value: self.value * factor, standard_error: self.standard_error * factor }
    }

    /// Whether there is a figure; none where light that no path from the meter finds has no room to be counted.
    pub fn is_known(&self) -> bool {
        !self.value.is_nan()
    }

    /// Its share of another, in per cent.
    pub(super) fn percent_of(&self, whole: &Self) -> Self {
        let value = 100.0 * self.value / whole.value;
        let own = 100.0 * self.standard_error / whole.value;
        Self { value, standard_error: own.hypot(value * whole.standard_error / whole.value) }
    }
}

/// The sources that CIE 147 rates as small, and what UGR tables would say: by CIE 117's formula for all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmallSources {
    /// How many there are.
    pub count: usize,
    /// The rating by CIE 117 alone; none where one of them is a point.
    pub tabular: Option<Reading>,
}

impl SmallSources {
    /// In words; none without any.
    pub fn note(&self) -> Option<String> {
        let tabular = match self.tabular {
            Some(reading) => format!("by CIE 117 alone, as in UGR tables, {:.1}", reading.value),
            None => "by CIE 117 alone, as in UGR tables, none: a point has no luminance".to_owned(),
        };
        (self.count > 0).then(|| format!("{} below 0.005 m² rated as small by CIE 147; {tabular}", self.count))
    }
}

/// A reading with what it is made of.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    pub(super) reading: Reading,
    /// Of a glare rating.
    pub(super) rated: Option<(Coverage, SmallSources)>,
    /// Of a figure of colour.
    pub(super) colour: Option<Arc<ColourReading>>,
}

impl Found {
    pub(super) fn of_colour(measurand: Measurand, colour: Arc<ColourReading>) -> Self {
        Self { colour: Some(colour.clone()), ..colour.of(measurand).unwrap_or(Reading::UNKNOWN).into() }
    }
}

impl From<Reading> for Found {
    fn from(reading: Reading) -> Self {
        Self { reading, ..Self::default() }
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
    /// Sources that a glare rating takes as small, and what tables would say; none of other quantities.
    pub small: Option<SmallSources>,
    /// The spectrum that a figure of colour is of, and the other figures; none of other quantities.
    pub colour: Option<Arc<ColourReading>>,
}

impl MeterReading {
    pub(super) fn new(meter: &Meter, found: &Found) -> Self {
        Self {
            meter: meter.clone(),
            reading: found.reading,
            coverage: found.rated.map(|(coverage, _)| coverage),
            small: found.rated.map(|(_, small)| small),
            colour: found.colour.clone(),
        }
    }

    /// What a rating or a figure is made of, in words; none where there is nothing to be said.
    pub fn note(&self) -> Option<String> {
        let colour = self.colour.as_ref().map(|colour| colour.note());
        let notes = [colour, self.small.and_then(|small| small.note()), self.coverage.and_then(|coverage| coverage.note())];
        let notes: Vec<String> = notes.into_iter().flatten().collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }
}

/// The figures of a grid. Least and greatest are those of noisy points: noise moves them outwards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Points measured, those without a figure left out.
    pub points: usize,
    /// Mean of all points.
    pub average: Reading,
    /// The least point.
    pub min: Reading,
    /// The greatest point.
    pub max: Reading,
}

impl Summary {
    pub(super) fn new(readings: impl Iterator<Item = Reading> + Clone) -> Self {
        let readings = readings.filter(Reading::is_known);
        let count = readings.clone().count();
        // No number where no point has a figure.
        let share = 1.0 / count as f64;
        let average = readings.clone().map(|r| r.value).sum::<f64>() * share;
        let error = readings.clone().map(|r| r.standard_error.powi(2)).sum::<f64>().sqrt() * share;
        let by_value = |a: &Reading, b: &Reading| a.value.total_cmp(&b.value);
        let average = Reading { value: average, standard_error: error };
        Self {
            points: count,
            average,
            min: readings.clone().min_by(by_value).unwrap_or(average),
            max: readings.max_by(by_value).unwrap_or(average),
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

/// The meters of a model's sensor grid together.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorGrid {
    /// The grid's name: meters are called by it, a slash and their numbers.
    pub name: String,
    /// What is measured.
    pub measurand: Measurand,
    /// The figures.
    pub summary: Summary,
}

impl SensorGrid {
    /// Those of meters, in the order of their first ones; single meters are none.
    pub fn all(meters: &[MeterReading]) -> Vec<Self> {
        let mut found: Vec<(&str, Measurand, Vec<Reading>)> = Vec::new();
        for MeterReading { meter, reading, .. } in meters {
            let Some((grid, number)) = meter.origin.name.rsplit_once('/') else { continue };
            if grid.is_empty() || number.parse::<u32>().is_err() {
                continue;
            }
            match found.iter_mut().find(|(name, measurand, _)| *name == grid && *measurand == meter.measurand) {
                Some((.., readings)) => readings.push(*reading),
                None => found.push((grid, meter.measurand, vec![*reading])),
            }
        }
        let several = found.into_iter().filter(|(.., readings)| readings.len() > 1);
        several
            .map(|(name, measurand, readings)| Self { name: name.to_owned(), measurand, summary: Summary::new(readings.into_iter()) })
            .collect()
    }
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
    /// What eyes at the points get, whose mean over the directions is then each point's reading; none of grids without eyes.
    pub eyes: Option<EyeReadings>,
    /// The figures.
    pub summary: Summary,
    /// What the glare ratings leave out, by point in the order of those that were measured; empty of other quantities.
    pub coverage: Vec<Coverage>,
    /// Sources that the glare ratings take as small, and what tables would say, in the same order.
    pub small: Vec<SmallSources>,
    /// The spectra that figures of colour are of, in the same order, of eyes direction by direction; empty of other quantities.
    pub colours: Vec<Arc<ColourReading>>,
}

impl GridReading {
    pub(super) fn new(grid: &Grid, points: GridPoints, found: &[Found]) -> Self {
        let own = || found.iter().map(|found| found.reading);
        let eyes = (!points.facings.is_empty()).then(|| EyeReadings::new(points.facings, own()));
        let readings: Vec<Reading> = eyes.as_ref().map_or_else(|| own().collect(), EyeReadings::means);
        let mut next = readings.iter().copied();
        let placed = points.positions.iter().map(|position| position.and_then(|position| Some((position, next.next()?)))).collect();
        Self {
            origin: grid.origin.clone(),
            measurand: grid.measurand,
            size: points.size,
            spacing: points.spacing,
            normal: points.normal,
            area: points.area,
            points: placed,
            eyes,
            summary: Summary::new(readings.iter().copied()),
            coverage: found.iter().filter_map(|found| found.rated.map(|(coverage, _)| coverage)).collect(),
            small: found.iter().filter_map(|found| found.rated.map(|(_, small)| small)).collect(),
            colours: found.iter().filter_map(|found| found.colour.clone()).collect(),
        }
    }

    /// A grid that shows other values than what it measures, one for each point that there is.
    pub fn of_values(grid: &Grid, points: GridPoints, values: &[f64]) -> Self {
        let found: Vec<Found> = values.iter().map(|value| Found::from(Reading { value: *value, standard_error: 0.0 })).collect();
        Self::new(grid, GridPoints { facings: Vec::new(), ..points }, &found)
    }

    /// The figures by CIE 117 alone, as UGR tables have them; none where no source counts as small, or one is a point.
    pub fn tabular_summary(&self) -> Option<Summary> {
        let readings: Vec<Reading> = self.small.iter().map(|small| small.tabular).collect::<Option<_>>()?;
        self.small.iter().any(|small| small.count > 0).then(|| Summary::new(readings.into_iter()))
    }

    /// In words what the ratings are made of: small sources, and what is left out; none where there is nothing to be said.
    pub fn rating_note(&self) -> Option<String> {
        let notes: Vec<String> = [self.small_note(), self.coverage_note()].into_iter().flatten().collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    fn small_note(&self) -> Option<String> {
        let points = self.small.iter().filter(|small| small.count > 0).count();
        let tabular = match self.tabular_summary() {
            Some(Summary { average, min, max, .. }) => {
                let [average, min, max] = [average, min, max].map(|reading| reading.value);
                format!("average {average:.1}, least {min:.1}, greatest {max:.1}")
            }
            None => "none, since a point has no luminance".to_owned(),
        };
        let all = self.small.len();
        let note = || {
            format!(
                "sources below 0.005 m² rated as small by CIE 147 at {points} of {all} points; by CIE 117 alone, as in UGR tables: {tabular}"
            )
        };
        (points > 0).then(note)
    }

    /// In words what the ratings leave out; none where all is rated.
    pub fn coverage_note(&self) -> Option<String> {
        let notes: Vec<String> = [self.left_out_note(), self.covered_note()].into_iter().flatten().collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    fn covered_note(&self) -> Option<String> {
        let count = self.coverage.iter().filter(|coverage| coverage.covered > 0).count();
        let points = self.coverage.len();
        (count > 0)
            .then(|| format!("{count} of {points} points see luminaires behind glass or covers of the scene alone, which are not rated"))
    }

    fn left_out_note(&self) -> Option<String> {
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
