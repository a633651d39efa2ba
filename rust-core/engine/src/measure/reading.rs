//! What meters show.

use super::{glare::Coverage, spectral::ColourReading};
use crate::scene::{Measurand, Meter};
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
