//! Value clips that a text layer names, looked at before the stage is opened: the USD library waits for pipes, and leaves out without a word what it
//! cannot open.

use super::problem::format_error;
use gonio::scene::Origin;
use gonio::{Diagnostic, Result};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::Path;
use std::sync::Arc;

/// Looks at all clips of a layer; pipes and devices are refused, what is no file is told.
pub(super) fn check(path: &Path, layer: &Bound<'_, PyAny>, diagnostics: &mut Vec<Diagnostic>) -> PyResult<Result<()>> {
    // Prims are looked at one by one only where there is something to find.
    if !std::fs::read(path).is_ok_and(|text| text.starts_with(b"#usda") && text.windows(5).any(|word| word == b"clips")) {
        return Ok(Ok(()));
    }
    let mut prims: Vec<Bound<'_, PyAny>> = layer.getattr("rootPrims")?.try_iter()?.collect::<PyResult<_>>()?;
    while let Some(prim) = prims.pop() {
        for asset in assets(&prim)? {
            let place: String = layer.call_method1("ComputeAbsolutePath", (&asset,))?.extract()?;
            match std::fs::metadata(&place) {
                Ok(found) if found.is_file() => {}
                Ok(found) if !found.is_dir() => return Ok(Err(format_error(path, format!("its value clip {asset} is a pipe or device")))),
                Ok(_) => diagnostics.push(left_out(&prim, path, &asset, "a folder has this name")?),
                // What other asset systems know is no file.
                Err(_) if asset.contains("://") => {}
                Err(error) => diagnostics.push(left_out(&prim, path, &asset, &error.to_string())?),
            }
        }
        prims.extend(prim.getattr("nameChildren")?.call_method0("values")?.try_iter()?.collect::<PyResult<Vec<_>>>()?);
    }
    Ok(Ok(()))
}

/// The files of all sets of clips of a prim.
fn assets(prim: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let mut found = Vec::new();
    if !prim.call_method1("HasInfo", ("clips",))?.is_truthy()? {
        return Ok(found);
    }
    let sets = prim.call_method1("GetInfo", ("clips",))?;
    for set in sets.cast::<PyDict>()?.values() {
        let Ok(set) = set.cast::<PyDict>() else { continue };
        let mut add = |asset: Bound<'_, PyAny>| asset.getattr("path")?.extract().map(|path: String| found.push(path));
        if let Some(list) = set.get_item("assetPaths")? {
            list.try_iter()?.try_for_each(|asset| add(asset?))?;
        }
        set.get_item("manifestAssetPath")?.map_or(Ok(()), add)?;
    }
    found.retain(|path| !path.is_empty());
    Ok(found)
}

fn left_out(prim: &Bound<'_, PyAny>, path: &Path, asset: &str, why: &str) -> PyResult<Diagnostic> {
    let name: String = prim.getattr("path")?.str()?.extract()?;
    let origin = Origin { name: Arc::from(name), file: Arc::from(path.to_string_lossy().as_ref()) };
    Ok(Diagnostic::warning(&origin, format!("value clip {asset} cannot be opened ({why}): its values are left out")))
}
