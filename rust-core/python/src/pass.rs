//! One pass of a film as a buffer that numpy, memoryview and Blender read without a copy.

use crate::view::View;
use pyo3::{ffi, prelude::*, types::PyBytes};
use std::ffi::c_int;

/// A pass: native float32, three dimensions (rows, columns, channels), read only.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Pass {
    /// Names of the channels.
    #[pyo3(get)]
    channels: Vec<&'static str>,
    values: Vec<f32>,
    view: View,
}

impl Pass {
    /// A pass of `width · height · channels` values.
    pub(crate) fn new([width, height]: [usize; 2], channels: usize, names: &[&'static str], values: Vec<f32>) -> Self {
        Self { channels: names.to_vec(), values, view: View::new(&[height, width, channels], 4, c"f") }
    }
}

#[pymethods]
impl Pass {
    /// Height, width, channels.
    #[getter]
    fn shape(&self) -> (isize, isize, isize) {
        let shape = self.view.shape();
        (shape[0], shape[1], shape[2])
    }
    /// The values as bytes of native float32.
    fn tobytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes: Vec<u8> = self.values.iter().flat_map(|value| value.to_ne_bytes()).collect();
        PyBytes::new(py, &bytes)
    }
    /// The buffer protocol.
    ///
    /// # Safety
    ///
    /// Python calls it with a view to fill.
    unsafe fn __getbuffer__(slf: Bound<'_, Self>, view: *mut ffi::Py_buffer, flags: c_int) -> PyResult<()> {
        let pass = slf.get();
        // SAFETY: the pass is frozen, so that its values stay where they are; the view is Python's.
        unsafe { pass.view.fill(slf.as_any().clone(), pass.values.as_ptr().cast(), view, flags) }
    }
}
