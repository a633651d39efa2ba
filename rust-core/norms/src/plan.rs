//! What plans of all kinds have: TOML, with what is wrong in it.

use gonio_formats::FormatError;
use serde::de::DeserializeOwned;

/// The most points of a route or an area.
const MOST_POINTS: f64 = 200_000.0;

/// Reads a plan whose fields are known, and checks it.
///
/// # Errors
/// What is no such TOML, with its line; what the check says.
pub(crate) fn read<T: DeserializeOwned>(text: &str, check: impl Fn(&T) -> Result<(), String>) -> Result<T, FormatError> {
    let plan = toml::from_str(text).map_err(|error| told(text, &error))?;
    check(&plan).map_err(FormatError::whole)?;
    Ok(plan)
}

/// What TOML says of a file, with its line.
fn told(text: &str, error: &toml::de::Error) -> FormatError {
    let problem = error.message().lines().collect::<Vec<_>>().join(" ");
    match error.span() {
        Some(span) => FormatError::line(1 + text.bytes().take(span.start).filter(|byte| *byte == b'\n').count() as u64, problem),
        None => FormatError::whole(problem),
    }
}

pub(crate) fn within(name: &str, value: f64, [least, most]: [f64; 2]) -> Result<(), String> {
    if (least..=most).contains(&value) { Ok(()) } else { Err(format!("{name} is {value}, expected {least} to {most}")) }
}

pub(crate) fn few(points: f64) -> Result<(), String> {
    if points <= MOST_POINTS {
        Ok(())
    } else {
        Err(format!("about {points:.0} points, expected {MOST_POINTS:.0} at most; a wider spacing has fewer"))
    }
}

/// What soiling and ageing leave, where a plan says nothing of it; the whole flux.
pub(crate) fn one() -> f64 {
    1.0
}
