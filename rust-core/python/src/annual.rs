//! A year of daylight on a scene's grids.

use crate::{
    array::Array,
    daylight::up_axis,
    description,
    error::{self, exception, setting},
    facades::Said,
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    Error,
    annual::{AnnualGrid, AnnualTask, Checkpoints, SunPositions, told, trace},
    measure::{MOST_BOUNCES, Watch},
    scene::{Integrator, Scene as Description},
    sky::{Frame, SkyModel},
};
use gonio_annual::{
    Chunk, Grid, Group, Point, Schedule, Series, Settings, Year, evaluate,
    sky::{Model, SkyOptions},
};
use gonio_simd::Execution;
use pyo3::{prelude::*, types::PyDict};
use std::{
    path::{Path, PathBuf},
    time::Duration,
};

/// Bytes of the hours that are calculated together.
pub(crate) const MEMORY: usize = 256 << 20;

/// Time between two checkpoints.
const EVERY: Duration = Duration::from_secs(60);

/// A year of daylight on one grid.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct AnnualReading {
    place: AnnualGrid,
    grid: Grid,
    series: Series,
    diagnostics: Vec<(String, String)>,
}

#[pymethods]
impl AnnualReading {
    /// The grid's name.
    #[getter]
    fn name(&self) -> &str {
        &self.place.origin.name
    }
    /// Points in a row, and rows.
    #[getter]
    fn size(&self) -> (usize, usize) {
        self.place.size.into()
    }
    /// Positions of the points, metres: (N, 3).
    #[getter]
    fn positions(&self) -> Array {
        Array::rows(self.place.positions.iter().flatten().copied().collect(), 3)
    }
    /// The figures as 'gonio annual --json' has them: sda_300_50, ase_1000_250, mean_lx, udi_100_3000, median_daylight_factor, en17037, points,
    /// standard_errors.
    #[getter]
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        description::to_python(py, &self.grid)
    }
    /// A figure of all points by its name, such as da_300, udi_100_3000, mean_lx or hours_direct_1000: the grid's rows and columns, nan where there
    /// is no point and where it is not known.
    fn plan(&self, figure: &str) -> PyResult<Array> {
        let of: fn(&Point) -> f64 = match figure {
            "mean_lx" => |point| point.mean_lx,
            "da_300" => |point| point.da_300,
            "cda_300" => |point| point.cda_300,
            "udi_below_100" => |point| point.udi_below_100,
            "udi_100_300" => |point| point.udi_100_300,
            "udi_300_3000" => |point| point.udi_300_3000,
            "udi_above_3000" => |point| point.udi_above_3000,
            "udi_100_3000" => |point| point.udi_100_3000,
            "hours_direct_1000" => |point| point.hours_direct_1000.unwrap_or(f64::NAN),
            "daylight_factor" => |point| point.daylight_factor,
            _ => {
                let problem = format!("'{figure}' was found, expected a number of the figures' points, such as da_300");
                return Err(setting("figure", problem));
            }
        };
        let mut points = self.grid.points.iter().map(of);
        let value = |is_there: &bool| if *is_there { points.next().unwrap_or(f64::NAN) } else { f64::NAN };
        Ok(Array::rows(self.place.is_there.iter().map(value).collect(), self.place.size[0]))
    }
    /// Illuminances in lx of sky and sun, with blinds as they are operated: points × steps of the weather file.
    #[getter]
    fn total(&self) -> Array {
        self.rows(&self.series.total)
    }
    /// Illuminances in lx straight from the sun, blinds open: points × steps.
    #[getter]
    fn direct(&self) -> Array {
        self.rows(self.series.direct.as_deref().unwrap_or_default())
    }
    /// What differs from what was asked for, of all grids: pairs of origin and message.
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        self.diagnostics.clone()
    }
    fn __repr__(&self) -> String {
        let Grid { sda_300_50, mean_lx, points, .. } = &self.grid;
        format!("<gonio.AnnualReading '{}': {} points, sDA {:.1} %, {mean_lx:.0} lx>", self.name(), points.len(), 100.0 * sda_300_50)
    }
}

impl AnnualReading {
    fn rows(&self, values: &[f32]) -> Array {
        Array::rows(values.iter().copied().map(f64::from).collect(), self.series.steps)
    }
}

/// Calculates a year of daylight on the scene's grids that measure illuminance, `samples` paths a point: one reading a grid. The scene's lamps are dark, its
/// sky and sun give way to the weather's.
///
/// weather: the bytes of an EPW or WEA file of a whole year; division: Reinhart's of the sky, 1 to 6; schedule: hours of use of every day, or 0 or 1
/// for each step; groups: windows whose blinds are operated together, a dictionary of names and prims (one or several, each with all below it) through which
/// their light comes; blinds: share of light that closed blinds let through; closed: the scene with closed blinds, in place of that share; closed_hours: when
/// they are closed, as a schedule, in place of direct sun closing them; each of these three of all groups, or a dictionary by name; sky: perez, or cie1 to cie16; sun_position: "true", or "radiance" for where gendaymtx has the sun; ground: albedo; dew_point: °C; up and north: the scene's axis, and degrees clockwise of true north; lighting: the lamps whose energy
/// beside daylight is asked for (LENI), a dictionary of power_w_m2, target_lx, control ("dimming" or "switching"), least, sensor ("least", "mean" or
/// "points"), presence and standby_kwh_m2; checkpoint: a file that keeps finished rounds, once a minute and at the end; resume: whether to go on with it
/// where it is there; part: one part alone, such as (3, 4), is traced into it, and there are no readings; merge: the parts' checkpoints, whose rounds are
/// taken in place of tracing.
#[pyfunction]
#[pyo3(signature = (scene, weather, *, samples = 8192, division = 2, schedule = None, groups = None, blinds = None, closed = None, closed_hours = None, sky = "perez", sun_position = "true", ground = 0.2, dew_point = None, up = "Z", north = 0.0, lighting = None, checkpoint = None, resume = false, part = None, merge = None, cancelled = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn annual(
    py: Python<'_>,
    scene: &Scene,
    weather: &[u8],
    samples: u32,
    division: u32,
    schedule: Option<&Bound<'_, PyAny>>,
    groups: Option<&Bound<'_, PyDict>>,
    blinds: Option<&Bound<'_, PyAny>>,
    closed: Option<&Bound<'_, PyAny>>,
    closed_hours: Option<&Bound<'_, PyAny>>,
    sky: &str,
    sun_position: &str,
    ground: f64,
    dew_point: Option<f64>,
    up: &str,
    north: f64,
    lighting: Option<&Bound<'_, PyAny>>,
    checkpoint: Option<PathBuf>,
    resume: bool,
    part: Option<[u32; 2]>,
    merge: Option<Vec<PathBuf>>,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<Vec<AnnualReading>> {
    let positions = SunPositions::parse(sun_position).map_err(exception)?;
    let year = positions.read(Path::new("weather"), weather).map_err(exception)?;
    let schedule = used_steps(schedule, &year)?;
    let (facades, closed) = Said { groups, blinds, closed, closed_hours }.facades(&year, samples)?;
    let sky = SkyOptions { model: model(sky)?, ground, dew_point_c: dew_point, ..SkyOptions::default() };
    let electric = lighting.map(|lighting| description::read(lighting, "lighting")).transpose()?;
    let open = measured(&scene.scene, samples);
    let task = AnnualTask {
        year: &year,
        frame: Frame { up_axis: up_axis(up)?, north_deg: north },
        factor: division,
        facades: &facades,
        closed: &closed,
    };
    let checkpoints = Checkpoints { path: checkpoint, every: EVERY, resume, part, merge: merge.unwrap_or_default() };
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    watched(py, ask, |stop, progress| {
        let (grids, mut diagnostics) = AnnualGrid::all(&open)?;
        let mut watch = Watch { previous: None, cancel: stop, progress };
        let traced = trace(&open, &grids, (&task, &checkpoints), Execution::detect(), &mut watch)?;
        let Some(groups) = traced.groups else { return Ok(Vec::new()) };
        diagnostics.extend(traced.diagnostics);
        let diagnostics = error::told(&diagnostics);
        let settings = Settings { sky, memory: MEMORY, threads: gonio::threads::available_threads(), electric };
        grids.into_iter().zip(groups).map(|(place, groups)| reading((place, groups, &diagnostics), (&year, &schedule), &settings)).collect()
    })
}

pub(crate) fn measured(scene: &Description, samples: u32) -> Description {
    let mut scene = scene.clone();
    (scene.settings.samples, scene.settings.max_bounces) = (samples.max(1), MOST_BOUNCES);
    scene.settings.integrator = Integrator::Path;
    scene
}

/// Hours of use of every day, a pair, or numbers for each step; without any 8 to 18.
pub(crate) fn used_steps(schedule: Option<&Bound<'_, PyAny>>, year: &Year) -> PyResult<Schedule> {
    let Some(given) = schedule else { return Schedule::daily(year, 8.0, 18.0).map_err(|error| exception(told(error))) };
    let numbers: Vec<f64> = given.extract()?;
    let found = match numbers[..] {
        [from, to] => Schedule::daily(year, from, to),
        _ => {
            if let Some(step) = numbers.iter().position(|number| *number != 0.0 && *number != 1.0) {
                let problem = format!("{} was found at step {}, expected 0 or 1: a step is used or is not", numbers[step], step + 1);
                return Err(setting("schedule", problem));
            }
            Schedule::new(year, numbers.iter().map(|number| *number != 0.0).collect())
        }
    };
    found.map_err(|error| exception(told(error)))
}

pub(crate) fn model(name: &str) -> PyResult<Model> {
    match SkyModel::parse(name).map_err(exception)? {
        SkyModel::Perez => Ok(Model::Perez),
        SkyModel::Cie(kind) => Ok(Model::Cie(kind)),
        SkyModel::HosekWilkie => Err(setting("sky", "hosek-wilkie knows clear skies alone, expected perez or cie1 to cie16".to_owned())),
    }
}

/// A grid's year.
fn reading(
    (place, groups, diagnostics): (AnnualGrid, Vec<Group>, &[(String, String)]),
    (year, schedule): (&Year, &Schedule),
    settings: &Settings,
) -> Result<AnnualReading, Error> {
    let mut series = Series::new(place.positions.len(), year.steps.len());
    let mut take = |chunk: &Chunk<'_>| {
        series.take(chunk);
        true
    };
    let grid = evaluate(year, schedule, &groups, settings, &mut take).map_err(told)?.ok_or(Error::Cancelled)?;
    Ok(AnnualReading { place, grid, series, diagnostics: diagnostics.to_vec() })
}
