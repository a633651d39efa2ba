//! False colour.

use crate::{
    buffer::side_lengths,
    error::{exception, setting},
};
use gonio::output::{self, Canvas, FalseColour, FalseColourScale};
use pyo3::{prelude::*, types::PyBytes};
use std::{io::Write, path::PathBuf};

/// Most pixels of a legend's height.
const TALLEST: usize = 65_536;

/// A picture for looking at: 8-bit RGBA, colours not multiplied by alpha, rows from the top.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Picture {
    canvas: Canvas,
    /// None where its colours stand for no numbers.
    style: Option<FalseColour>,
}

impl Picture {
    pub(crate) fn of(canvas: Canvas, style: FalseColour) -> Self {
        Self { canvas, style: Some(style) }
    }
    /// Pixels that need no legend: four bytes each.
    pub(crate) fn plain(size: [usize; 2], rgba: Vec<u8>) -> Self {
        Self { canvas: Canvas { size, rgba }, style: None }
    }
}

#[pymethods]
impl Picture {
    /// Width and height in pixels.
    #[getter]
    fn size(&self) -> (usize, usize) {
        self.canvas.size.into()
    }
    /// The legend of false colours alone, for a picture of a height in pixels, at most 65,536.
    fn legend(&self, height: usize) -> PyResult<Self> {
        if height > TALLEST {
            return Err(setting("height", format!("{height} was found, expected at most {TALLEST} pixels")));
        }
        let style = self.style.as_ref().ok_or_else(|| setting("legend", "the picture is not in false colour".to_owned()))?;
        Ok(Self::of(style.legend(height), style.clone()))
    }
    /// Four bytes a pixel.
    fn tobytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.canvas.rgba)
    }
    /// The picture as a PNG's bytes, by which notebooks show it.
    pub(crate) fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let [width, height] = self.canvas.size.map(|side| side as u32);
        let bytes = py.detach(|| output::encode_png(&self.canvas.rgba, width, height));
        Ok(PyBytes::new(py, &bytes.map_err(|error| exception(gonio::Error::io("picture", error)))?))
    }
    /// Writes it as PNG.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let [width, height] = self.canvas.size.map(|side| side as u32);
        let written = py.detach(|| {
            let bytes = output::encode_png(&self.canvas.rgba, width, height).map_err(|error| gonio::Error::io(&path, error))?;
            output::write_atomically(&path, true, |file| file.write_all(&bytes))
        });
        written.map_err(exception)
    }
}

/// The style that was asked for.
pub(crate) fn style(
    values: &[f32],
    max: Option<f32>,
    steps: u32,
    log: Option<f32>,
    unit: &str,
    [contours, legend]: [bool; 2],
    smoothing: usize,
) -> PyResult<FalseColour> {
    let scale = FalseColourScale::of_values(values, max, steps, log, false).map_err(exception)?;
    Ok(FalseColour { scale, unit: unit.to_owned(), contours, smoothing, legend })
}

/// A float buffer (height, width) or (height, width, 1), rows from the top, in fixed steps with a legend: `steps` of them up to `max` (a round number
/// without it), even or over `log` decades. `contours` draws lines where steps meet, of means over `smoothing` pixels to each side.
#[pyfunction]
#[pyo3(signature = (values, *, max = None, steps = 10, log = None, unit = "", contours = false, smoothing = 3, legend = true))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn false_colour(
    py: Python<'_>,
    values: &Bound<'_, PyAny>,
    max: Option<f32>,
    steps: u32,
    log: Option<f32>,
    unit: &str,
    contours: bool,
    smoothing: usize,
    legend: bool,
) -> PyResult<Picture> {
    let size = side_lengths(values, "values")?;
    let values = flat(values, "values")?;
    let style = style(&values, max, steps, log, unit, [contours, legend], smoothing)?;
    let canvas = py.detach(|| style.draw(&values, size));
    Ok(Picture::of(canvas, style))
}

/// The numbers of a float buffer of any shape.
pub(crate) fn flat(values: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f32>> {
    crate::buffer::doubles(values, name).map(|values| values.into_iter().map(|x| x as f32).collect())
}
