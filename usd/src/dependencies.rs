//! The files that a stage is made of.

use crate::pxr::{self, Module};
use gonio::{Error, Result};
use pyo3::prelude::*;
use std::path::Path;

/// Paths of all layers of the stage in a file and of all assets that they name and that are found, the file itself among them, some more
/// than once; a file inside a package stands for its package.
///
/// # Errors
/// [`Error::Setting`] without `pxr`, [`Error::Format`] when the file cannot be read.
pub fn files_of_stage(py: Python<'_>, path: &Path) -> Result<Vec<String>> {
    pxr::ensure(py)?;
    let unreadable = |error: PyErr| Error::Format { path: path.to_owned(), line: None, problem: pxr::message_of(py, &error) };
    let mut names = names(py, path).map_err(unreadable)?;
    names.retain(|name| !name.is_empty());
    Ok(names)
}

fn names(py: Python<'_>, path: &Path) -> PyResult<Vec<String>> {
    let found = Module::UsdUtils.item(py, "ComputeAllDependencies")?.call1((path.to_string_lossy().as_ref(),))?;
    let (layers, assets, _unresolved): (Vec<Bound<'_, PyAny>>, Vec<String>, Bound<'_, PyAny>) = found.extract()?;
    let layers = layers.iter().map(|layer| layer.getattr("realPath")?.extract::<String>());
    let names = layers.chain(assets.into_iter().map(Ok)).collect::<PyResult<Vec<_>>>()?;
    // Files inside packages read `package.usdz[inner.png]`.
    Ok(names.into_iter().map(|name| name.split('[').next().unwrap_or_default().to_owned()).collect())
}
