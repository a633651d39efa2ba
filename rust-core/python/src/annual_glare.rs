//! A year of daylight glare at eyes.

use crate::{
    annual::{measured, model, used_steps},
    array::Array,
    daylight::up_axis,
    description,
    error::{self, exception},
    facades::Said,
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    Error,
    annual::{AnnualTask, SunPositions, told},
    annual_glare::{Eye, GlareTask, closes_by_sun, trace_eyes},
    measure::{GridPoints, Watch},
    scene::{Measurand, Meter, Origin, Scene as Description},
    sky::Frame,
};
use gonio_annual::{EyeGlare, GlareYear, Settings, sky::SkyOptions};
use gonio_simd::Execution;
use pyo3::{prelude::*, types::PyDict};
use std::path::Path;

/// A year of daylight glare at one eye.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct AnnualGlareReading {
    eye: Eye,
    glare: EyeGlare,
    errors: Option<EyeGlare>,
    values: Vec<f32>,
    closed_hours: Vec<f64>,
    diagnostics: Vec<(String, String)>,
}

#[pymethods]
impl AnnualGlareReading {
    /// Where the eye is, metres.
    #[getter]
    fn position(&self) -> [f64; 3] {
        self.eye.position
    }
    /// Where it looks.
    #[getter]
    fn facing(&self) -> [f64; 3] {
        self.eye.facing
    }
    /// above_035, above_040, above_045: shares of the used time with a DGP above that; dgp_5_percent: the value that is exceeded in 5 % of it.
    #[getter]
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        description::to_python(py, &self.glare)
    }
    /// Standard errors of the figures.
    #[getter]
    fn standard_errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        description::to_python(py, &self.errors)
    }
    /// What differs from what was asked for, of all eyes: pairs of origin and message.
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        self.diagnostics.clone()
    }
    /// What EN 17037 calls it: 'high', 'medium', 'minimum' or 'below the minimum'.
    #[getter]
    fn en17037(&self) -> &'static str {
        self.glare.level()
    }
    /// By group of windows, used hours with its blinds closed; empty without blinds.
    #[getter]
    fn closed_hours(&self) -> Vec<f64> {
        self.closed_hours.clone()
    }
    /// DGP of every step of the weather file, 0 in the dark: (steps,).
    #[getter]
    fn values(&self) -> Array {
        Array::flat(self.values.iter().copied().map(f64::from).collect())
    }
    fn __repr__(&self) -> String {
        format!("<gonio.AnnualGlareReading: DGP {:.3} exceeded in 5 %, EN 17037 {}>", self.glare.dgp_5_percent, self.glare.level())
    }
}

/// Rates daylight glare over a year for eyes, pairs of a position in metres and where they look, `samples` paths each: one reading an eye. Lamps are dark, sky
/// and sun give way to the weather's. surfaces: whether bright ones are sources of glare too, by luminances of 577 directions before each eye. The other arguments are those of `annual`; where direct sun closes blinds it does so by the scene's grids that measure
/// illuminance.
#[pyfunction]
#[pyo3(signature = (scene, weather, eyes, *, samples = 8192, division = 4, schedule = None, groups = None, blinds = None, closed = None, closed_hours = None, surfaces = false, sky = "perez", sun_position = "true", ground = 0.2, dew_point = None, up = "Z", north = 0.0, cancelled = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn annual_glare(
    py: Python<'_>,
    scene: &Scene,
    weather: &[u8],
    eyes: Vec<([f64; 3], [f64; 3])>,
    samples: u32,
    division: u32,
    schedule: Option<&Bound<'_, PyAny>>,
    groups: Option<&Bound<'_, PyDict>>,
    blinds: Option<&Bound<'_, PyAny>>,
    closed: Option<&Bound<'_, PyAny>>,
    closed_hours: Option<&Bound<'_, PyAny>>,
    surfaces: bool,
    sky: &str,
    sun_position: &str,
    ground: f64,
    dew_point: Option<f64>,
    up: &str,
    north: f64,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<Vec<AnnualGlareReading>> {
    let positions = SunPositions::parse(sun_position).map_err(exception)?;
    let year = positions.read(Path::new("weather"), weather).map_err(exception)?;
    let schedule = used_steps(schedule, &year)?;
    let (facades, closed) = Said { groups, blinds, closed, closed_hours }.facades(&year, samples)?;
    let sky = SkyOptions { model: model(sky)?, ground, dew_point_c: dew_point, ..SkyOptions::default() };
    let scene = measured(&scene.scene, samples);
    let named = |(number, (position, facing)): (usize, ([f64; 3], [f64; 3]))| Eye {
        origin: Origin::new(format!("eye {}", number + 1)),
        position,
        facing,
    };
    let eyes: Vec<Eye> = eyes.into_iter().enumerate().map(named).collect();
    let frame = Frame { up_axis: up_axis(up)?, north_deg: north };
    let task = AnnualTask { year: &year, frame, factor: division, facades: &facades, closed: &closed };
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    watched(py, ask, |stop, progress| {
        if eyes.is_empty() {
            return Ok(Vec::new());
        }
        let floor = if closes_by_sun(&facades) { floor(&scene)? } else { Vec::new() };
        let glare = GlareTask { eyes: &eyes, floor: &floor, surfaces };
        let traced = trace_eyes(&scene, &glare, &task, Execution::detect(), &mut Watch { previous: None, cancel: stop, progress })?;
        let settings = Settings { sky, memory: crate::annual::MEMORY, threads: gonio::threads::available_threads(), electric: None };
        let diagnostics = error::told(&traced.diagnostics);
        let found = GlareYear::new(&year, &schedule, &traced.eyes, &settings, &|| true).map_err(told)?.ok_or(Error::Cancelled)?;
        let reading = |(number, (eye, (glare, errors))): (usize, (Eye, (EyeGlare, Option<EyeGlare>)))| AnnualGlareReading {
            eye,
            glare,
            errors,
            values: found.values(number).to_vec(),
            closed_hours: found.closed_hours().to_vec(),
            diagnostics: diagnostics.clone(),
        };
        Ok(eyes.iter().cloned().zip(found.glare(&schedule)).enumerate().map(reading).collect())
    })
}

/// The points of a scene's grids that measure illuminance.
fn floor(scene: &Description) -> Result<Vec<Meter>, Error> {
    let mut points = Vec::new();
    for grid in scene.grids.iter().filter(|grid| grid.eyes.is_none() && grid.measurand == Measurand::Illuminance) {
        points.extend(GridPoints::new(scene, grid)?.planes(grid));
    }
    Ok(points)
}
