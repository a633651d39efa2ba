//! Fields of media in Python: arrays, or grids of OpenVDB's and NanoVDB's files.

use crate::{buffer::floats, error::setting};
use gonio::scene::{COLOURS, Field, Flow, Lattice, Transform};
use pyo3::{exceptions::PyValueError, prelude::*};
use std::path::PathBuf;

/// Where a field's numbers come from.
#[derive(FromPyObject)]
pub(crate) enum Source<'py> {
    /// A file and the name of its grid.
    File(PathBuf, String),
    /// An array (nx, ny, nz).
    Array(Bound<'py, PyAny>),
}

/// Where a flow comes from.
#[derive(FromPyObject)]
pub(crate) enum FlowSource<'py> {
    /// A file, the names of its grids, and how long the shutter is open in their unit of time.
    File(PathBuf, Vec<String>, f64),
    /// An array (nx, ny, nz, 3), and what makes voxels of it along each axis.
    Array(Bound<'py, PyAny>, [f32; 3]),
}

/// How what a field holds moves; `to_world` is the map that it was put with.
pub(crate) fn flow(py: Python<'_>, field: &Field, to_world: &Transform, source: &FlowSource<'_>, rests: f32) -> PyResult<Option<Flow>> {
    match source {
        FlowSource::File(path, names, time) => {
            let Some(to_file) = to_world.inverse().map(|back| back.after(&field.to_world)) else { return Ok(None) };
            let found = py.detach(|| Flow::read(path, names, (&field.density, &to_file), *time, rests));
            found.map(Some).map_err(|problem| setting(&field.origin.to_string(), problem))
        }
        FlowSource::Array(array, voxels) => {
            let mut ways = coloured(py, field, Some(array), "flow", 3)?;
            for (way, factor) in ways.iter_mut().zip(voxels) {
                way.values = way.values.iter().map(|x| x * factor).collect();
                way.block_values = way.block_values.iter().map(|x| x * factor).collect();
            }
            Ok(ways.try_into().ok().map(|cells| Flow::new(cells, rests)))
        }
    }
}

/// A described field with its numbers; `colours` are arrays with a last axis of so many components, extinction and scattering, and emission.
pub(crate) fn filled(
    py: Python<'_>,
    described: Field,
    (density, heat): (&Source<'_>, Option<&Source<'_>>),
    colours: [Option<Bound<'_, PyAny>>; 2],
) -> PyResult<Field> {
    let told = |problem: String| setting(&described.origin.to_string(), problem);
    let Field { origin, to_world, glow, hottest, .. } = described.clone();
    let is_file = matches!(density, Source::File(..));
    if is_file && described.beyond != [[0.0; 3]; 2] {
        return Err(told("beyond is of arrays; a file's grid ends where its voxels do".into()));
    }
    let mut field = match (density, heat) {
        (Source::File(path, name), None) => py.detach(|| Field::read(origin, path, name, None, &to_world)).map_err(told)?,
        (Source::File(path, name), Some(Source::File(other, heat))) if path == other => {
            py.detach(|| Field::read(origin, path, name, Some(heat), &to_world)).map_err(told)?
        }
        (Source::Array(density), heat) => {
            let density = lattice(py, density, "density")?;
            let heat = match heat {
                Some(Source::Array(heat)) => Some(lattice(py, heat, "heat")?),
                Some(Source::File(..)) => return Err(told("density is an array, heat is to be one, too".into())),
                None => None,
            };
            if let Some(heat) = heat.as_ref().filter(|heat| heat.domain != density.domain) {
                return Err(told(format!("heat fills {:?}, density {:?}: expected arrays of one shape", heat.domain, density.domain)));
            }
            Field { density, heat, ..described }
        }
        _ => return Err(told("density is a grid of a file, heat is to be one of the same file".into())),
    };
    let [taken, sent] = colours;
    field.taken = coloured(py, &field, taken.as_ref(), "taken", COLOURS[0])?;
    field.sent = coloured(py, &field, sent.as_ref(), "sent", COLOURS[1])?;
    field.glow = glow;
    field.hottest = if hottest > 0.0 { hottest } else { field.heat.as_ref().map_or(0.0, Lattice::most) };
    Ok(field)
}

/// A lattice for each component of an array (nx, ny, nz, components) that goes with a field's own.
fn coloured(py: Python<'_>, field: &Field, array: Option<&Bound<'_, PyAny>>, name: &str, components: usize) -> PyResult<Vec<Lattice>> {
    let Some(array) = array else { return Ok(Vec::new()) };
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let [x, y, z, found] = shape[..] else {
        return Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected (nx, ny, nz, {components})")));
    };
    if found != components || shape.contains(&0) {
        return Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected (nx, ny, nz, {components})")));
    }
    let values = floats(&array.call_method1("reshape", (-1,))?, name, 1)?.values;
    let one = |part: usize| Lattice::of_values(&values.iter().skip(part).step_by(components).copied().collect::<Vec<_>>(), [x, y, z]);
    let made: Result<Vec<Lattice>, String> = py.detach(|| (0..components).map(one).collect());
    let made = made.map_err(PyValueError::new_err)?;
    match made.iter().find(|lattice| lattice.domain != field.density.domain) {
        None => Ok(made),
        Some(other) => {
            let problem = format!("{name} fills {:?}, density {:?}: expected arrays of one shape", other.domain, field.density.domain);
            Err(PyValueError::new_err(problem))
        }
    }
}

fn lattice(py: Python<'_>, array: &Bound<'_, PyAny>, name: &str) -> PyResult<Lattice> {
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let [x, y, z] = shape[..] else {
        return Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected (nx, ny, nz)")));
    };
    if shape.contains(&0) {
        return Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected numbers above 0")));
    }
    let values = floats(&array.call_method1("reshape", (-1,))?, name, 1)?.values;
    let made = py.detach(|| Lattice::of_values(&values, [x, y, z]));
    made.map_err(PyValueError::new_err)
}
