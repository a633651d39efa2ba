//! Figures of a measurement with their standard errors.

use super::Reduced;
use crate::photometry::{Goniogram, Spread};

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
    /// Standard error in degrees of the angle between its ends; `None` where the intensity is flat at one of them.
    pub error: Option<f64>,
}

/// Figures of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredFigures {
    /// Luminous flux in lm that left the luminaire.
    pub flux: WithError,
    /// It over the sources' flux; `None` where they emit none.
    pub light_output_ratio: Option<WithError>,
    /// Share of the flux below the horizontal plane, by the intensities.
    pub downward_fraction: WithError,
    /// Share of it above.
    pub upward_fraction: WithError,
    /// The greatest intensity in cd.
    pub peak: WithError,
    /// Where the intensity is half the plane's greatest, in the planes C0–C180 and C90–C270.
    pub beam: [MeasuredSpread; 2],
    /// The same at a tenth.
    pub field: [MeasuredSpread; 2],
}

impl Reduced {
    /// The figures.
    pub fn figures(&self) -> MeasuredFigures {
        let figures = self.goniogram.figures();
        let down = self.share_below();
        let index = self.goniogram.intensities.iter().position(|value| *value >= figures.peak).unwrap_or(0);
        let errors = Goniogram { intensities: self.errors.clone(), ..self.goniogram.clone() };
        let spread = |spread: Spread, plane: usize, share: f64| MeasuredSpread {
            spread,
            error: self.spread_error(&errors, spread, 90.0 * plane as f64, share),
        };
        let emits = self.source_flux > 0.0;
        MeasuredFigures {
            flux: WithError { value: self.flux, error: self.flux_error },
            light_output_ratio: emits.then(|| WithError { value: self.flux / self.source_flux, error: self.flux_error / self.source_flux }),
            downward_fraction: down,
            upward_fraction: WithError { value: 1.0 - down.value, error: down.error },
            peak: WithError { value: figures.peak, error: self.errors.get(index).copied().unwrap_or(0.0) },
            beam: [0, 1].map(|plane| spread(figures.beam[plane], plane, 0.5)),
            field: [0, 1].map(|plane| spread(figures.field[plane], plane, 0.1)),
        }
    }

    /// The share of the flux below the horizontal plane: D / (D + U), with D and U taken as independent.
    fn share_below(&self) -> WithError {
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

    /// The error of an angle between two ends at which the intensity crosses a share of the greatest in the plane through C(c).
    fn spread_error(&self, errors: &Goniogram, spread: Spread, c: f64, share: f64) -> Option<f64> {
        let inside = |point: &[f64; 2]| point[0].abs() == 90.0 || (point[0].abs() > 90.0) == spread.up;
        let points = self.goniogram.cut(c).into_iter().filter(inside);
        let top = points.fold([0.0; 2], |top, point| if point[1] > top[1] { point } else { top });
        let of_top = share * at(errors, c, top[0]);
        let mut variance = 0.0;
        for end in spread.range {
            let gamma = if spread.up { (180.0 - end.abs()).copysign(end) } else { end };
            variance += self.crossing_variance(errors, c, gamma, of_top)?;
        }
        Some(variance.sqrt())
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

/// The value in the plane through C(c), at a γ that is negative across from it.
fn at(goniogram: &Goniogram, c: f64, gamma: f64) -> f64 {
    if gamma < 0.0 { goniogram.intensity_at(c + 180.0, -gamma) } else { goniogram.intensity_at(c, gamma) }
}
