//! Objects of JSON, with what is wrong with them.

use gonio_formats::FormatError;
use serde_json::{Map, Value};

/// What a file holds.
pub(super) type Found<T> = Result<T, FormatError>;

/// What is said of all other files.
pub(super) const EXPECTED: &str = "expected what 'gonio measure', 'gonio annual', 'gonio view-out', 'gonio road', 'gonio emergency', 'gonio sports' or 'gonio zones' print with --json";

pub(super) fn no_json(bytes: &[u8], error: &serde_json::Error) -> FormatError {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return FormatError::whole(format!("an empty file, {EXPECTED}"));
    }
    let message = error.to_string();
    let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(message, _)| message).to_owned();
    FormatError::line(error.line() as u64, format!("no JSON at column {}: {message}; {EXPECTED}", error.column()))
}

/// Objects of a list under a key; what is none is told.
pub(super) fn objects<'a>(of: &'a Map<String, Value>, key: &str) -> Found<Vec<&'a Map<String, Value>>> {
    let wrong = || FormatError::whole(format!("'{key}' is not a list of objects, {EXPECTED}"));
    let list = of.get(key).and_then(Value::as_array).ok_or_else(wrong)?;
    list.iter().map(|entry| entry.as_object().ok_or_else(wrong)).collect()
}

/// A text under a key.
pub(super) fn text<'a>(of: &'a Map<String, Value>, key: &str, what: &str) -> Found<&'a str> {
    let wrong = || FormatError::whole(format!("{what} has no '{key}', {EXPECTED}"));
    of.get(key).and_then(Value::as_str).ok_or_else(wrong)
}

/// A number under a key, if there is one.
pub(super) fn number(of: &Map<String, Value>, key: &str) -> Option<f64> {
    of.get(key).and_then(Value::as_f64).filter(|value| value.is_finite())
}

/// A standard error, if there is one; one below 0 is told.
pub(super) fn error(of: &Map<String, Value>, key: &str) -> Found<Option<f64>> {
    let found = number(of, key);
    match found {
        Some(error) if error < 0.0 => Err(FormatError::whole(format!("'{key}' is {error}, expected a standard error of zero or more"))),
        found => Ok(found),
    }
}
