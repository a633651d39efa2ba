//! Limits and verdicts.

use crate::estimate::Estimate;

/// Standard errors within which a figure is neither above nor below its limit.
pub(crate) const DOUBT: f64 = 2.0;
/// Rounding of the figures, relative to a limit.
const TOLERANCE: f64 = 1e-9;

/// On which side of a limit a figure is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The limit or more.
    AtLeast,
    /// The limit or less.
    AtMost,
}

impl Bound {
    /// By how much a figure keeps a limit, negative where it misses it.
    pub(crate) fn margin(self, value: f64, limit: f64) -> f64 {
        match self {
            Self::AtLeast => value - limit,
            Self::AtMost => limit - value,
        }
    }

    /// The key that names it.
    pub fn key(self) -> &'static str {
        match self {
            Self::AtLeast => "at_least",
            Self::AtMost => "at_most",
        }
    }
}

/// Whether a requirement is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// By two standard errors, or exactly where there are none.
    Met,
    /// The limit is within two standard errors of the figure.
    WithinError,
    /// Missed by more than two standard errors.
    NotMet,
    /// There is no such figure.
    NotMeasured,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Met, Self::NotMet, Self::WithinError, Self::NotMeasured];

    /// Of a figure that keeps its limit by `margin`, negative where it misses it.
    pub(crate) fn new(margin: f64, error: f64, limit: f64) -> Self {
        let tolerance = TOLERANCE * limit.abs();
        match margin {
            margin if margin >= DOUBT * error - tolerance => Self::Met,
            margin if margin >= -DOUBT * error - tolerance => Self::WithinError,
            _ => Self::NotMet,
        }
    }

    /// As JSON has it.
    pub fn key(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::WithinError => "within_error",
            Self::NotMet => "not_met",
            Self::NotMeasured => "not_measured",
        }
    }
}

/// How many times as many samples, about, put the limit out of reach of two standard errors: errors go with the root of the samples. Infinite for a
/// figure on its limit.
pub(crate) fn more_samples(figure: Estimate, margin: f64) -> f64 {
    (DOUBT * figure.error.unwrap_or(0.0) / margin).powi(2).max(1.0)
}
