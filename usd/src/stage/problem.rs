//! What is wrong with a stage's files, in a line each.

use crate::pxr;
use gonio::scene::Origin;
use gonio::{Diagnostic, Error};
use pyo3::prelude::*;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Most messages of `pxr` that are passed on.
const MAX_PXR_MESSAGES: usize = 50;

/// An error about a file as a whole.
pub(super) fn format_error(path: &Path, problem: impl Into<String>) -> Error {
    Error::Format { path: path.to_owned(), line: None, problem: problem.into() }
}

/// An exception of `pxr` about a layer, with the place in the file where it has one.
pub(super) fn unreadable(py: Python<'_>, path: &Path, error: &PyErr) -> Error {
    let message = pxr::message_of(py, error);
    match pxr::place_in(&message) {
        Some(place) => Error::Format {
            path: place.file.into(),
            line: Some(place.line),
            problem: format!("column {}: {}", place.column, place.problem),
        },
        None if message.starts_with("Failed to open layer") => format_error(path, "the file cannot be read as a USD layer"),
        None => format_error(path, message),
    }
}

/// A file where no prim is meant.
pub(super) fn file_origin(path: &Path) -> Origin {
    Origin { name: Arc::from(""), file: Arc::from(path.to_string_lossy().as_ref()) }
}

/// What could not be composed.
pub(super) fn composition_errors(stage: &Bound<'_, PyAny>, path: &Path) -> Vec<Diagnostic> {
    let py = stage.py();
    let list = stage.call_method0("GetCompositionErrors").and_then(|list| list.try_iter()?.collect::<PyResult<Vec<_>>>());
    let text = |error: Bound<'_, PyAny>| match error.str().and_then(|text| text.extract::<String>()) {
        Ok(text) => pxr::one_line(&text),
        Err(problem) => pxr::message_of(py, &problem),
    };
    let origin = file_origin(path);
    list.unwrap_or_default().into_iter().map(|error| Diagnostic::warning(&origin, text(error))).collect()
}

/// The same with one line a file that cannot be opened, however many prims refer to it.
pub(super) fn counted(errors: &[Diagnostic]) -> Vec<Diagnostic> {
    let mut told: Vec<Diagnostic> = Vec::new();
    let mut files: HashMap<&str, (usize, usize)> = HashMap::new();
    for error in errors {
        let file = error.message.strip_prefix("Could not open asset @").and_then(|rest| rest.split_once('@'));
        let Some((file, _)) = file else {
            told.push(error.clone());
            continue;
        };
        let (_, count) = files.entry(file).or_insert((told.len(), 0));
        *count += 1;
        if *count == 1 {
            told.push(error.clone());
        }
    }
    for (place, count) in files.into_values().filter(|(_, count)| *count > 1) {
        told[place].message.push_str(&format!(" ({count} places, this is the first)"));
    }
    told
}

/// Messages of `pxr` that say something new.
pub(super) fn passed_on(messages: Vec<String>, known: &[Diagnostic], path: &Path) -> Vec<Diagnostic> {
    let origin = file_origin(path);
    let mut passed: Vec<Diagnostic> = Vec::new();
    for message in messages {
        let is_known = known.iter().any(|diagnostic| message.contains(diagnostic.message.as_str()));
        if !is_known && !passed.iter().any(|earlier| earlier.message == message) && passed.len() < MAX_PXR_MESSAGES {
            passed.push(Diagnostic::info(&origin, message));
        }
    }
    passed
}
