//! Values with their errors.

use serde::Serialize;

/// A value and its standard error, in the unit of what was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

impl Estimate {
    /// A value known so well.
    pub fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }

    /// So many times as much.
    pub fn times(self, factor: f64) -> Self {
        Self { value: factor * self.value, error: factor.abs() * self.error }
    }

    /// With another that is independent of it.
    pub fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, error: self.error.hypot(other.error) }
    }

    /// The mean of independent ones; 0 of none.
    pub fn mean(all: impl Iterator<Item = Self>) -> Self {
        let (count, sum) = all.fold((0.0, Self::default()), |(count, sum), one| (count + 1.0, sum.plus(one)));
        sum.times(1.0 / f64::max(count, 1.0))
    }

    /// The share that it is of a whole; 0 of nothing.
    pub fn share_of(self, whole: Self) -> Self {
        if whole.value <= 0.0 {
            return Self::default();
        }
        let value = self.value / whole.value;
        Self { value, error: (self.error / whole.value).hypot(value * whole.error / whole.value) }
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.value.is_finite() && self.error.is_finite() && self.error >= 0.0
    }
}
