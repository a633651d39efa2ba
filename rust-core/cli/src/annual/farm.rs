//! `gonio annual --dask`: the cluster traces (`gonio.farm`), the year is calculated here.

use super::inputs::positions;
use crate::{
    arguments::AnnualOptions,
    farm::{connect, failure, reporting},
};
use gonio::{
    Result,
    annual::{Facade, FacadeBlinds},
    scene::{Scene, to_bundle},
    sky::UpAxis,
};
use pyo3::{
    prelude::*,
    types::{PyBytes, PyCFunction, PyDict, PyList},
};
use std::path::PathBuf;

/// Has a cluster trace the year of scenes, that with open blinds first, and gives the checkpoints of its parts to `use_them`, behind which they are gone.
pub(super) fn traced<T>(
    py: Python<'_>,
    options: &AnnualOptions,
    (scenes, facades): (&[Scene], &[Facade]),
    (weather, up): (&[u8], UpAxis),
    use_them: impl FnOnce(Vec<PathBuf>) -> Result<T>,
) -> Result<T> {
    let bundles = scenes.iter().map(to_bundle).collect::<Result<Vec<_>>>()?;
    let gathered = || -> PyResult<Bound<'_, PyAny>> {
        let cluster = connect(py, options.farm.dask.as_deref())?;
        let source = py.import("gonio.farm.source")?;
        let bundles = bundles.iter().map(|bundle| source.call_method1("Bundle", (PyBytes::new(py, bundle),)));
        let bundles = PyList::new(py, bundles.collect::<PyResult<Vec<_>>>()?)?;
        let year = source.call_method1("Year", (bundles, PyBytes::new(py, weather), tracing(py, options, facades, up)?))?;
        let report = PyCFunction::new_closure(py, None, None, reporting(options.quiet))?;
        cluster.call_method1("annual", (year, options.farm.dask_parts, report))
    };
    let gathered = gathered().map_err(|error| failure(py, &error))?;
    let files = gathered.call_method0("__next__").and_then(|files| files.extract()).map_err(|error| failure(py, &error))?;
    let used = use_them(files);
    gathered.call_method0("close").map_err(|error| failure(py, &error))?;
    used
}

/// What tracing has to know, as keywords of `gonio.annual`; scenes with closed blinds are numbers behind the one with open ones.
fn tracing<'py>(py: Python<'py>, options: &AnnualOptions, facades: &[Facade], up: UpAxis) -> PyResult<Bound<'py, PyDict>> {
    let keywords = PyDict::new(py);
    keywords.set_item("samples", options.spp)?;
    keywords.set_item("division", options.factor)?;
    keywords.set_item("up", if up == UpAxis::Y { "Y" } else { "Z" })?;
    keywords.set_item("north", options.year.north)?;
    keywords.set_item("sun_position", positions(&options.year).name())?;
    let scene = |facade: &Facade| match facade.blinds {
        Some(FacadeBlinds::Scene(number)) => Some(number + 1),
        _ => None,
    };
    if options.facades.group.is_empty() {
        if let Some(number) = facades.iter().find_map(scene) {
            keywords.set_item("closed", number)?;
        }
        return Ok(keywords);
    }
    let (groups, closed) = (PyDict::new(py), PyDict::new(py));
    for facade in facades {
        groups.set_item(&facade.name, &facade.prims)?;
        if let Some(number) = scene(facade) {
            closed.set_item(&facade.name, number)?;
        }
    }
    keywords.set_item("groups", groups)?;
    keywords.set_item("closed", closed)?;
    Ok(keywords)
}
