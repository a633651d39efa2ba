//! How far a render is.

use std::time::{Duration, Instant};

/// A snapshot of a render's progress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Blocks done over all blocks, 0 to 1.
    pub fraction: f64,
    /// Samples a pixel that every tile has.
    pub samples: u32,
    /// Samples a pixel wanted.
    pub samples_total: u32,
    /// Time since the start.
    pub elapsed: Duration,
    /// Estimated time to the end, once there is anything to go by.
    pub remaining: Option<Duration>,
    /// Rays traced, shadow rays among them.
    pub rays: u64,
}

impl Progress {
    /// That of a whole of which so many equal parts are done, and this is the progress of the next; the whole began at `start`.
    pub(crate) fn of_whole(&self, done: usize, parts: usize, start: Instant) -> Self {
        let (fraction, elapsed) = ((done as f64 + self.fraction) / parts as f64, start.elapsed());
        let remaining = (fraction > 0.0).then(|| elapsed.mul_f64(1.0 / fraction - 1.0));
        Self { fraction, elapsed, remaining, ..*self }
    }
}
