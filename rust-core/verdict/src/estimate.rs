//! Values with their errors.

/// A value and its standard error, `None` where there is no noise or it is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Estimate {
    pub(crate) value: f64,
    pub(crate) error: Option<f64>,
}

impl Estimate {
    pub(crate) fn new(value: f64, error: Option<f64>) -> Self {
        Self { value, error }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        Self { value: factor * self.value, error: self.error.map(|error| factor.abs() * error) }
    }

    /// The ratio to another, their errors independent; `None` to nothing.
    pub(crate) fn over(self, whole: Self) -> Option<Self> {
        let value = self.value / whole.value;
        let error = |part: f64, of: f64| (part / whole.value).hypot(value * of / whole.value);
        let error = match (self.error, whole.error) {
            (None, None) => None,
            (part, of) => Some(error(part.unwrap_or(0.0), of.unwrap_or(0.0))),
        };
        (whole.value > 0.0).then_some(Self { value, error })
    }

    /// The error over the value; 0 without an error, infinite of nothing.
    pub(crate) fn relative(self) -> f64 {
        self.error.filter(|error| *error > 0.0).map_or(0.0, |error| error / self.value.abs())
    }
}
