//! What is wrong with a sheet's files.

use gonio_formats::{FormatError, Place};
use std::path::{Path, PathBuf};

/// The result of reading a sheet's files.
pub(crate) type Result<T> = std::result::Result<T, VerdictError>;

/// Why there is no sheet: a file whose content cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}", path.display(), told(error))]
pub struct VerdictError {
    /// The file: the requirements, or what was measured.
    pub path: PathBuf,
    /// What was found and what was expected.
    pub error: FormatError,
}

impl VerdictError {
    pub(crate) fn new(path: &Path, error: FormatError) -> Self {
        Self { path: path.into(), error }
    }
}

/// The place and the problem after a file's name.
fn told(error: &FormatError) -> String {
    match error.place {
        Some(Place::Line(line)) => format!(":{line}: {}", error.problem),
        _ => format!(": {error}"),
    }
}
