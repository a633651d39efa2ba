//! Results of evaluations as buffers that numpy and memoryview read without a copy.

use crate::view::View;
use pyo3::{ffi, prelude::*};
use std::ffi::{c_int, c_void};

/// Numbers: native float64, or int32 where they count; one dimension or two, read only.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Array {
    values: Values,
    view: View,
}

enum Values {
    Floats(Vec<f64>),
    Integers(Vec<i32>),
}

impl Array {
    /// Rows of `width` numbers.
    pub(crate) fn rows(values: Vec<f64>, width: usize) -> Self {
        let view = View::new(&[values.len() / width.max(1), width], 8, c"d");
        Self { values: Values::Floats(values), view }
    }

    /// One number after the other.
    pub(crate) fn flat(values: Vec<f64>) -> Self {
        let view = View::new(&[values.len()], 8, c"d");
        Self { values: Values::Floats(values), view }
    }

    /// One whole number after the other.
    pub(crate) fn integers(values: Vec<i32>) -> Self {
        let view = View::new(&[values.len()], 4, c"i");
        Self { values: Values::Integers(values), view }
    }

    fn address(&self) -> *const c_void {
        match &self.values {
            Values::Floats(values) => values.as_ptr().cast(),
            Values::Integers(values) => values.as_ptr().cast(),
        }
    }
}

#[pymethods]
impl Array {
    /// Rows, and columns if there are.
    #[getter]
    fn shape(&self) -> Vec<isize> {
        self.view.shape().to_vec()
    }
    /// The buffer protocol.
    ///
    /// # Safety
    ///
    /// Python calls it with a view to fill.
    unsafe fn __getbuffer__(slf: Bound<'_, Self>, view: *mut ffi::Py_buffer, flags: c_int) -> PyResult<()> {
        let array = slf.get();
        // SAFETY: the array is frozen, so that its values stay where they are; the view is Python's.
        unsafe { array.view.fill(slf.as_any().clone(), array.address(), view, flags) }
    }
}
