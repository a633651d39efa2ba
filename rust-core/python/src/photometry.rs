//! Files of luminaires' makers.

use crate::{description::to_python, error::exception};
use gonio::scene::Goniogram;
use gonio_formats::photometry;
use pyo3::{prelude::*, types::PyDict};
use std::path::Path;

/// A file's luminaire with the lamp set of a number, from 1, and tilted by so many degrees.
fn read(data: &[u8], name: &str, lamp_set: Option<usize>, tilt: f64) -> PyResult<photometry::Goniogram> {
    let read = || {
        let found = photometry::read_with(data, name, &mut photometry::beside(Path::new(name)))?;
        let lamped = lamp_set.map_or(Ok(found.clone()), |number| found.with_lamp_set(number.wrapping_sub(1)))?;
        lamped.tilted(tilt)
    };
    read().map_err(|error| exception(gonio::Error::in_file(name, &error)))
}

/// The goniogram of an IES, EULUMDAT, TM-33, GLDF or GDTF file's bytes as a light's description has it, its factors in cd and the spectrum of its light if the file has one, and warnings; `name` says which
/// file it is, beside which a file of tilt factors lies, and behind `#` a GLDF file's variant or a GDTF file's mode: `lamp.gldf#wide`.
/// lamp_set: number of the file's alternative lamps, from 1; tilt: degrees by which the luminaire hangs aslant, for files with tilt factors.
#[pyfunction]
#[pyo3(signature = (data, name, *, lamp_set = None, tilt = 0.0))]
pub(crate) fn read_goniogram<'py>(
    py: Python<'py>,
    data: &[u8],
    name: &str,
    lamp_set: Option<usize>,
    tilt: f64,
) -> PyResult<(Bound<'py, PyAny>, Vec<String>)> {
    let found = read(data, name, lamp_set, tilt)?;
    let warnings = found.warnings.iter().map(|warning| format!("{name}: {warning}")).collect();
    Ok((to_python(py, &Goniogram::from(&found))?, warnings))
}

/// What an IES or EULUMDAT file's bytes say of a luminaire, in lm, cd, W and degrees, and its `cuts`: γ (negative across) and cd in the planes C0–C180 and C90–C270.
#[pyfunction]
#[pyo3(signature = (data, name, *, lamp_set = None, tilt = 0.0))]
pub(crate) fn goniogram_figures<'py>(
    py: Python<'py>,
    data: &[u8],
    name: &str,
    lamp_set: Option<usize>,
    tilt: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let found = read(data, name, lamp_set, tilt)?;
    let (figures, lamps) = (found.figures(), found.lamps());
    let described = PyDict::new(py);
    described.set_item("luminaire", found.text("LUMINAIRE").unwrap_or_default())?;
    described.set_item("lamps", lamps.map(|lamps| lamps.name.as_str()).unwrap_or_default())?;
    described.set_item("colour", lamps.map(|lamps| lamps.colour.as_str()).unwrap_or_default())?;
    described.set_item("lamp_flux_lm", lamps.and_then(|lamps| lamps.flux))?;
    described.set_item("flux_lm", figures.flux)?;
    described.set_item("downward_fraction", figures.downward_fraction)?;
    described.set_item("lamp_sets", found.lamp_sets.len())?;
    described.set_item("has_tilt", found.tilt.is_some())?;
    described.set_item("watts", figures.watts)?;
    described.set_item("efficacy_lm_per_w", figures.efficacy)?;
    described.set_item("peak_cd", figures.peak)?;
    described.set_item("beam_angle_deg", figures.beam.map(|spread| spread.angle()))?;
    described.set_item("field_angle_deg", figures.field.map(|spread| spread.angle()))?;
    let percents = |codes: [f64; 5]| codes.map(|code| (100.0 * code).round() as i64);
    described.set_item("cie_flux_codes", found.flux_codes().map(percents))?;
    described.set_item("bug", found.zones(found.street_side()).rating(found.is_square()).to_string())?;
    described.set_item("cuts", [found.cut(0.0), found.cut(90.0)])?;
    Ok(described)
}

/// The UGR table of an IES or EULUMDAT file's luminaire (CIE 190): `rooms` as (across, along) the line of sight in heights H above the eye, `reflectances` of
/// ceiling, walls and plane, and the ratings `crosswise` (along C0–C180) and `endwise`, a row for each room; None where nothing glares.
/// spacing: distance of the luminaires over H.
#[pyfunction]
#[pyo3(signature = (data, name, *, spacing = 0.25, lamp_set = None, tilt = 0.0))]
pub(crate) fn ugr_table<'py>(
    py: Python<'py>,
    data: &[u8],
    name: &str,
    spacing: f64,
    lamp_set: Option<usize>,
    tilt: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let found = read(data, name, lamp_set, tilt)?;
    let table = py.detach(|| found.ugr_table(spacing)).map_err(|error| exception(gonio::Error::in_file(name, &error)))?;
    let half = |from: usize| table.values.iter().map(|row| row[from..from + 5].to_vec()).collect::<Vec<_>>();
    let described = PyDict::new(py);
    described.set_item("spacing", table.spacing)?;
    described.set_item("rooms", photometry::ROOMS.map(|[across, along]| (across, along)))?;
    described.set_item("reflectances", photometry::REFLECTANCES.map(|[ceiling, walls, plane]| (ceiling, walls, plane)))?;
    described.set_item("crosswise", half(0))?;
    described.set_item("endwise", half(5))?;
    Ok(described)
}
