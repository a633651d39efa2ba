//! Developed films as buffers.

use crate::error::exception;
use gonio::{
    film::{Image, channel_names},
    output::{ExrOptions, ToneMap, write_exr, write_picture},
    scene::Aov,
};
use gonio_simd::Execution;
use pyo3::{exceptions::PyKeyError, prelude::*, types::PyBytes};
use std::path::PathBuf;

/// A developed image: passes as float32 arrays, rows from the top.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Film {
    image: Image,
    exposure: f32,
}

/// One pass of a film.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Pass {
    /// Height, width, channels.
    #[pyo3(get)]
    shape: (usize, usize, usize),
    /// Names of the channels.
    #[pyo3(get)]
    channels: Vec<&'static str>,
    values: Vec<f32>,
}

/// A pass's name in Python.
pub(crate) fn aov_name(aov: Aov) -> &'static str {
    match aov {
        Aov::Color => "color",
        Aov::Alpha => "alpha",
        Aov::Depth => "depth",
        Aov::Normal => "normal",
        Aov::P => "P",
        Aov::Albedo => "albedo",
        Aov::PrimId => "primId",
        Aov::Luminance => "luminance",
        Aov::Illuminance => "illuminance",
    }
}

impl Film {
    pub(crate) fn new(image: Image, exposure: f32) -> Self {
        Self { image, exposure }
    }
}

#[pymethods]
impl Film {
    /// Width and height in pixels of what the film holds.
    #[getter]
    fn size(&self) -> (usize, usize) {
        let [width, height] = self.image.size();
        (width, height)
    }
    /// Samples a pixel.
    #[getter]
    fn samples(&self) -> u32 {
        self.image.samples
    }
    /// Names of the passes.
    #[getter]
    fn passes(&self) -> Vec<&'static str> {
        self.image.layers.iter().map(|layer| aov_name(layer.aov)).collect()
    }
    /// A pass by name.
    fn __getitem__(&self, name: &str) -> PyResult<Pass> {
        let layer = self.image.layers.iter().find(|layer| aov_name(layer.aov) == name);
        let layer =
            layer.ok_or_else(|| PyKeyError::new_err(format!("the film has no pass '{name}'; it has {}", self.passes().join(", "))))?;
        let [width, height] = self.image.size();
        Ok(Pass { shape: (height, width, layer.channels), channels: channel_names(layer.aov).to_vec(), values: layer.values.clone() })
    }
    /// Writes all passes; absolute ones as 32-bit floats whatever `half` says.
    #[pyo3(signature = (path, half = false))]
    fn write_exr(&self, py: Python<'_>, path: PathBuf, half: bool) -> PyResult<()> {
        let options = ExrOptions { half, exposure: self.exposure, attributes: Vec::new() };
        py.detach(|| write_exr(&path, &self.image, &options)).map_err(exception)
    }
    /// Writes the tone-mapped colour pass as PNG or JPEG; `tonemap` is "photographic" or "none".
    #[pyo3(signature = (path, tonemap = "photographic", exposure = 0.0))]
    fn write_picture(&self, py: Python<'_>, path: PathBuf, tonemap: &str, exposure: f32) -> PyResult<()> {
        let operator = match tonemap {
            "photographic" => ToneMap::Photographic,
            "none" => ToneMap::None,
            other => {
                let problem = format!("'{other}' was found, expected photographic or none");
                return Err(exception(gonio::Error::Setting { name: "tonemap".into(), problem }));
            }
        };
        py.detach(|| write_picture(&path, &self.image, operator, exposure, Execution::detect())).map_err(exception)
    }
}

#[pymethods]
impl Pass {
    /// The values as bytes of native float32, for `numpy.frombuffer` or `memoryview.cast`.
    fn tobytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes: Vec<u8> = self.values.iter().flat_map(|value| value.to_ne_bytes()).collect();
        PyBytes::new(py, &bytes)
    }
    /// numpy's own conversion.
    #[pyo3(signature = (dtype = None, copy = None))]
    fn __array__<'py>(&self, py: Python<'py>, dtype: Option<Bound<'py, PyAny>>, copy: Option<bool>) -> PyResult<Bound<'py, PyAny>> {
        let _ = copy;
        let numpy = py.import("numpy")?;
        let flat = numpy.call_method1("frombuffer", (self.tobytes(py), "float32"))?;
        let shaped = flat.call_method1("reshape", (self.shape,))?.call_method0("copy")?;
        match dtype {
            Some(dtype) => shaped.call_method1("astype", (dtype,)),
            None => Ok(shaped),
        }
    }
}
