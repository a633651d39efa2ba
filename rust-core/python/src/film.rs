//! Developed films as buffers.

use crate::{
    error::exception,
    pass::Pass,
    picture::{Picture, flat},
};
use gonio::{
    film::{Image, Layer, channel_names, edge_aware},
    output::{
        DisplaySpace, ExrOptions, Look, ToneMap, display, display_linear, display_over_black, log_average, matte_notes, write_deep_exr,
        write_exr, write_picture,
    },
    scene::Aov,
};
use gonio_simd::Execution;
use pyo3::{
    exceptions::{PyKeyError, PyValueError},
    prelude::*,
    types::PyBytes,
};
use std::{collections::HashMap, path::PathBuf};

/// A developed image: passes as float32 arrays, rows from the top.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Film {
    image: Image,
    exposure: f32,
}

impl Film {
    pub(crate) fn new(image: Image, exposure: f32) -> Self {
        Self { image, exposure }
    }
    fn layer(&self, name: &str) -> PyResult<&Layer> {
        let layer = self.image.layers.iter().find(|layer| layer.name == name);
        layer.ok_or_else(|| PyKeyError::new_err(format!("the film has no pass '{name}'; it has {}", self.passes().join(", "))))
    }
    /// A film of other values of the colour pass alone.
    fn with_colour(&self, values: Vec<f32>) -> Self {
        let Image { resolution, window, frame, samples, mean_samples, .. } = self.image;
        let (backdrop, manifests) = (self.image.backdrop.clone(), self.image.manifests.clone());
        let layers = vec![Layer { aov: Aov::Color, name: Aov::Color.name().to_owned(), values, channels: 4 }];
        let image = Image { resolution, window, frame, backdrop, layers, samples, mean_samples, manifests, deep: None };
        Self { image, exposure: self.exposure }
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
    /// Samples a pixel, the least of all.
    #[getter]
    fn samples(&self) -> u32 {
        self.image.samples
    }
    /// Samples a pixel in the mean.
    #[getter]
    fn mean_samples(&self) -> f64 {
        self.image.mean_samples
    }
    /// Names of the passes.
    #[getter]
    fn passes(&self) -> Vec<&str> {
        self.image.layers.iter().map(|layer| layer.name.as_str()).collect()
    }
    /// A pass by name.
    fn __getitem__(&self, name: &str) -> PyResult<Pass> {
        let layer = self.layer(name)?;
        Ok(Pass::new(self.image.size(), layer.channels, channel_names(layer.aov), layer.values.clone()))
    }
    /// A pass whose values are multiplied by `scale`, its rows from the bottom if asked for.
    #[pyo3(signature = (name, *, scale = 1.0, bottom_up = false))]
    fn read(&self, py: Python<'_>, name: &str, scale: f32, bottom_up: bool) -> PyResult<Pass> {
        let layer = self.layer(name)?;
        let size = self.image.size();
        let values = py.detach(|| {
            let row = (size[0] * layer.channels).max(1);
            // Coverage is no amount of light.
            let factors: [f32; 4] = std::array::from_fn(|channel| if channel == 3 { 1.0 } else { scale });
            let scaled = |row: &[f32], out: &mut Vec<f32>| {
                out.extend(row.iter().zip(factors[..layer.channels.min(4)].iter().cycle()).map(|(value, factor)| value * factor));
            };
            let mut values = Vec::with_capacity(layer.values.len());
            match bottom_up {
                true => layer.values.chunks_exact(row).rev().for_each(|row| scaled(row, &mut values)),
                false => scaled(&layer.values, &mut values),
            }
            values
        });
        Ok(Pass::new(size, layer.channels, channel_names(layer.aov), values))
    }
    /// The same film with other values in a pass: a float buffer of the shape that the pass has.
    fn with_pass(&self, name: &str, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        let shape: (usize, usize, usize) = values.getattr("shape")?.extract()?;
        let (channels, [width, height]) = (self.layer(name)?.channels, self.image.size());
        if shape != (height, width, channels) {
            return Err(PyValueError::new_err(format!("{name}: a shape of {shape:?} was found, expected {:?}", (height, width, channels))));
        }
        let values = flat(values, name)?;
        let mut image = self.image.clone();
        image.layers.iter_mut().filter(|layer| layer.name == name).for_each(|layer| layer.values.clone_from(&values));
        Ok(Self { image, exposure: self.exposure })
    }
    /// A film of the colour pass alone with most of its noise taken out, quickly and for looking at: by a filter that stops at edges. Needs the
    /// passes `denoising_albedo` and `denoising_normal`.
    fn edge_aware(&self, py: Python<'_>) -> PyResult<Self> {
        for name in [Aov::Color, Aov::DenoisingAlbedo, Aov::DenoisingNormal].map(Aov::name) {
            self.layer(name)?;
        }
        let smooth = py.detach(|| edge_aware(&self.image, Execution::detect()));
        Ok(self.with_colour(smooth.unwrap_or_default()))
    }
    /// A film of the tone-mapped colour pass alone: linear Rec.709 in [0, 1] times what is covered, which, divided by that, sRGB's curve shows as the
    /// picture that `write_picture` writes with the same arguments.
    #[pyo3(signature = (tonemap = "photographic", exposure = 0.0, *, white = 6.0, adapted = None))]
    fn tone_mapped(&self, py: Python<'_>, tonemap: &str, exposure: f32, white: f32, adapted: Option<f32>) -> PyResult<Self> {
        self.layer(Aov::Color.name())?;
        let look = ToneMap::by_name(tonemap).and_then(|operator| Look::new(operator, exposure, white, adapted, DisplaySpace::Srgb));
        let look = look.map_err(exception)?;
        Ok(self.with_colour(py.detach(|| display_linear(&self.image, &look, Execution::detect()))))
    }
    /// The picture that `write_picture` writes with the same arguments, as pixels: 8-bit sRGB with coverage, by which colours are not multiplied;
    /// `over_black` opaque, as JPEG files have it.
    #[pyo3(signature = (tonemap = "photographic", exposure = 0.0, *, white = 6.0, adapted = None, over_black = false))]
    fn picture(
        &self,
        py: Python<'_>,
        tonemap: &str,
        exposure: f32,
        white: f32,
        adapted: Option<f32>,
        over_black: bool,
    ) -> PyResult<Picture> {
        self.layer(Aov::Color.name())?;
        let look = ToneMap::by_name(tonemap).and_then(|operator| Look::new(operator, exposure, white, adapted, DisplaySpace::Srgb));
        let look = look.map_err(exception)?;
        let shown = if over_black { display_over_black } else { display };
        Ok(Picture::plain(self.image.size(), py.detach(|| shown(&self.image, &look, Execution::detect()))))
    }
    /// The tone-mapped colour pass as a PNG's bytes, by which notebooks show the film; None without one.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        if self.layer(Aov::Color.name()).is_err() {
            return Ok(None);
        }
        self.picture(py, "photographic", 0.0, 6.0, None, false)?._repr_png_(py).map(Some)
    }
    /// Writes all passes; absolute ones as 32-bit floats whatever `half` says.
    #[pyo3(signature = (path, half = false))]
    fn write_exr(&self, py: Python<'_>, path: PathBuf, half: bool) -> PyResult<()> {
        let options = ExrOptions { half, exposure: self.exposure, ..ExrOptions::default() };
        py.detach(|| write_exr(&path, &self.image, &options)).map_err(exception)
    }
    /// Writes the deep picture (pass `deep`) as OpenEXR's `deepscanline`: RGBA, Z and ZBack as 32-bit floats.
    fn write_deep_exr(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let options = ExrOptions { exposure: self.exposure, ..ExrOptions::default() };
        py.detach(|| write_deep_exr(&path, &self.image, &options)).map_err(exception)
    }
    /// What headers of files say about the film's cryptomattes (name, hash, conversion, manifest), by key; `prefix` comes before the layers' names.
    #[pyo3(signature = (prefix = ""))]
    fn matte_notes(&self, py: Python<'_>, prefix: &str) -> HashMap<String, String> {
        py.detach(|| matte_notes(&self.image, prefix).into_iter().collect())
    }
    /// How the picture was taken, as headers of files state it for `gonio glare` (projection, window, field of view, position, direction, up), by key.
    fn view_notes(&self) -> HashMap<&'static str, String> {
        self.image.frame.view.iter().flat_map(gonio::film::PictureView::notes).collect()
    }
    /// The log-average luminance of the colour pass, which the photographic operators adapt to.
    fn log_average(&self, py: Python<'_>) -> f32 {
        py.detach(|| log_average(&self.image, Execution::detect()))
    }
    /// Writes the tone-mapped colour pass as PNG, with coverage by which colours are not multiplied, or as JPEG over black. `tonemap` is "photographic", "local", "none" or "ev100=NUMBER", `exposure` brightens by
    /// powers of two, `white` is the luminance that becomes white where the log-average is 0.18; `adapted` takes the place of the picture's own
    /// log-average; `space` is "srgb", "display-p3" or "rec2020-pq" (16 bits, absolute luminance).
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    #[pyo3(signature = (path, tonemap = "photographic", exposure = 0.0, *, white = 6.0, adapted = None, space = "srgb"))]
    fn write_picture(
        &self,
        py: Python<'_>,
        path: PathBuf,
        tonemap: &str,
        exposure: f32,
        white: f32,
        adapted: Option<f32>,
        space: &str,
    ) -> PyResult<()> {
        let look = || Look::new(ToneMap::by_name(tonemap)?, exposure, white, adapted, DisplaySpace::by_name(space)?);
        let look = look().map_err(exception)?;
        py.detach(|| write_picture(&path, &self.image, &look, Execution::detect())).map_err(exception)
    }
}
