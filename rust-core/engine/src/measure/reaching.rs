//! How many of several readings reach a value, and for how many their errors leave it open.

use super::reading::Reading;

/// Standard errors from a value within which a reading does not tell on which side of it it lies; verdicts have the same.
const OPEN: f64 = 2.0;

/// How many readings reach a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaching {
    /// How many readings there are, those without a figure left out.
    pub count: usize,
    /// How many are no less than the value.
    pub reached: usize,
    /// How many reach it by less than two standard errors, and how many miss it by less.
    pub open: [usize; 2],
}

impl Reaching {
    pub(super) fn new(readings: impl Iterator<Item = Reading>, target: f64) -> Self {
        let mut found = Self { count: 0, reached: 0, open: [0; 2] };
        for Reading { value, standard_error } in readings.filter(Reading::is_known) {
            let misses = usize::from(value < target);
            found.count += 1;
            found.reached += 1 - misses;
            found.open[misses] += usize::from((value - target).abs() < OPEN * standard_error);
        }
        found
    }

    /// The share that reaches it, 0 to 1. Two of its standard errors take in all readings that errors leave open, on the side where there are more.
    pub fn share(&self) -> Reading {
        let [over, under] = self.open;
        Reading { value: self.of_all(self.reached), standard_error: self.of_all(over.max(under)) / OPEN }
    }

    /// The share that errors leave open.
    pub fn share_open(&self) -> f64 {
        self.of_all(self.open[0] + self.open[1])
    }

    fn of_all(&self, count: usize) -> f64 {
        if self.count > 0 { count as f64 / self.count as f64 } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_near_the_value_are_open() {
        let readings = [(300.0, 10.0), (260.0, 6.0), (249.0, 1.0), (240.0, 4.0), (230.0, 0.0), (f64::NAN, f64::NAN)];
        let found = Reaching::new(readings.into_iter().map(|(value, standard_error)| Reading { value, standard_error }), 250.0);
        assert_eq!(found, Reaching { count: 5, reached: 2, open: [1, 1] });
        assert_eq!((found.share(), found.share_open()), (Reading { value: 0.4, standard_error: 0.1 }, 0.4));
        assert_eq!(Reaching::new(std::iter::empty(), 1.0).share(), Reading { value: 0.0, standard_error: 0.0 });
    }
}
