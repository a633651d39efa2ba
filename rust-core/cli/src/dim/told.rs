//! What is told of a dimming.

use crate::{arguments::DimOptions, messages::say};
use gonio::Error;
use gonio_dimming::DimmingError;

/// A dimming's error as that of an option.
pub(super) fn told(option: &str, error: DimmingError) -> Error {
    match error {
        DimmingError::Solver(problem) => Error::Internal(problem),
        other => Error::setting(option, other.to_string()),
    }
}

/// A note, unless nothing but answers is wanted.
pub(super) fn note(options: &DimOptions, text: &str) {
    if !options.measuring.quiet {
        say(text);
    }
}
