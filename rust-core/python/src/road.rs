//! Road lighting in closed formulas.

use crate::{
    description::to_python,
    watched::{unless, watched},
};
use pyo3::{prelude::*, types::PyDict};
use std::{path::PathBuf, sync::atomic::Ordering};

/// What a road's TOML file comes to, as `gonio road --json` has it: a dict of `l_av`, `uo`, `ul`, `ti`, `eir`, `observers`, `met`, `class`, `optimised`, …; docs/roads.md
/// lists the keys. cancelled: asked while the largest spacing is looked for.
#[pyfunction]
#[pyo3(signature = (path, *, cancelled = None))]
pub(crate) fn road<'py>(py: Python<'py>, path: PathBuf, cancelled: Option<Py<PyAny>>) -> PyResult<Bound<'py, PyDict>> {
    let ask = |py: Python<'_>, _: Option<&()>| unless(py, cancelled.as_ref());
    let found = watched(py, ask, |stop, _| gonio_cli::road_figures(&path, &|| stop.load(Ordering::Relaxed)))?;
    Ok(to_python(py, &found)?.cast_into::<PyDict>()?)
}
