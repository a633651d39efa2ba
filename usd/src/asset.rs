//! Files that asset-valued attributes name, wherever the asset system has them.

use crate::pxr::{self, Module};
use pyo3::{intern, prelude::*};

/// The bytes behind a resolved path: a file, or a part of a package. The message says what is wrong without naming the place.
pub fn bytes(py: Python<'_>, place: &str) -> Result<Vec<u8>, String> {
    let read = || -> PyResult<Option<Vec<u8>>> {
        let resolved = Module::Ar.item(py, "ResolvedPath")?.call1((place,))?;
        let asset = Module::Ar.item(py, "GetResolver")?.call0()?.call_method1(intern!(py, "OpenAsset"), (resolved,))?;
        if asset.is_none() {
            return Ok(None);
        }
        asset.call_method0(intern!(py, "GetBuffer"))?.extract().map(Some)
    };
    match read() {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err("cannot be opened".to_owned()),
        Err(error) => Err(format!("cannot be opened: {}", pxr::message_of(py, &error))),
    }
}
