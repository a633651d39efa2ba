//! Pictures of a render under way: every so many seconds, and when SIGUSR1 comes.

use gonio::{Error, Result};
use std::{
    sync::atomic::{AtomicBool, Ordering},
    time::{Duration, Instant},
};

/// Set by SIGUSR1.
pub(super) static SNAPSHOT_ASKED: AtomicBool = AtomicBool::new(false);

/// Writing takes at most one part in so many of the time.
const SHARE: u32 = 10;
/// Longest time between snapshots, seconds.
const MOST_SECONDS: f64 = 1e9;

/// Tells when a snapshot is due.
pub(super) struct Snapshots {
    every: Option<Duration>,
    due: Option<Instant>,
}

impl Snapshots {
    /// Every so many seconds; without a number when asked alone.
    pub(super) fn new(seconds: Option<f64>) -> Result<Self> {
        if let Some(wrong) = seconds.filter(|seconds| seconds.is_nan() || *seconds <= 0.0) {
            return Err(Error::setting("snapshot", format!("{wrong} was found, expected seconds above 0")));
        }
        let every = seconds.map(|seconds| Duration::from_secs_f64(seconds.min(MOST_SECONDS)));
        Ok(Self { every, due: every.map(|every| Instant::now() + every) })
    }

    /// Takes a snapshot if one is due or asked for.
    pub(super) fn take_if_due(&mut self, take: impl FnOnce()) {
        let is_due = self.due.is_some_and(|due| Instant::now() >= due);
        if SNAPSHOT_ASKED.swap(false, Ordering::Relaxed) || is_due {
            let start = Instant::now();
            take();
            let pause = self.every.map(|every| every.max(SHARE * start.elapsed()));
            self.due = pause.map(|pause| Instant::now() + pause);
        }
    }
}
