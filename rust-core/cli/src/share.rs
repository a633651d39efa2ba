//! Shares of the command line.

use crate::daylight::number;
use gonio::Result;

/// A share: `1%`, `0.01`.
pub(crate) fn share(name: &str, text: &str) -> Result<f64> {
    match text.trim().strip_suffix('%') {
        Some(percents) => number(name, percents).map(|x| x / 100.0),
        None => number(name, text),
    }
}
