//! One pass of a film as a buffer that numpy, memoryview and Blender read without a copy.

use pyo3::{exceptions::PyBufferError, ffi, prelude::*, types::PyBytes};
use std::ffi::{c_int, c_void};

/// A pass: native float32, three dimensions (rows, columns, channels), read only.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Pass {
    /// Names of the channels.
    #[pyo3(get)]
    channels: Vec<&'static str>,
    values: Vec<f32>,
    shape: [isize; 3],
    /// Bytes from one row, pixel and channel to the next.
    strides: [isize; 3],
}

impl Pass {
    /// A pass of `width · height · channels` values.
    pub(crate) fn new([width, height]: [usize; 2], channels: usize, names: &[&'static str], values: Vec<f32>) -> Self {
        let shape = [height, width, channels].map(|n| n as isize);
        Self { channels: names.to_vec(), values, shape, strides: [shape[1] * shape[2] * 4, shape[2] * 4, 4] }
    }
}

#[pymethods]
impl Pass {
    /// Height, width, channels.
    #[getter]
    fn shape(&self) -> (isize, isize, isize) {
        (self.shape[0], self.shape[1], self.shape[2])
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
        if view.is_null() || flags & ffi::PyBUF_WRITABLE == ffi::PyBUF_WRITABLE {
            return Err(PyBufferError::new_err("the pixels of a film cannot be written"));
        }
        let pass = slf.get();
        let asked = |flag: c_int| flags & flag == flag;
        let (shape, strides) = (pass.shape.as_ptr().cast_mut(), pass.strides.as_ptr().cast_mut());
        // SAFETY: Python hands a view of its own to fill, checked against null above. All pointers go into the pass, which is frozen and which the
        // view keeps alive by the reference in `obj`; readers take `readonly` at its word.
        unsafe {
            (*view).buf = pass.values.as_ptr().cast_mut().cast::<c_void>();
            (*view).len = (pass.values.len() * 4) as isize;
            (*view).readonly = 1;
            (*view).itemsize = 4;
            (*view).format = if asked(ffi::PyBUF_FORMAT) { c"f".as_ptr().cast_mut() } else { std::ptr::null_mut() };
            (*view).ndim = 3;
            (*view).shape = if asked(ffi::PyBUF_ND) { shape } else { std::ptr::null_mut() };
            (*view).strides = if asked(ffi::PyBUF_STRIDES) { strides } else { std::ptr::null_mut() };
            (*view).suboffsets = std::ptr::null_mut();
            (*view).internal = std::ptr::null_mut();
            (*view).obj = slf.into_any().into_ptr();
        }
        Ok(())
    }
}
