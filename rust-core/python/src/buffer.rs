//! Python buffers as Rust arrays, checked for type and shape and copied at once.

use pyo3::{
    buffer::PyBuffer,
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
};

/// Floats of a buffer of any shape, given as float32 or float64.
pub(crate) fn floats(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f32>> {
    let py = object.py();
    if let Ok(buffer) = PyBuffer::<f32>::get(object) {
        return buffer.to_vec(py);
    }
    if let Ok(buffer) = PyBuffer::<f64>::get(object) {
        return Ok(buffer.to_vec(py)?.into_iter().map(|x| x as f32).collect());
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of float32 or float64, found {}", object.get_type().name()?)))
}

/// Integers of a buffer of any shape, given as int32, uint32 or int64; negative ones are refused.
pub(crate) fn indices(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<u32>> {
    let py = object.py();
    let negative = |at: usize, found: i64| PyValueError::new_err(format!("{name}: element {at} is {found}, expected 0 to 4294967295"));
    let convert = |values: Vec<i64>| -> PyResult<Vec<u32>> {
        values.into_iter().enumerate().map(|(at, value)| u32::try_from(value).map_err(|_| negative(at, value))).collect()
    };
    if let Ok(buffer) = PyBuffer::<u32>::get(object) {
        return buffer.to_vec(py);
    }
    if let Ok(buffer) = PyBuffer::<i32>::get(object) {
        return convert(buffer.to_vec(py)?.into_iter().map(i64::from).collect());
    }
    if let Ok(buffer) = PyBuffer::<i64>::get(object) {
        return convert(buffer.to_vec(py)?);
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of int32, uint32 or int64, found {}", object.get_type().name()?)))
}

/// Groups of `N`; the length must be a multiple.
pub(crate) fn grouped<T: Copy + Default, const N: usize>(values: &[T], name: &str) -> PyResult<Vec<[T; N]>> {
    if !values.len().is_multiple_of(N) {
        return Err(PyValueError::new_err(format!("{name}: {} values were found, expected a multiple of {N}", values.len())));
    }
    Ok(values
        .chunks_exact(N)
        .map(|chunk| {
            let mut group = [T::default(); N];
            group.copy_from_slice(chunk);
            group
        })
        .collect())
}
