//! What is wrong with a year's files.

use gonio_formats::{FormatError, Place};
use std::path::{Path, PathBuf};

/// The result of this crate.
pub(crate) type Result<T> = std::result::Result<T, AnnualError>;

/// Why a year cannot be calculated.
#[derive(Debug, thiserror::Error)]
pub enum AnnualError {
    /// A file's content cannot be used.
    #[error("{}{}", path.display(), told(error))]
    Content {
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        error: FormatError,
    },
    /// Inputs that do not fit each other, or a setting out of its range.
    #[error("{name}: {problem}")]
    Setting {
        /// What was set.
        name: &'static str,
        /// What was found and what was expected.
        problem: String,
    },
}

impl AnnualError {
    /// A problem of a file's content.
    pub(crate) fn content(path: &Path, error: FormatError) -> Self {
        Self::Content { path: path.into(), error }
    }

    /// A problem of a setting.
    pub(crate) fn setting(name: &'static str, problem: impl Into<String>) -> Self {
        Self::Setting { name, problem: problem.into() }
    }
}

/// The place and the problem after a file's name.
fn told(error: &FormatError) -> String {
    match error.place {
        Some(Place::Line(line)) => format!(":{line}: {}", error.problem),
        _ => format!(": {error}"),
    }
}
