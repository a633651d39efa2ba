//! The buffer protocol's reading side, for objects whose values never move.

use pyo3::{exceptions::PyBufferError, ffi, prelude::*};
use std::ffi::{CStr, c_int, c_void};

/// Where an object's values are and how they are laid out; C order.
#[derive(Debug)]
pub(crate) struct View {
    shape: Vec<isize>,
    /// Bytes from one element of a dimension to the next.
    strides: Vec<isize>,
    itemsize: isize,
    format: &'static CStr,
}

impl View {
    /// Values of a type that is `format` to Python's `struct` and takes `itemsize` bytes.
    pub(crate) fn new(shape: &[usize], itemsize: usize, format: &'static CStr) -> Self {
        let shape: Vec<isize> = shape.iter().map(|n| *n as isize).collect();
        let mut strides = vec![itemsize as isize; shape.len()];
        for i in (1..shape.len()).rev() {
            strides[i - 1] = strides[i] * shape[i];
        }
        Self { shape, strides, itemsize: itemsize as isize, format }
    }

    /// The length of each dimension.
    pub(crate) fn shape(&self) -> &[isize] {
        &self.shape
    }

    /// Fills Python's view of `owner`.
    ///
    /// # Safety
    ///
    /// `view` is null or Python's to fill; `data` and `self` belong to `owner` and neither move nor change while it lives, and `data` holds as
    /// many elements as the shape says.
    pub(crate) unsafe fn fill(
        &self,
        owner: Bound<'_, PyAny>,
        data: *const c_void,
        view: *mut ffi::Py_buffer,
        flags: c_int,
    ) -> PyResult<()> {
        if view.is_null() || flags & ffi::PyBUF_WRITABLE == ffi::PyBUF_WRITABLE {
            return Err(PyBufferError::new_err("these values cannot be written"));
        }
        let asked = |flag: c_int| flags & flag == flag;
        let (shape, strides) = (self.shape.as_ptr().cast_mut(), self.strides.as_ptr().cast_mut());
        // SAFETY: the view was checked against null; all pointers go into the owner, which the view keeps alive by the reference in `obj`; readers
        // take `readonly` at its word.
        unsafe {
            (*view).buf = data.cast_mut();
            (*view).len = self.shape.iter().product::<isize>() * self.itemsize;
            (*view).readonly = 1;
            (*view).itemsize = self.itemsize;
            (*view).format = if asked(ffi::PyBUF_FORMAT) { self.format.as_ptr().cast_mut() } else { std::ptr::null_mut() };
            (*view).ndim = self.shape.len() as c_int;
            (*view).shape = if asked(ffi::PyBUF_ND) { shape } else { std::ptr::null_mut() };
            (*view).strides = if asked(ffi::PyBUF_STRIDES) { strides } else { std::ptr::null_mut() };
            (*view).suboffsets = std::ptr::null_mut();
            (*view).internal = std::ptr::null_mut();
            (*view).obj = owner.into_ptr();
        }
        Ok(())
    }
}
