//! The one match from the engine's errors to Python's exceptions.

use gonio::{Diagnostic, Error as EngineError};
use pyo3::{
    PyErr, create_exception,
    exceptions::{PyBaseException, PyException},
    prelude::*,
};
use std::io::ErrorKind;

create_exception!(gonio, Error, PyException, "What gonio raises; `.origin`, `.path`, `.line` and `.hint` tell where.");
create_exception!(gonio, SceneError, Error, "A scene element cannot be used.");
create_exception!(gonio, FormatError, Error, "A file's content cannot be used.");
create_exception!(gonio, SettingError, Error, "A setting is out of its range.");
create_exception!(gonio, UnsupportedError, Error, "A feature that gonio does not have.");
create_exception!(gonio, Cancelled, Error, "The caller asked to stop.");

/// Diagnostics as Python has them: (origin, message).
pub(crate) fn told<'a>(diagnostics: impl IntoIterator<Item = &'a Diagnostic>) -> Vec<(String, String)> {
    diagnostics.into_iter().map(|found| (found.origin.to_string(), found.message.clone())).collect()
}

/// The exception for a setting's problem.
pub(crate) fn setting(name: &str, problem: impl Into<String>) -> PyErr {
    exception(EngineError::setting(name, problem))
}

/// The exception for a setting's problem, for Python to raise.
#[pyfunction]
pub(crate) fn _setting_error(py: Python<'_>, name: &str, problem: String) -> Py<PyBaseException> {
    setting(name, problem).into_value(py)
}

/// The exception for an engine's error.
pub(crate) fn exception(error: EngineError) -> PyErr {
    let message = error.to_string();
    let (made, origin, path, line) = match error {
        EngineError::Scene { origin, .. } => (SceneError::new_err(message), Some(origin), None, None),
        EngineError::Format { path, line, .. } => (FormatError::new_err(message), None, Some(path), line),
        EngineError::Setting { .. } => (SettingError::new_err(message), None, None, None),
        EngineError::Unsupported { origin, .. } => (UnsupportedError::new_err(message), Some(origin), None, None),
        EngineError::Io { path, source } => (io_exception(&source, message), None, Some(path), None),
        EngineError::Internal(_) => (Error::new_err(message), None, None, None),
        EngineError::Cancelled => (Cancelled::new_err(message), None, None, None),
    };
    Python::attach(|py| {
        let value = made.value(py);
        let attributes = || -> PyResult<()> {
            value.setattr("origin", origin.map(|origin| origin.name.to_string()))?;
            value.setattr("path", path.map(|path| path.display().to_string()))?;
            value.setattr("line", line)?;
            value.setattr("hint", None::<String>)
        };
        // Exceptions take attributes; if one did not, the message alone still says it all.
        let _ = attributes();
    });
    made
}

fn io_exception(source: &std::io::Error, message: String) -> PyErr {
    use pyo3::exceptions::{PyFileExistsError, PyFileNotFoundError, PyOSError, PyPermissionError};
    match source.kind() {
        ErrorKind::NotFound => PyFileNotFoundError::new_err(message),
        ErrorKind::PermissionDenied => PyPermissionError::new_err(message),
        ErrorKind::AlreadyExists => PyFileExistsError::new_err(message),
        _ => PyOSError::new_err(message),
    }
}
