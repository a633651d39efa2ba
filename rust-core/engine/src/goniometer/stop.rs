//! When it is enough: the stopping rule, asked at the same numbers of batches whatever the threads.

use crate::{
    error::Result,
    light_paths::{batches, check_rule, next_round},
};
use std::time::Duration;

/// Batches before the rule is first asked.
const FIRST: u64 = 64;
/// Most rays that can be asked for: what sums in fixed point are laid out for.
pub const MOST_RAYS: u64 = 1 << 40;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Relative standard error at the peak and of the flux that is small enough; 0 traces all rays.
    pub error: f64,
    /// Most rays of each kind of source, rounded up to whole batches.
    pub rays: u64,
    /// Most time.
    pub time: Option<Duration>,
}

impl Default for Stop {
    fn default() -> Self {
        Self { error: 0.01, rays: 200_000_000, time: None }
    }
}

impl Stop {
    /// # Errors
    /// An error that is no share, and no rays or more than [`MOST_RAYS`].
    pub(super) fn checked(&self) -> Result<()> {
        check_rule(self.error, self.rays, MOST_RAYS)
    }

    /// All batches.
    pub(super) fn batches(&self) -> u64 {
        batches(self.rays)
    }

    /// The number of batches at which the rule is asked next: powers of two, and half way between.
    pub(super) fn next(&self, done: u64) -> u64 {
        next_round(done, FIRST, self.batches())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::LIGHT_BATCH;

    #[test]
    fn the_rule_is_asked_at_fixed_numbers() {
        let stop = Stop { rays: 500 * LIGHT_BATCH as u64 - 7, ..Stop::default() };
        let mut asked = vec![0];
        while asked.last() < Some(&stop.batches()) {
            asked.push(stop.next(asked[asked.len() - 1]));
        }
        assert_eq!(asked, [0, 64, 96, 128, 192, 256, 384, 500]);
    }

    #[test]
    fn rules_that_make_no_sense_are_refused() {
        for (error, rays) in [(f64::NAN, 100), (-0.1, 100), (1.0, 100), (0.01, 0), (0.01, u64::MAX)] {
            assert!(Stop { error, rays, time: None }.checked().is_err());
        }
    }
}
