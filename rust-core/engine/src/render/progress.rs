//! How far a render is.

use std::time::Duration;

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
