//! How often checkpoints are written.

use std::time::{Duration, Instant};

/// Writing takes at most one part in so many of the time.
const SHARE: u32 = 20;

/// When the next checkpoint is due.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    every: Duration,
    due: Instant,
}

impl Pace {
    /// So much time between checkpoints, from now on; where writing one takes long, at least twenty times as long as that.
    pub fn new(every: Duration) -> Self {
        Self { every, due: Instant::now() + every }
    }

    /// Whether it is time.
    pub fn is_due(&self) -> bool {
        Instant::now() >= self.due
    }

    /// Writes one, after which the time begins anew.
    pub fn written<T>(&mut self, write: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = write();
        self.due = Instant::now() + self.every.max(SHARE * start.elapsed());
        result
    }
}
