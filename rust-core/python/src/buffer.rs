//! Python buffers as Rust arrays, checked for type, byte order and shape, and copied at once.

use pyo3::{
    buffer::PyBuffer,
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
};

/// Values of a buffer in groups of `width`, as of shape (N, width) or flat with a whole number of groups.
#[derive(Clone, Debug)]
pub(crate) struct Grouped<T> {
    pub(crate) values: Vec<T>,
    pub(crate) width: usize,
}

impl<T> Grouped<T> {
    /// Number of groups.
    pub(crate) fn len(&self) -> usize {
        self.values.len() / self.width
    }
}

/// Floats, given as float32 or float64.
pub(crate) fn floats(object: &Bound<'_, PyAny>, name: &str, width: usize) -> PyResult<Grouped<f32>> {
    let py = object.py();
    if let Ok(buffer) = PyBuffer::<f32>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: buffer.to_vec(py)?, width });
    }
    if let Ok(buffer) = PyBuffer::<f64>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: buffer.to_vec(py)?.into_iter().map(|x| x as f32).collect(), width });
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of float32 or float64, found {}", object.get_type().name()?)))
}

/// Floats whose group width is that of the buffer: its last side, or 1 for a flat one; 1 to 4.
pub(crate) fn floats_of_any_width(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Grouped<f32>> {
    let shape = object.getattr("shape").and_then(|shape| shape.extract::<Vec<usize>>());
    let width = match shape.as_deref() {
        Ok([_, width]) => *width,
        _ => 1,
    };
    if (1..=4).contains(&width) {
        floats(object, name, width)
    } else {
        Err(PyValueError::new_err(format!("{name}: values have {width} numbers, expected 1 to 4")))
    }
}

/// Numbers of any shape in C order, given as float32 or float64.
pub(crate) fn doubles(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    let py = object.py();
    if let Ok(buffer) = PyBuffer::<f64>::get(object) {
        check_order(&buffer, name)?;
        return buffer.to_vec(py);
    }
    if let Ok(buffer) = PyBuffer::<f32>::get(object) {
        check_order(&buffer, name)?;
        return Ok(buffer.to_vec(py)?.into_iter().map(f64::from).collect());
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of float32 or float64, found {}", object.get_type().name()?)))
}

/// Affine maps, given as (N, 4, 4) or flat matrices for column vectors, row by row.
pub(crate) fn matrices(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[[f64; 4]; 4]>> {
    let values = doubles(object, name)?;
    if !values.len().is_multiple_of(16) {
        return Err(PyValueError::new_err(format!("{name}: {} numbers were found, expected 16 a matrix", values.len())));
    }
    let matrix = |m: &[f64]| std::array::from_fn(|row| std::array::from_fn(|column| m[row * 4 + column]));
    Ok(values.chunks_exact(16).map(matrix).collect())
}

/// Integers, given as int32, uint32 or int64; negative ones are refused.
pub(crate) fn indices(object: &Bound<'_, PyAny>, name: &str, width: usize) -> PyResult<Grouped<u32>> {
    let py = object.py();
    let negative = |at: usize, found: i64| PyValueError::new_err(format!("{name}: element {at} is {found}, expected 0 to 4294967295"));
    let convert = |values: Vec<i64>| -> PyResult<Vec<u32>> {
        values.into_iter().enumerate().map(|(at, value)| u32::try_from(value).map_err(|_| negative(at, value))).collect()
    };
    if let Ok(buffer) = PyBuffer::<u32>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: buffer.to_vec(py)?, width });
    }
    if let Ok(buffer) = PyBuffer::<i32>::get(object) {
        check(&buffer, name, width)?;
        let values = buffer.to_vec(py)?;
        if let Some(at) = values.iter().position(|value| *value < 0) {
            return Err(negative(at, i64::from(values[at])));
        }
        return Ok(Grouped { values: values.into_iter().map(i32::cast_unsigned).collect(), width });
    }
    if let Ok(buffer) = PyBuffer::<i64>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: convert(buffer.to_vec(py)?)?, width });
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of int32, uint32 or int64, found {}", object.get_type().name()?)))
}

/// Refuses foreign byte orders and other shapes than (N, width) or flat groups.
fn check<T: pyo3::buffer::Element>(buffer: &PyBuffer<T>, name: &str, width: usize) -> PyResult<()> {
    check_order(buffer, name)?;
    let shape = buffer.shape();
    let fits = match shape {
        [n] => n.is_multiple_of(width),
        [_, last] => *last == width,
        _ => false,
    };
    if fits {
        Ok(())
    } else {
        Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected (N, {width}) or a flat multiple of {width}")))
    }
}

/// Refuses foreign byte orders.
pub(crate) fn check_order<T: pyo3::buffer::Element>(buffer: &PyBuffer<T>, name: &str) -> PyResult<()> {
    let format = buffer.format().to_bytes();
    let foreign = if cfg!(target_endian = "little") { [b'>', b'!'] } else { [b'<', b'<'] };
    if format.first().is_some_and(|order| foreign.contains(order)) {
        return Err(PyTypeError::new_err(format!("{name}: the buffer's byte order is not this machine's")));
    }
    Ok(())
}

/// Width and height of a buffer of shape (height, width) or (height, width, 1).
pub(crate) fn side_lengths(object: &Bound<'_, PyAny>, name: &str) -> PyResult<[usize; 2]> {
    let shape: Vec<usize> = object.getattr("shape")?.extract()?;
    match shape[..] {
        [height, width] | [height, width, 1] => Ok([width, height]),
        _ => Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected (height, width) or (height, width, 1)"))),
    }
}
