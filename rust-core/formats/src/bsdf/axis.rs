//! One axis of a table: an explicit list of knots, as a gonioreflectometer gives them.

use core::f64::consts::TAU;

use super::direction::wrapped;
use crate::error::{FormatError, Result};

/// What happens between the knots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Linear between knots, constant beyond the first and the last.
    Linear,
    /// The nearest knot's value: patches with borders in the middle between knots.
    Nearest,
    /// Linear, and from the last knot on to the first one's repetition.
    Periodic {
        /// After what distance everything repeats, radians; larger than from the first knot to the last.
        period: f64,
    },
}

/// Knots and what happens between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    knots: Vec<f64>,
    mode: Mode,
}

/// The two knots around a place, and how far it is from the lower to the upper one, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: usize,
    pub(crate) high: usize,
    pub(crate) t: f64,
}

impl Axis {
    /// An axis with knots in radians.
    ///
    /// # Errors
    /// When there is no knot, one is not finite, they do not strictly increase, or a period does not exceed their span.
    pub fn new(knots: Vec<f64>, mode: Mode) -> Result<Self> {
        let (Some(first), Some(last)) = (knots.first(), knots.last()) else {
            return Err(FormatError::whole("an axis without values, expected at least one"));
        };
        if let Some(bad) = knots.iter().find(|k| !k.is_finite()) {
            return Err(FormatError::whole(format!("axis value {bad}, expected a finite number")));
        }
        if let Some(w) = knots.windows(2).find(|w| w[0] >= w[1]) {
            let (low, high) = (degrees(w[0]), degrees(w[1]));
            return Err(FormatError::whole(format!("axis value {high}° after {low}°, expected strictly increasing ones")));
        }
        if let Mode::Periodic { period } = mode {
            // A repeated first knot at the very end would be a second value for one place.
            if !(period.is_finite() && last - first < period * (1.0 - 1e-9)) {
                let (period, span) = (degrees(period), degrees(last - first));
                return Err(FormatError::whole(format!("period of {period}°, expected more than the axis spans ({span}°)")));
            }
        }
        Ok(Self { knots, mode })
    }

    /// `count` knots at equal steps from `first` to `last` inclusive, radians.
    ///
    /// # Errors
    /// As [`Axis::new`].
    pub fn uniform(first: f64, last: f64, count: usize, mode: Mode) -> Result<Self> {
        let step = if count > 1 { (last - first) / (count - 1) as f64 } else { 0.0 };
        Self::new((0..count).map(|i| first + step * i as f64).collect(), mode)
    }

    /// The knots, radians.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// What happens between them.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Where `x` lies. An azimuth is first moved by whole turns to the knots.
    pub(crate) fn locate(&self, x: f64, is_azimuth: bool) -> Interval {
        let first = self.knots[0];
        let x = match self.mode {
            Mode::Periodic { period } => wrapped(x, first, period),
            _ if is_azimuth => self.around_ends(wrapped(x, first, TAU)),
            _ => x,
        };
        let above = self.knots.partition_point(|&k| k <= x);
        let last = self.knots.len() - 1;
        let (low, high) = (above.saturating_sub(1), above.min(last));
        let (start, end) = match self.mode {
            Mode::Periodic { period } if above > last => return self.around(last, x, first + period),
            _ => (self.knots[low], self.knots[high]),
        };
        let t = if end > start { (x - start) / (end - start) } else { 0.0 };
        match self.mode {
            Mode::Nearest => Interval { low, high, t: if t < 0.5 { 0.0 } else { 1.0 } },
            _ => Interval { low, high, t },
        }
    }

    /// An azimuth in the gap of an axis that is not a full turn, at the nearer end.
    fn around_ends(&self, x: f64) -> f64 {
        let (first, last) = (self.knots[0], self.knots[self.knots.len() - 1]);
        if x - last > first + TAU - x { first } else { x }
    }

    /// Between the last knot and the first one's repetition at `end`.
    fn around(&self, last: usize, x: f64, end: f64) -> Interval {
        Interval { low: last, high: 0, t: (x - self.knots[last]) / (end - self.knots[last]) }
    }
}

/// Radians as degrees without the last digits' noise, for files and messages.
pub(crate) fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e10).round() / 1e10
}
