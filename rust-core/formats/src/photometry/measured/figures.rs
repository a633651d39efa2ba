//! Figures of a measurement with their standard errors.

use super::Reduced;
use crate::photometry::figures::MISSED;
use crate::photometry::grid::SAME;
use crate::photometry::{Aside, Goniogram, Spread, Symmetry};

/// A value and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WithError {
    /// The value.
    pub value: f64,
    /// Its standard error in the same unit.
    pub error: f64,
}

/// A range of directions in a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeasuredSpread {
    /// The range.
    pub spread: Spread,
    /// Standard error in degrees of the angle between its ends; `None` where that is not defined: an end is the hemisphere's, or noise hides where the
    /// intensity falls.
    pub error: Option<f64>,
}

/// Standard errors by which one intensity is above another without doubt.
const SURE: f64 = 3.0;
/// Standard errors that are taken off intensities where the greatest is looked for.
const CAUTION: f64 = 1.0;
/// Standard errors by which no noise lets one of many intensities stand out, or lie below what its neighbours foretell.
const CLEAR: f64 = 5.0;
/// Share of an angle above which its standard error tells nothing.
const UNKNOWN: f64 = 0.5;

/// Figures of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredFigures {
    /// Luminous flux in lm that left the luminaire.
    pub flux: WithError,
    /// It over the sources' flux; `None` where they emit none.
    pub light_output_ratio: Option<WithError>,
    /// Share of the flux below the horizontal plane, as it was counted, or else by the intensities.
    pub downward_fraction: WithError,
    /// Share of it above.
    pub upward_fraction: WithError,
    /// The greatest intensity in cd, at the direction that its neighbours choose, so that noise does not raise it.
    pub peak: WithError,
    /// Its C plane and γ in degrees.
    pub peak_direction: [f64; 2],
    /// Where the intensity is half the plane's greatest, in the planes C0–C180 and C90–C270.
    pub beam: [MeasuredSpread; 2],
    /// The same at a tenth.
    pub field: [MeasuredSpread; 2],
    /// The plane of the greatest intensity, where both of these planes miss it by more than noise.
    pub aside: Option<Aside>,
}

impl Reduced {
    /// The figures.
    pub fn figures(&self) -> MeasuredFigures {
        let down = self.share_below();
        let (place, peak) = self.peak();
        let gammas = self.goniogram.vertical.len().max(1);
        let peak_direction = [self.goniogram.horizontal[place / gammas], self.goniogram.vertical[place % gammas]];
        let errors = Goniogram { intensities: self.errors.clone(), ..self.goniogram.clone() };
        let tops = [0.0, 90.0].map(|c| self.top(&errors, c));
        let spreads = |share: f64| {
            [0, 1].map(|plane| {
                let (c, top) = (90.0 * plane as f64, tops[plane]);
                let spread = self.goniogram.spread(c, share, Some(top.value));
                MeasuredSpread { spread, error: self.spread_error(&errors, spread, c, share * top.error) }
            })
        };
        let missed = tops.iter().all(|top| top.value + SURE * top.error.hypot(peak.error) < MISSED * peak.value);
        let aside = self.goniogram.leaning(Some(&self.errors)).or(missed.then_some(peak_direction[0]));
        let emits = self.source_flux > 0.0;
        MeasuredFigures {
            flux: WithError { value: self.flux, error: self.flux_error },
            light_output_ratio: emits.then(|| WithError { value: self.flux / self.source_flux, error: self.flux_error / self.source_flux }),
            downward_fraction: down,
            upward_fraction: WithError { value: 1.0 - down.value, error: down.error },
            peak,
            peak_direction,
            beam: spreads(0.5),
            field: spreads(0.1),
            aside: aside.map(|c| self.goniogram.aside(c, None)),
        }
    }

    /// The place of the greatest intensity among those of the goniogram, and the intensity.
    fn peak(&self) -> (usize, WithError) {
        let circle = self.goniogram.symmetry == Symmetry::None;
        let (values, errors) = (&self.goniogram.intensities, &self.errors);
        let place = likely(values, errors, self.goniogram.vertical.len(), circle, self.is_even());
        (place, WithError { value: values[place], error: errors[place] })
    }

    /// Whether all steps of γ are the same.
    fn is_even(&self) -> bool {
        let steps = || self.goniogram.vertical.windows(2).map(|pair| pair[1] - pair[0]);
        steps().zip(steps().skip(1)).all(|(one, next)| (one - next).abs() < SAME)
    }

    /// The greatest intensity in the plane through C(c).
    fn top(&self, errors: &Goniogram, c: f64) -> WithError {
        let cut = |goniogram: &Goniogram| goniogram.cut(c).into_iter().map(|point| point[1]).collect::<Vec<_>>();
        let (values, errors) = (cut(&self.goniogram), cut(errors));
        let place = likely(&values, &errors, values.len(), false, self.is_even());
        WithError { value: values[place], error: errors[place] }
    }

    /// The share of the flux below the horizontal plane: as it was counted, or else by the intensities.
    pub(super) fn share_below(&self) -> WithError {
        self.counted_below.unwrap_or_else(|| self.share_by_intensities())
    }

    /// The same by the intensities: D / (D + U), with D and U taken as independent.
    pub(super) fn share_by_intensities(&self) -> WithError {
        let sum = |limits: [f64; 2]| {
            let weights = self.goniogram.flux_weights(limits);
            let terms = weights.iter().zip(&self.goniogram.intensities).zip(&self.errors);
            terms.fold([0.0; 2], |sum, ((weight, value), error)| [sum[0] + weight * value, sum[1] + (weight * error).powi(2)])
        };
        let ([down, down_variance], [up, up_variance]) = (sum([0.0, 90.0]), sum([90.0, 180.0]));
        let whole = down + up;
        if whole <= 0.0 {
            return WithError::default();
        }
        let error = (up * up * down_variance + down * down * up_variance).sqrt() / (whole * whole);
        WithError { value: down / whole, error }
    }

    /// The error of an angle between two ends at which the intensity in the plane through C(c) crosses a level that has an error itself.
    fn spread_error(&self, errors: &Goniogram, spread: Spread, c: f64, of_level: f64) -> Option<f64> {
        if spread.open != [false; 2] {
            return None;
        }
        let mut variance = 0.0;
        for end in spread.range {
            let gamma = if spread.up { (180.0 - end.abs()).copysign(end) } else { end };
            variance += self.crossing_variance(errors, c, gamma, of_level)?;
        }
        Some(variance.sqrt()).filter(|error| *error <= UNKNOWN * spread.angle())
    }

    /// The variance in square degrees of where the intensity crosses a level: it is linear between two angles whose errors are independent.
    fn crossing_variance(&self, errors: &Goniogram, c: f64, gamma: f64, of_level: f64) -> Option<f64> {
        let angles = &self.goniogram.vertical;
        let after = angles.partition_point(|angle| *angle <= gamma.abs()).clamp(1, angles.len() - 1);
        let [low, high] = [angles[after - 1], angles[after]];
        let t = ((gamma.abs() - low) / (high - low)).clamp(0.0, 1.0);
        let [low, high] = [low, high].map(|angle| angle.copysign(gamma));
        let slope = (at(&self.goniogram, c, high) - at(&self.goniogram, c, low)) / (high - low);
        let own = ((1.0 - t) * at(errors, c, low)).powi(2) + (t * at(errors, c, high)).powi(2);
        (slope != 0.0).then(|| (own + of_level * of_level) / (slope * slope))
    }
}

/// Where the greatest of noisy values in rows most likely is: chosen by what neighbours foretell, whose noise is not its own, so that its value has no bias.
/// What stands out of that by more than noise counts itself, and nothing counts for much more than it is. Some of the errors are taken off: else the least
/// exact ones would win. Rows close a circle or are mirrored at both ends.
fn likely(values: &[f64], errors: &[f64], row: usize, circle: bool, even: bool) -> usize {
    let (row, rows) = (row.max(1), values.len() / row.max(1));
    let score = |place: usize| {
        let (r, at) = (place / row, place % row);
        let beside =
            if circle { [(r + rows - 1) % rows, r, (r + 1) % rows] } else { [mirrored(r, 1, rows, false), r, mirrored(r, 1, rows, true)] };
        let foretold = beside.map(|r| foretold(&values[r * row..(r + 1) * row], at, even)).iter().sum::<f64>() / 3.0;
        let (own, error) = (values[place], errors[place]);
        let stands_out = own - foretold > CLEAR * error;
        (if stands_out { own } else { foretold.min(own + CLEAR * error) }) - CAUTION * error
    };
    greatest((0..rows * row).map(score))
}

/// A value of a row by those beside it: on a parabola where steps are even, else their mean.
fn foretold(row: &[f64], at: usize, even: bool) -> f64 {
    let mean = |step: usize| 0.5 * (row[mirrored(at, step, row.len(), false)] + row[mirrored(at, step, row.len(), true)]);
    if even && row.len() > 2 { (4.0 * mean(1) - mean(2)) / 3.0 } else { mean(1) }
}

/// The place some steps before or after another, mirrored at both ends.
fn mirrored(at: usize, step: usize, count: usize, after: bool) -> usize {
    let last = count - 1;
    let place = if after { at + step } else { at.abs_diff(step) };
    if place > last { (2 * last).saturating_sub(place) } else { place }
}

/// The place of the greatest number; the first without numbers.
fn greatest(numbers: impl Iterator<Item = f64>) -> usize {
    numbers.enumerate().fold((0, f64::NEG_INFINITY), |best, (place, number)| if number > best.1 { (place, number) } else { best }).0
}

/// The value in the plane through C(c), at a γ that is negative across from it.
fn at(goniogram: &Goniogram, c: f64, gamma: f64) -> f64 {
    if gamma < 0.0 { goniogram.intensity_at(c + 180.0, -gamma) } else { goniogram.intensity_at(c, gamma) }
}
