//! Python buffers as Rust arrays, checked for type, byte order and shape, and copied at once.

use pyo3::{
    buffer::{Element, PyBuffer},
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
};
use std::{iter::repeat_n, sync::Arc};

/// Values of a buffer in groups of `width`, as of shape (N, width) or flat with a whole number of groups.
#[derive(Clone, Debug)]
pub(crate) struct Grouped<T> {
    pub(crate) values: Arc<[T]>,
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
        return Ok(Grouped { values: copied(&buffer, py, 1, |values| values)?, width });
    }
    if let Ok(buffer) = PyBuffer::<f64>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: buffer.to_vec(py)?.into_iter().map(|x| x as f32).collect(), width });
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of float32 or float64, found {}", object.get_type().name()?)))
}

/// Floats in groups of three, as scenes hold points.
pub(crate) fn points(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Arc<[[f32; 3]]>> {
    if let Ok(buffer) = PyBuffer::<f32>::get(object) {
        check(&buffer, name, 3)?;
        return copied(&buffer, object.py(), 3, <[[f32; 3]]>::as_flattened_mut);
    }
    Ok(floats(object, name, 3)?.values.as_chunks().0.into())
}

/// Integers in groups of three, as [`indices`].
pub(crate) fn triangles(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Arc<[[u32; 3]]>> {
    if let Ok(buffer) = PyBuffer::<i32>::get(object) {
        check(&buffer, name, 3)?;
        let values = copied(&buffer, object.py(), 3, |values: &mut [[u32; 3]]| bytemuck::cast_slice_mut(values))?;
        return not_negative(values.as_flattened(), name).map(|()| values);
    }
    Ok(indices(object, name, 3)?.values.as_chunks().0.into())
}

/// Refuses integers that were negative as int32.
fn not_negative(values: &[u32], name: &str) -> PyResult<()> {
    let is_negative = |value: &u32| value.cast_signed() < 0;
    // Branches for each value would take longer than copying them.
    if values.iter().fold(0, |all, value| all | value).cast_signed() >= 0 {
        return Ok(());
    }
    values.iter().position(is_negative).map_or(Ok(()), |at| Err(negative(name, at, i64::from(values[at].cast_signed()))))
}

fn negative(name: &str, at: usize, found: i64) -> PyErr {
    PyValueError::new_err(format!("{name}: element {at} is {found}, expected 0 to 4294967295"))
}

/// A buffer's elements as values that have some each, copied once: `elements` gives where they lie.
fn copied<E: Element, T: Clone + Default>(
    buffer: &PyBuffer<E>,
    py: Python<'_>,
    each: usize,
    elements: impl Fn(&mut [T]) -> &mut [E],
) -> PyResult<Arc<[T]>> {
    let mut values: Arc<[T]> = repeat_n(T::default(), buffer.item_count() / each).collect();
    if let Some(place) = Arc::get_mut(&mut values) {
        buffer.copy_to_slice(py, elements(place))?;
    }
    Ok(values)
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
    let convert = |values: Vec<i64>| -> PyResult<Arc<[u32]>> {
        values.into_iter().enumerate().map(|(at, value)| u32::try_from(value).map_err(|_| negative(name, at, value))).collect()
    };
    if let Ok(buffer) = PyBuffer::<u32>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: copied(&buffer, py, 1, |values| values)?, width });
    }
    if let Ok(buffer) = PyBuffer::<i32>::get(object) {
        check(&buffer, name, width)?;
        let values = copied(&buffer, py, 1, |values: &mut [u32]| bytemuck::cast_slice_mut(values))?;
        return not_negative(&values, name).map(|()| Grouped { values, width });
    }
    if let Ok(buffer) = PyBuffer::<i64>::get(object) {
        check(&buffer, name, width)?;
        return Ok(Grouped { values: convert(buffer.to_vec(py)?)?, width });
    }
    Err(PyTypeError::new_err(format!("{name}: expected a buffer of int32, uint32 or int64, found {}", object.get_type().name()?)))
}

/// Refuses foreign byte orders and other shapes than (N, width) or flat groups.
fn check<T: Element>(buffer: &PyBuffer<T>, name: &str, width: usize) -> PyResult<()> {
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
pub(crate) fn check_order<T: Element>(buffer: &PyBuffer<T>, name: &str) -> PyResult<()> {
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
