//! Shading nodes for Python: single operations on arrays, and their table.

use crate::{array::Array, buffer::floats, description};
use gonio::scene::Operation;
use gonio_simd::Execution;
use pyo3::{exceptions::PyValueError, prelude::*};

/// What an operation gives for inputs (N, 4) of one length, as an array of that shape; None where it asks for more than its inputs: the
/// surface point, the ray, images.
#[pyfunction]
pub(crate) fn compute(py: Python<'_>, operation: &Bound<'_, PyAny>, inputs: Vec<Bound<'_, PyAny>>) -> PyResult<Option<Array>> {
    let operation: Operation = description::read(operation, "operation")?;
    let inputs = inputs.iter().map(|input| Ok(floats(input, "inputs", 4)?.values.to_vec())).collect::<PyResult<Vec<Vec<f32>>>>()?;
    let rows: Vec<&[[f32; 4]]> = inputs.iter().map(|values| values.as_chunks().0).collect();
    if rows.iter().any(|each| each.len() != rows[0].len()) {
        return Err(PyValueError::new_err("inputs: expected arrays of one length"));
    }
    let found = py.detach(|| gonio_nodes::compute(Execution::detect(), &operation, &rows));
    Ok(found.map(|rows| Array::rows(rows.as_flattened().iter().map(|x| f64::from(*x)).collect(), 4)))
}
