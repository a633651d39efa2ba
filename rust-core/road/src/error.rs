//! What is wrong with a road's files.

use gonio_formats::{FormatError, Place};
use std::path::{Path, PathBuf};

/// The result of reading a road's files.
pub(crate) type Result<T> = std::result::Result<T, RoadError>;

/// Why a road cannot be calculated.
#[derive(Debug, thiserror::Error)]
pub enum RoadError {
    /// A file's content cannot be used.
    #[error("{}{}", path.display(), told(error))]
    Content {
        /// The file: the road's own, a luminaire's or a surface's.
        path: PathBuf,
        /// What was found and what was expected.
        error: FormatError,
    },
    /// The operating system refused a file.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl RoadError {
    /// A problem of a file's content.
    pub(crate) fn content(path: &Path, error: FormatError) -> Self {
        Self::Content { path: path.into(), error }
    }
}

/// The place and the problem after a file's name.
fn told(error: &FormatError) -> String {
    match error.place {
        Some(Place::Line(line)) => format!(":{line}: {}", error.problem),
        _ => format!(": {error}"),
    }
}
