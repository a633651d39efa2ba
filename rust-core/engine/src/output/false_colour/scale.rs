//! Steps of a quantity, their edges and colours.

use crate::error::{Error, Result};

/// Most steps of a scale: more cannot be told apart.
pub const MOST_STEPS: u32 = 64;

/// Even steps from 0 to a value, even in the logarithm below it, or even between two values; what lies beyond takes the last step's colour.
#[derive(Clone, Debug, PartialEq)]
pub struct FalseColourScale {
    /// Edges between steps, ascending: one more than steps.
    edges: Vec<f32>,
}

/// The viridis ramp (Smith and van der Walt, public domain) at even places: it grows evenly lighter, also in print and to the colour-blind.
const RAMP: [[u8; 3]; 10] = [
    [68, 1, 84],
    [72, 40, 120],
    [62, 74, 137],
    [49, 104, 142],
    [38, 130, 142],
    [31, 158, 137],
    [53, 183, 121],
    [109, 205, 89],
    [180, 222, 44],
    [253, 231, 37],
];

impl FalseColourScale {
    /// Steps up to `max`, even from 0, or even in the logarithm over so many `decades`.
    ///
    /// # Errors
    /// A greatest value or decades that are not above 0, or no steps or too many.
    pub fn new(max: f32, steps: u32, decades: Option<f32>) -> Result<Self> {
        if !(max > 0.0 && max.is_finite()) {
            return Err(Error::setting("max", format!("{max} was found, expected a number above 0")));
        }
        if steps == 0 || steps > MOST_STEPS {
            return Err(Error::setting("steps", format!("{steps} was found, expected 1 to {MOST_STEPS}")));
        }
        let part = |step: u32| step as f32 / steps as f32;
        let edges = match decades {
            None => (0..=steps).map(|step| max * part(step)).collect(),
            Some(decades) if decades > 0.0 && decades <= 20.0 => {
                (0..=steps).map(|step| max * 10f32.powf(decades * (part(step) - 1.0))).collect()
            }
            Some(decades) => return Err(Error::setting("log", format!("{decades} decades were found, expected above 0 and at most 20"))),
        };
        Ok(Self { edges })
    }

    /// A scale for values: up to `max`, or where none is asked for to a round greatest value, or of quantities whose 0 means nothing from the least to the
    /// greatest.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_values(values: &[f32], max: Option<f32>, steps: u32, decades: Option<f32>, zero_means_nothing: bool) -> Result<Self> {
        let scale = Self::new(max.unwrap_or_else(|| Self::round_max(values)), steps, decades)?;
        Ok(if zero_means_nothing && max.is_none() { Self::around(values, steps) } else { scale })
    }

    /// About so many even steps of a round width (1, 2 or 5 times a power of ten) from the least to the greatest of the values (99 % of many),
    /// for quantities whose 0 means nothing.
    pub fn around(values: &[f32], steps: u32) -> Self {
        let mut known: Vec<f32> = values.iter().copied().filter(|value| value.is_finite()).collect();
        known.sort_by(f32::total_cmp);
        // Half a per cent to either side are outliers.
        let beyond = known.len() / 200;
        let ends = known.get(beyond).zip(known.iter().rev().nth(beyond));
        let [least, most] = ends.map_or([0.0, 1.0], |(least, most)| [*least, *most].map(f64::from));
        let span = (most - least).max(1e-3 * most.abs()).max(1e-6);
        let wanted = span / f64::from(steps.clamp(1, MOST_STEPS));
        let power = 10f64.powf(wanted.log10().floor());
        let width = [1.0, 2.0, 5.0, 10.0].into_iter().map(|factor| factor * power).find(|width| *width >= 0.999 * wanted).unwrap_or(wanted);
        // Values that stand on an edge but for rounding are on it.
        let first = (least / width + 1e-6).floor();
        let count = ((most / width - 1e-6).ceil() - first).clamp(1.0, f64::from(MOST_STEPS)) as u32;
        Self { edges: (0..=count).map(|step| ((first + f64::from(step)) * width) as f32).collect() }
    }

    /// A round greatest value (1, 2 or 5 times a power of ten) that 99.5 % of the values do not exceed.
    pub fn round_max(values: &[f32]) -> f32 {
        let mut known: Vec<f32> = values.iter().copied().filter(|value| value.is_finite() && *value > 0.0).collect();
        known.sort_by(f32::total_cmp);
        let Some(high) = known.get((known.len() as f64 * 0.995) as usize).or(known.last()) else { return 1.0 };
        let power = 10f32.powf(high.log10().floor());
        [1.0, 2.0, 5.0, 10.0].into_iter().map(|factor| factor * power).find(|max| *max >= *high * 0.999).unwrap_or(10.0 * power)
    }

    /// Edges between steps, ascending: one more than steps.
    pub fn edges(&self) -> &[f32] {
        &self.edges
    }

    /// Steps.
    pub fn steps(&self) -> usize {
        self.edges.len() - 1
    }

    /// The step of a value; what is not a number has none.
    pub fn step(&self, value: f32) -> Option<usize> {
        let above = self.edges[1..].partition_point(|edge| *edge <= value);
        (!value.is_nan()).then(|| above.min(self.steps() - 1))
    }

    /// The colour of a step, 8-bit sRGB.
    pub fn colour(&self, step: usize) -> [u8; 3] {
        let place = if self.steps() > 1 { step as f32 / (self.steps() - 1) as f32 } else { 1.0 } * (RAMP.len() - 1) as f32;
        let low = (place as usize).min(RAMP.len() - 2);
        let part = place - low as f32;
        std::array::from_fn(|c| (f32::from(RAMP[low][c]) * (1.0 - part) + f32::from(RAMP[low + 1][c]) * part + 0.5) as u8)
    }
}
