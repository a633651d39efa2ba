//! Values of attributes as Rust data: Vt arrays through the buffer protocol, copied at once and checked for type and shape.

use gonio::scene::Transform;
use half::f16;
use pyo3::buffer::{PyBuffer, PyUntypedBuffer};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyInt, PyString};

/// A Rust type that attribute values convert to.
pub trait FromValue: Sized {
    /// What is expected, for messages: `float[]`.
    const EXPECTED: &'static str;
    /// The value, or `None` where it is of another kind.
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self>;
}

/// Floats of an array whose elements have one or more components.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloatArray {
    /// Floats an element.
    pub components: usize,
    /// The floats, element by element.
    pub values: Vec<f32>,
}

impl FloatArray {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.values.len() / self.components.max(1)
    }
    /// Whether there is no element.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// A file name as authored and as found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AssetPath {
    /// As written, relative to its layer.
    pub authored: String,
    /// Where the resolver found it; empty if it did not. Files inside packages read `package.usdz[inner.png]`.
    pub resolved: String,
}

/// Raw content of a contiguous buffer: the item's format, components an element and the numbers.
enum Numbers {
    Float(Vec<f32>),
    Integer(Vec<i64>),
    Int(Vec<i32>),
}

struct RawArray {
    components: usize,
    numbers: Numbers,
}

/// Reads any numeric buffer; elements are what is behind the first axis.
fn raw_array(value: &Bound<'_, PyAny>) -> Option<RawArray> {
    let py = value.py();
    let buffer = PyUntypedBuffer::get(value).ok()?;
    if !buffer.is_c_contiguous() || buffer.dimensions() == 0 {
        return None;
    }
    let components = buffer.shape()[1..].iter().product();
    let format = *buffer.format().to_bytes().last()?;
    let numbers = if buffer.item_count() == 0 {
        Numbers::Float(Vec::new())
    } else {
        match format {
            b'f' => Numbers::Float(copied::<f32>(py, buffer)?),
            b'd' => Numbers::Float(copied::<f64>(py, buffer)?.into_iter().map(|x| x as f32).collect()),
            b'e' => Numbers::Float(halves(value)?),
            b'i' => Numbers::Int(copied::<i32>(py, buffer)?),
            b'I' => Numbers::Integer(copied::<u32>(py, buffer)?.into_iter().map(i64::from).collect()),
            b'l' | b'q' => Numbers::Integer(copied::<i64>(py, buffer)?),
            b'B' => Numbers::Integer(copied::<u8>(py, buffer)?.into_iter().map(i64::from).collect()),
            _ => return None,
        }
    };
    Some(RawArray { components, numbers })
}

fn copied<T: pyo3::buffer::Element>(py: Python<'_>, buffer: PyUntypedBuffer) -> Option<Vec<T>> {
    buffer.into_typed::<T>().ok()?.to_vec(py).ok()
}

/// Half floats have no element type in the buffer API: they are read as bytes.
fn halves(value: &Bound<'_, PyAny>) -> Option<Vec<f32>> {
    let py = value.py();
    let bytes = py.import("builtins").ok()?.getattr("memoryview").ok()?.call1((value,)).ok()?.call_method0(intern!(py, "tobytes")).ok()?;
    let bytes = bytes.cast::<PyBytes>().ok()?.as_bytes();
    Some(bytes.chunks_exact(2).map(|pair| f16::from_ne_bytes([pair[0], pair[1]]).to_f32()).collect())
}

impl FromValue for FloatArray {
    const EXPECTED: &'static str = "an array of floats or vectors";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        let RawArray { components, numbers } = raw_array(value)?;
        match numbers {
            Numbers::Float(values) => Some(Self { components, values }),
            Numbers::Int(values) => Some(Self { components, values: values.into_iter().map(|x| x as f32).collect() }),
            Numbers::Integer(values) => Some(Self { components, values: values.into_iter().map(|x| x as f32).collect() }),
        }
    }
}

/// Any float array or single float, vector or quaternion (imaginary part first).
pub fn float_array_or_scalar(value: &Bound<'_, PyAny>) -> Option<FloatArray> {
    if value.cast::<PyBool>().is_ok() {
        return Some(FloatArray { components: 1, values: vec![f32::from(u8::from(value.is_truthy().ok()?))] });
    }
    if value.cast::<PyFloat>().is_ok() || value.cast::<PyInt>().is_ok() {
        return Some(FloatArray { components: 1, values: vec![value.extract::<f64>().ok()? as f32] });
    }
    let array = FloatArray::from_value(value)?;
    // A single vector is a buffer with one axis, an array of vectors one with two.
    let is_array = value.get_type().name().is_ok_and(|name| name.to_string().ends_with("Array"));
    if is_array { Some(array) } else { Some(FloatArray { components: array.values.len(), values: array.values }) }
}

impl<const N: usize> FromValue for Vec<[f32; N]> {
    const EXPECTED: &'static str = "an array of float vectors";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        let array = FloatArray::from_value(value)?;
        (array.components == N).then(|| array.values.as_chunks::<N>().0.to_vec())
    }
}

impl FromValue for Vec<f32> {
    const EXPECTED: &'static str = "float[]";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        let array = FloatArray::from_value(value)?;
        (array.components == 1).then_some(array.values)
    }
}

impl FromValue for Vec<i32> {
    const EXPECTED: &'static str = "int[]";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        match raw_array(value)? {
            RawArray { components: 1, numbers: Numbers::Int(values) } => Some(values),
            RawArray { components: 1, numbers: Numbers::Float(values) } if values.is_empty() => Some(Self::new()),
            _ => None,
        }
    }
}

impl<const N: usize> FromValue for Vec<[i32; N]> {
    const EXPECTED: &'static str = "an array of integer vectors";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        match raw_array(value)? {
            RawArray { components, numbers: Numbers::Int(values) } if components == N => Some(values.as_chunks::<N>().0.to_vec()),
            RawArray { numbers: Numbers::Float(values), .. } if values.is_empty() => Some(Self::new()),
            _ => None,
        }
    }
}

impl FromValue for Vec<i64> {
    const EXPECTED: &'static str = "int64[]";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        match raw_array(value)? {
            RawArray { components: 1, numbers: Numbers::Int(values) } => Some(values.into_iter().map(i64::from).collect()),
            RawArray { components: 1, numbers: Numbers::Integer(values) } => Some(values),
            RawArray { components: 1, numbers: Numbers::Float(values) } if values.is_empty() => Some(Self::new()),
            _ => None,
        }
    }
}

impl FromValue for Vec<[[f64; 4]; 4]> {
    const EXPECTED: &'static str = "matrix4d[]";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        let buffer = PyBuffer::<f64>::get(value).ok()?;
        match buffer.shape() {
            [_, 4, 4] if buffer.item_count() > 0 => {
                let flat = buffer.to_vec(value.py()).ok()?;
                Some(flat.as_chunks::<4>().0.as_chunks::<4>().0.to_vec())
            }
            [0, ..] => Some(Self::new()),
            _ => None,
        }
    }
}

impl FromValue for Transform {
    const EXPECTED: &'static str = "matrix4d";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        let buffer = PyBuffer::<f64>::get(value).ok()?;
        if buffer.shape() != [4, 4] {
            return None;
        }
        let flat = buffer.to_vec(value.py()).ok()?;
        let rows: &[[f64; 4]; 4] = flat.as_chunks::<4>().0.as_array()?;
        Some(Self::from_row_vector_matrix(rows))
    }
}

impl FromValue for Vec<String> {
    const EXPECTED: &'static str = "token[] or string[]";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        if value.cast::<PyString>().is_ok() {
            return None;
        }
        value.try_iter().ok()?.map(|item| item.ok()?.extract::<String>().ok()).collect()
    }
}

impl FromValue for String {
    const EXPECTED: &'static str = "token or string";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        value.extract().ok()
    }
}

impl FromValue for bool {
    const EXPECTED: &'static str = "bool";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        match value.cast::<PyBool>() {
            Ok(flag) => Some(flag.is_true()),
            // Older files author flags as integers.
            Err(_) => value.cast::<PyInt>().ok()?.extract::<i64>().ok().map(|x| x != 0),
        }
    }
}

impl FromValue for i32 {
    const EXPECTED: &'static str = "int";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        value.cast::<PyInt>().ok()?.extract().ok()
    }
}

impl FromValue for f64 {
    const EXPECTED: &'static str = "double or float";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        (value.cast::<PyFloat>().is_ok() || value.cast::<PyInt>().is_ok()).then(|| value.extract().ok()).flatten()
    }
}

impl FromValue for f32 {
    const EXPECTED: &'static str = "float";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        f64::from_value(value).map(|x| x as Self)
    }
}

/// The components of a single vector; quaternions are not among them.
fn vector<const N: usize>(value: &Bound<'_, PyAny>) -> Option<[f64; N]> {
    if let Ok(buffer) = PyBuffer::<f64>::get(value) {
        return (buffer.shape() == [N]).then(|| buffer.to_vec(value.py()).ok()?.try_into().ok()).flatten();
    }
    if value.len().ok()? != N || value.cast::<PyString>().is_ok() {
        return None;
    }
    let numbers: Option<Vec<f64>> = value.try_iter().ok()?.map(|item| item.ok()?.extract().ok()).collect();
    numbers?.try_into().ok()
}

impl<const N: usize> FromValue for [f64; N] {
    const EXPECTED: &'static str = "a vector of floats";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        vector(value)
    }
}

impl<const N: usize> FromValue for [f32; N] {
    const EXPECTED: &'static str = "a vector or colour of floats";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        vector::<N>(value).map(|numbers| numbers.map(|x| x as f32))
    }
}

impl FromValue for AssetPath {
    const EXPECTED: &'static str = "asset";
    fn from_value(value: &Bound<'_, PyAny>) -> Option<Self> {
        let py = value.py();
        if let Ok(text) = value.extract::<String>() {
            return Some(Self { resolved: String::new(), authored: text });
        }
        let text = |name: &Bound<'_, PyString>| value.getattr(name).ok()?.extract::<String>().ok();
        Some(Self { authored: text(intern!(py, "path"))?, resolved: text(intern!(py, "resolvedPath")).unwrap_or_default() })
    }
}
