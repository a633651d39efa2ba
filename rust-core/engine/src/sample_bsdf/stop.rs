//! When it is enough: the rule is asked at the same numbers of batches whatever the threads.

use crate::{
    error::Result,
    light_paths::{batches, check_rule, next_round},
};
use std::time::Duration;

/// Batches of a patch before the rule is first asked: of fewer ones their spread says little.
const FIRST: u64 = 16;
/// Most rays from a patch that can be asked for.
pub const MOST_RAYS: u64 = 1 << 34;
/// A sample that sends on less than this share counts as one that sends on so much.
const DARK: f64 = 0.01;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Relative standard error that is small enough for each incident patch: the root of the sum of squared errors over that of squared shares, by
    /// outgoing patch; 0 traces all rays.
    pub error: f64,
    /// Most rays from each patch, rounded up to whole batches.
    pub rays: u64,
    /// Most time.
    pub time: Option<Duration>,
}

impl Default for Stop {
    fn default() -> Self {
        Self { error: 0.03, rays: 1 << 20, time: None }
    }
}

impl Stop {
    /// # Errors
    /// An error that is no share, and no rays or more than [`MOST_RAYS`].
    pub(super) fn checked(&self) -> Result<()> {
        check_rule(self.error, self.rays, MOST_RAYS)
    }

    /// All batches of a patch.
    pub(super) fn batches(&self) -> u64 {
        batches(self.rays)
    }

    /// The number of batches at which the rule is asked next: powers of two, and half way between.
    pub(super) fn next(&self, done: u64) -> u64 {
        next_round(done, FIRST, self.batches())
    }

    /// The relative error of shares with their variances by outgoing patch.
    pub(super) fn error_of(shares: impl ExactSizeIterator<Item = [f64; 2]>) -> f64 {
        let count = shares.len() as f64;
        let [value, variance] = shares.fold([0.0; 2], |sum, [share, variance]| [sum[0] + share * share, sum[1] + variance]);
        (variance / value.max(DARK * DARK / count)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::LIGHT_BATCH;

    #[test]
    fn the_rule_is_asked_at_fixed_numbers() {
        let stop = Stop { rays: 40 * LIGHT_BATCH as u64 - 7, ..Stop::default() };
        let mut asked = vec![0];
        while asked.last() < Some(&stop.batches()) {
            asked.push(stop.next(asked[asked.len() - 1]));
        }
        assert_eq!(asked, [0, 16, 24, 32, 40]);
    }

    #[test]
    fn rules_that_make_no_sense_are_refused() {
        for (error, rays) in [(f64::NAN, 100), (-0.1, 100), (1.0, 100), (0.01, 0), (0.01, u64::MAX)] {
            assert!(Stop { error, rays, time: None }.checked().is_err());
        }
    }

    #[test]
    fn black_samples_are_soon_exact_enough() {
        assert_eq!(Stop::error_of([[0.0; 2]; 100].into_iter()), 0.0);
        assert!((Stop::error_of([[0.3, 9e-4], [0.4, 16e-4]].into_iter()) - 0.1).abs() < 1e-12);
        assert!((Stop::error_of([[1e-5, 1e-8]; 100].into_iter()) - 1.0).abs() < 1e-12);
    }
}
