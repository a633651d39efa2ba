//! What levels make of the targets.

use crate::{
    error::DimmingError,
    estimate::Estimate,
    problem::Problem,
    target::{Limit, Target},
};
use serde::Serialize;

/// Standard errors within which a figure is neither above nor below its limit.
const DOUBT: f64 = 2.0;
/// The solver's own tolerance, relative to a limit.
const TOLERANCE: f64 = 1e-6;

/// Whether a target is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// By two standard errors, or exactly where there are none.
    Met,
    /// The limit is within two standard errors of the figure.
    WithinError,
    /// Missed by more than two standard errors.
    NotMet,
}

impl Verdict {
    /// Of a figure that keeps its limit by `margin`, negative where it misses it.
    pub fn new(margin: f64, error: f64, limit: f64) -> Self {
        let tolerance = TOLERANCE * limit.abs();
        match margin {
            margin if margin >= DOUBT * error - tolerance => Self::Met,
            margin if margin >= -DOUBT * error - tolerance => Self::WithinError,
            _ => Self::NotMet,
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::WithinError => "within the error",
            Self::NotMet => "not met",
        }
    }
}

/// What a target's figure comes to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reached {
    /// The target as it was written.
    pub text: String,
    /// The figure that it limits, in its unit; not a number of a colour temperature of light that is not white.
    pub reached: f64,
    /// Its standard error. That of a least or greatest point is this point's; noise moves such points outwards.
    pub error: f64,
    /// By how much the limit is kept, negative where it is missed.
    pub margin: f64,
    /// Whether it is met.
    pub verdict: Verdict,
}

impl Reached {
    /// A target's figure at these levels.
    pub(crate) fn new(problem: &Problem, target: &Target, levels: &[f64]) -> Result<Self, DimmingError> {
        let area = problem.area(target)?;
        let mean = area.mean().at(levels);
        let values = || area.points.iter().map(|point| point.at(levels));
        let by_value = |a: &Estimate, b: &Estimate| a.value.total_cmp(&b.value);
        let least = values().min_by(by_value).unwrap_or_default();
        let greatest = values().max_by(by_value).unwrap_or_default();
        let kelvin = || area.temperature(levels);
        let (figure, margin, limit) = match target.limit {
            Limit::MeanAtLeast(limit) => (mean, mean.value - limit, limit),
            Limit::MeanAtMost(limit) => (mean, limit - mean.value, limit),
            Limit::Mean(limit, by) => (mean, by - (mean.value - limit).abs(), limit),
            Limit::LeastAtLeast(limit) => (least, least.value - limit, limit),
            Limit::GreatestAtMost(limit) => (greatest, limit - greatest.value, limit),
            Limit::UniformityAtLeast(limit) => {
                let share = least.share_of(mean);
                (share, share.value - limit, limit)
            }
            Limit::CctAtLeast(limit) => (kelvin(), kelvin().value - limit, limit),
            Limit::CctAtMost(limit) => (kelvin(), limit - kelvin().value, limit),
            Limit::Cct(limit, by) => (kelvin(), by - (kelvin().value - limit).abs(), limit),
        };
        let verdict = Verdict::new(margin, figure.error, limit);
        Ok(Self { text: target.text.clone(), reached: figure.value, error: figure.error, margin, verdict })
    }
}
