//! Whether a compilation goes on.

use crate::error::{Error, Result};
use std::sync::atomic::{AtomicBool, Ordering};

/// [`Error::Cancelled`] once it is cancelled.
pub(super) fn check(cancel: &AtomicBool) -> Result<()> {
    if cancel.load(Ordering::Relaxed) { Err(Error::Cancelled) } else { Ok(()) }
}
