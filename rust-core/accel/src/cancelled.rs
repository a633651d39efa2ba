//! The error of a build that was cancelled.

use std::sync::atomic::{AtomicBool, Ordering};

/// The build was cancelled through its flag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

impl Cancelled {
    /// Fails once the flag is set.
    pub(crate) fn check(cancel: &AtomicBool) -> Result<(), Cancelled> {
        if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }
}

impl std::fmt::Display for Cancelled {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("cancelled")
    }
}

impl std::error::Error for Cancelled {}
