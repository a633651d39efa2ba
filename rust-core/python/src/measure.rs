//! Meters and calculation grids.

use crate::{
    array::Array,
    error::{exception, told},
    glare::Coverage,
    picture::Picture,
    render::Render,
    scene::Scene,
    spectrum::figures_described,
    watched::{unless, watched},
};
use gonio::{
    measure::{self, Summary, Watch},
    output::FalseColour,
    scene::{Measurand, Scene as Description},
};
use gonio_simd::Execution;
use pyo3::{prelude::*, types::PyDict};
use std::sync::Arc;

/// A value with its standard error, in the quantity's unit.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Reading {
    reading: measure::Reading,
    coverage: Option<measure::glare::Coverage>,
    small: Option<measure::SmallSources>,
    colour: Option<Arc<measure::ColourReading>>,
}

impl Reading {
    pub(crate) fn of(reading: measure::Reading) -> Self {
        Self { reading, coverage: None, small: None, colour: None }
    }
}

#[pymethods]
impl Reading {
    /// The mean of all samples.
    #[getter]
    fn value(&self) -> f64 {
        self.reading.value
    }
    /// By the spread of parts of the samples; an upper estimate.
    #[getter]
    fn standard_error(&self) -> f64 {
        self.reading.standard_error
    }
    /// What a meter's glare rating leaves out; None of other quantities.
    #[getter]
    fn coverage(&self) -> Option<Coverage> {
        self.coverage.as_ref().map(Coverage::of)
    }
    /// How many sources of a meter's glare rating are below 0.005 m², which CIE 147 rates as small; None of other quantities.
    #[getter]
    fn small_sources(&self) -> Option<usize> {
        self.small.map(|small| small.count)
    }
    /// A meter's glare rating by CIE 117 alone, as UGR tables have it; None of other quantities, and where a source is a point.
    #[getter]
    fn as_in_tables(&self) -> Option<Self> {
        self.small.and_then(|small| small.tabular).map(Self::of)
    }
    /// Of a meter's figure of colour everything that the light's spectrum says: as `spectrum_figures` has it, and illuminance_lx, melanopic_edi_lx,
    /// standard_errors, wavelengths_nm, irradiance in W/(m² nm), irradiance_standard_errors; None of other quantities.
    #[getter]
    fn colour<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        self.colour.as_ref().map(|colour| colour_described(py, colour)).transpose()
    }
    fn __float__(&self) -> f64 {
        self.reading.value
    }
    fn __repr__(&self) -> String {
        format!("<gonio.Reading: {} ± {}>", self.reading.value, self.reading.standard_error)
    }
}

/// What the spectrum at a meter says.
pub(crate) fn colour_described<'py>(py: Python<'py>, colour: &measure::ColourReading) -> PyResult<Bound<'py, PyDict>> {
    let described = match &colour.figures {
        Some(figures) => figures_described(py, figures)?,
        None => PyDict::new(py),
    };
    let errors = PyDict::new(py);
    for measurand in Measurand::OF_COLOUR {
        errors.set_item(measurand.name(), colour.of(measurand).map(|reading| reading.standard_error))?;
    }
    for (name, reading) in [("illuminance_lx", Some(colour.illuminance)), ("melanopic_edi_lx", colour.melanopic_edi())] {
        described.set_item(name, reading.map(|reading| reading.value))?;
        errors.set_item(name, reading.map(|reading| reading.standard_error))?;
    }
    described.set_item("standard_errors", errors)?;
    let at_all = |of: fn(&measure::Reading) -> f64| Array::flat(colour.spectrum.iter().map(of).collect());
    described.set_item("wavelengths_nm", Array::flat(colour.wavelengths_nm().to_vec()))?;
    described.set_item("irradiance", at_all(|reading| reading.value))?;
    described.set_item("irradiance_standard_errors", at_all(|reading| reading.standard_error))?;
    Ok(described)
}

/// What a grid shows. Arrays have the grid's rows and columns, and nan where the area does not reach.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct GridReading {
    grid: measure::GridReading,
}

impl GridReading {
    fn summary(&self) -> &Summary {
        &self.grid.summary
    }
    fn rows(&self, mut value: impl FnMut(&([f64; 3], measure::Reading)) -> f64) -> Array {
        let values = self.grid.points.iter().map(|point| point.as_ref().map_or(f64::NAN, &mut value)).collect();
        Array::rows(values, self.grid.size[0])
    }
    fn of_eyes(&self, value: impl Fn(&measure::Reading) -> f64) -> Option<Array> {
        let eyes = self.grid.eyes.as_ref()?;
        Some(Array::rows(eyes.views.iter().flatten().map(value).collect(), eyes.facings.len()))
    }
    fn least_of_eyes(&self, value: impl Fn(&measure::Reading) -> f64) -> Option<Array> {
        let mut leasts = self.grid.eyes.as_ref()?.leasts().into_iter();
        Some(self.rows(move |_| leasts.next().map_or(f64::NAN, |reading| value(&reading))))
    }
}

#[pymethods]
impl GridReading {
    /// The grid's name.
    #[getter]
    fn name(&self) -> &str {
        &self.grid.origin.name
    }
    /// What was measured.
    #[getter]
    fn quantity(&self) -> &'static str {
        self.grid.measurand.name()
    }
    /// The unit's sign.
    #[getter]
    fn unit(&self) -> &'static str {
        self.grid.measurand.unit()
    }
    /// Points in a row, and rows.
    #[getter]
    fn size(&self) -> (usize, usize) {
        self.grid.size.into()
    }
    /// Metres from point to point, along a row and from row to row.
    #[getter]
    fn spacing(&self) -> (f64, f64) {
        self.grid.spacing.into()
    }
    /// Square metres of the whole surface, margins included, seen along its normal.
    #[getter]
    fn area(&self) -> f64 {
        self.grid.area
    }
    /// Mean of all points.
    #[getter]
    fn average(&self) -> Reading {
        Reading::of(self.summary().average)
    }
    /// The least point.
    #[getter]
    fn min(&self) -> Reading {
        Reading::of(self.summary().min)
    }
    /// The greatest point.
    #[getter]
    fn max(&self) -> Reading {
        Reading::of(self.summary().max)
    }
    /// What the glare ratings leave out at each point that was measured; empty of other quantities.
    #[getter]
    fn coverage(&self) -> Vec<Coverage> {
        self.grid.coverage.iter().map(Coverage::of).collect()
    }
    /// Of figures of colour what `Reading.colour` has, of each point that was measured, and of eyes direction by direction; empty of other quantities.
    #[getter]
    fn colours<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        self.grid.colours.iter().map(|colour| colour_described(py, colour)).collect()
    }
    /// Glare ratings by CIE 117 alone, as UGR tables have them, at the points that were measured; nan where a source is a point, empty of other quantities.
    #[getter]
    fn as_in_tables(&self) -> Array {
        Array::flat(self.grid.small.iter().map(|small| small.tabular.map_or(f64::NAN, |reading| reading.value)).collect())
    }
    /// The same in words for all points, and which sources are rated as small; None where there is nothing to be said.
    #[getter]
    fn rating_note(&self) -> Option<String> {
        self.grid.rating_note()
    }
    /// The coverage in words for all points; None where all is rated.
    #[getter]
    fn coverage_note(&self) -> Option<String> {
        self.grid.coverage_note()
    }
    /// Where the eyes of each point look, unit vectors (D, 3); None of grids without eyes.
    #[getter]
    fn facings(&self) -> Option<Array> {
        self.grid.eyes.as_ref().map(|eyes| Array::rows(eyes.facings.concat(), 3))
    }
    /// What each eye gets, points that were measured × directions; None of grids without eyes. `values` are their means over the directions.
    #[getter]
    fn eye_values(&self) -> Option<Array> {
        self.of_eyes(|reading| reading.value)
    }
    /// Standard errors of `eye_values`.
    #[getter]
    fn eye_standard_errors(&self) -> Option<Array> {
        self.of_eyes(|reading| reading.standard_error)
    }
    /// Each point's least direction, in rows and columns; None of grids without eyes.
    #[getter]
    fn leasts(&self) -> Option<Array> {
        self.least_of_eyes(|reading| reading.value)
    }
    /// Standard errors of `leasts`.
    #[getter]
    fn least_standard_errors(&self) -> Option<Array> {
        self.least_of_eyes(|reading| reading.standard_error)
    }
    /// Which shares reach a value, 0 to 1: of the `points` (those with eyes by their mean over the directions), and of grids with eyes `points_all_ways`
    /// (their least direction) and `eyes` (each for itself). Each has `count`, `share`, its `standard_error`, two of which take in what the readings'
    /// own errors leave open, and `share_within_error`, the share of these.
    fn reaching<'py>(&self, py: Python<'py>, target: f64) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let add = |name: &str, found: measure::Reaching| -> PyResult<()> {
            let share = PyDict::new(py);
            share.set_item("count", found.count)?;
            share.set_item("share", found.share().value)?;
            share.set_item("standard_error", found.share().standard_error)?;
            share.set_item("share_within_error", found.share_open())?;
            all.set_item(name, share)
        };
        add("points", self.grid.reaching(target))?;
        if let Some(eyes) = &self.grid.eyes {
            add("points_all_ways", eyes.reaching_all_ways(target))?;
            add("eyes", eyes.reaching_views(target))?;
        }
        Ok(all)
    }
    /// U₀: least over average.
    #[getter]
    fn uniformity(&self) -> f64 {
        self.summary().uniformity()
    }
    /// U_d: least over greatest.
    #[getter]
    fn diversity(&self) -> f64 {
        self.summary().diversity()
    }
    /// The values.
    #[getter]
    fn values(&self) -> Array {
        self.rows(|(_, reading)| reading.value)
    }
    /// Their standard errors.
    #[getter]
    fn standard_errors(&self) -> Array {
        self.rows(|(_, reading)| reading.standard_error)
    }
    /// Positions of the points that were measured, metres: (N, 3).
    #[getter]
    fn positions(&self) -> Array {
        Array::rows(self.grid.points.iter().flatten().flat_map(|(position, _)| *position).collect(), 3)
    }
    /// False colour with isolines, the values at their points, and a legend; `max` is the upper end of the scale, a round number without it. Scales of
    /// figures of colour begin at the least value.
    #[pyo3(signature = (*, max = None, steps = 10, log = None, contours = true, legend = true))]
    fn picture(&self, max: Option<f32>, steps: u32, log: Option<f32>, contours: bool, legend: bool) -> PyResult<Picture> {
        let scale = self.grid.scale(max, steps, log).map_err(exception)?;
        let style = FalseColour { scale, unit: self.unit().to_owned(), contours, smoothing: 0, legend };
        Ok(Picture::of(measure::value_picture(&self.grid, &style), style))
    }
}

/// What all meters and grids of a scene show.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Measurements {
    found: measure::Measurements,
}

#[pymethods]
impl Measurements {
    /// Readings of the meters, in the scene's order.
    #[getter]
    fn meters(&self) -> Vec<Reading> {
        let of = |meter: &measure::MeterReading| Reading {
            reading: meter.reading,
            coverage: meter.coverage,
            small: meter.small,
            colour: meter.colour.clone(),
        };
        self.found.meters.iter().map(of).collect()
    }
    /// Readings of the grids, in the scene's order.
    #[getter]
    fn grids(&self) -> Vec<GridReading> {
        self.found.grids.iter().map(|grid| GridReading { grid: grid.clone() }).collect()
    }
    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        told(&self.found.diagnostics)
    }
    /// All points as comma-separated values, one a line.
    fn csv(&self) -> String {
        measure::csv(&self.found)
    }
}

/// Evaluates the scene's meters and grids with `samples` a point and, unlike pictures, as many bounces as matter, or `max_bounces`; `previous` lends the trees and images of what did not change, and `cancelled`, a
/// function that says whether to stop, is asked every 50 ms.
#[pyfunction]
#[pyo3(name = "measure", signature = (scene, *, samples = 4096, max_bounces = None, previous = None, cancelled = None))]
pub(crate) fn measure_scene(
    py: Python<'_>,
    scene: &Scene,
    samples: u32,
    max_bounces: Option<u32>,
    previous: Option<&Render>,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<Measurements> {
    let mut description: Description = scene.scene.clone();
    (description.settings.samples, description.settings.max_bounces) = (samples.max(1), max_bounces.unwrap_or(measure::MOST_BOUNCES));
    let before = previous.and_then(Render::compiled);
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    let found = watched(py, ask, |stop, progress| {
        let mut watch = Watch { previous: before.as_deref(), cancel: stop, progress };
        measure::measure(&description, Execution::detect(), &mut watch)
    })?;
    Ok(Measurements { found })
}
