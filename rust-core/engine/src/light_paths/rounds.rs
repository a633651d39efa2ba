//! Rounds of batches: a stopping rule is asked at the same numbers of batches whatever the threads.

use crate::{
    error::{Error, Result},
    transport::LIGHT_BATCH,
};
use std::time::Duration;

/// How far a measurement is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Paths traced.
    pub paths: u64,
    /// The most there may be.
    pub most: u64,
    /// The relative standard error that the rule looks at, once it is known.
    pub error: Option<f64>,
    /// Time since the start.
    pub elapsed: Duration,
}

/// # Errors
/// An error that is no share, and no rays or more than `most`.
pub(crate) fn check_rule(error: f64, rays: u64, most: u64) -> Result<()> {
    if !(0.0..1.0).contains(&error) {
        return Err(Error::setting("error", format!("{error} was found, expected a share from 0 to below 1")));
    }
    if !(1..=most).contains(&rays) {
        return Err(Error::setting("rays", format!("{rays} was found, expected 1 to {most}")));
    }
    Ok(())
}

/// Batches of so many rays, rounded up to whole ones.
pub(crate) fn batches(rays: u64) -> u64 {
    rays.div_ceil(LIGHT_BATCH as u64).max(2)
}

/// The number of batches at which the rule is asked next: `first`, then powers of two and half way between, at last `all`.
pub(crate) fn next_round(done: u64, first: u64, all: u64) -> u64 {
    let next = if done < first {
        first
    } else {
        let power = 1 << done.ilog2();
        if done < power + power / 2 { power + power / 2 } else { 2 * power }
    };
    next.min(all)
}
