//! Files of luminaires' makers.

use crate::{description::to_python, error::exception};
use gonio::scene::Goniogram;
use gonio_formats::photometry;
use pyo3::prelude::*;

/// The goniogram of an IES or EULUMDAT file's bytes as a light's description has it, its factors in cd, and warnings; `name` says which file it is.
#[pyfunction]
pub(crate) fn read_goniogram<'py>(py: Python<'py>, data: &[u8], name: &str) -> PyResult<(Bound<'py, PyAny>, Vec<String>)> {
    let found = photometry::read(data, name).map_err(|error| exception(gonio::Error::in_file(name, &error)))?;
    let warnings = found.warnings.iter().map(|warning| format!("{name}: {warning}")).collect();
    Ok((to_python(py, &Goniogram::from(&found))?, warnings))
}
