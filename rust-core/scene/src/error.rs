//! Errors and diagnostics: the place first, then what was found and expected, then a hint.

use crate::Origin;
use gonio_formats::{FormatError, Place};
use std::path::PathBuf;

/// The result of an operation of the engine.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What stops a render.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scene element cannot be used.
    #[error("{origin}: {problem}")]
    Scene {
        /// Where the element came from.
        origin: Origin,
        /// What was found and what was expected.
        problem: String,
    },
    /// A file's content cannot be used.
    #[error("{}{}: {problem}", path.display(), line.map(|line| format!(":{line}")).unwrap_or_default())]
    Format {
        /// The file.
        path: PathBuf,
        /// The line, counted from one, where the format has lines.
        line: Option<u64>,
        /// What was found and what was expected.
        problem: String,
    },
    /// A setting is out of its range.
    #[error("{name}: {problem}")]
    Setting {
        /// The setting's name as the user knows it.
        name: String,
        /// What was found and what was expected.
        problem: String,
    },
    /// A feature that gonio does not have.
    #[error("{origin}: {feature} is not supported")]
    Unsupported {
        /// Where it was asked for.
        origin: Origin,
        /// What was asked for.
        feature: String,
    },
    /// The operating system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A defect of gonio itself, caught in a worker.
    #[error("internal error while rendering: {0}")]
    Internal(String),
    /// The caller asked to stop.
    #[error("the render was cancelled")]
    Cancelled,
}

impl Error {
    /// An I/O error with its path.
    pub fn io(path: impl Into<PathBuf>, source: std::io::Error) -> Self {
        Self::Io { path: path.into(), source }
    }
    /// What a reader found wrong with a file's content, with the file; a byte is told in the problem's words.
    pub fn in_file(path: impl Into<PathBuf>, error: &FormatError) -> Self {
        let (line, problem) = match error.place {
            Some(Place::Line(line)) => (Some(line), error.problem.clone()),
            _ => (None, error.to_string()),
        };
        Self::Format { path: path.into(), line, problem }
    }
    /// A setting's problem.
    pub fn setting(name: &str, problem: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), problem: problem.into() }
    }
    /// A scene element's problem.
    pub fn scene(origin: &Origin, problem: impl Into<String>) -> Self {
        Self::Scene { origin: origin.clone(), problem: problem.into() }
    }
}

/// How much a diagnostic matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// The picture is made, but differs from what was asked for.
    Warning,
}

/// Something that is not fatal, with its origin; hosts show the list.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Diagnostic {
    /// How much it matters.
    pub severity: Severity,
    /// Where it came from.
    pub origin: Origin,
    /// What was found, what was done instead.
    pub message: String,
}

impl Diagnostic {
    /// A warning.
    pub fn warning(origin: &Origin, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, origin: origin.clone(), message: message.into() }
    }
    /// A note.
    pub fn info(origin: &Origin, message: impl Into<String>) -> Self {
        Self { severity: Severity::Info, origin: origin.clone(), message: message.into() }
    }
}

impl std::fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.origin, self.message)
    }
}
