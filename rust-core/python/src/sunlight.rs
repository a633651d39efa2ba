//! When the sun shines on points.

use crate::{
    error::{exception, setting, told},
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    measure::Watch,
    scene::{Meter, Origin, Scene as Description},
    sky::{Frame, Moment, Place, UpAxis},
    sunlight::{SunlightTask, sunlight as follow},
};
use gonio_simd::Execution;
use pyo3::{prelude::*, types::PyDict};

/// Follows the sun over a day and says when it shines on points, which have a position in metres and a normal on whose side it has to stand: a dict of
/// `hours` and `spans` (from and to, hours of the place's clock) by point, `possible` hours, and `sun`, a list of hour, azimuth and elevation in degrees.
/// time: ISO 8601 with the offset from UTC, any time of the day; up: Y or Z; north, elevation (m), least_elevation (degrees from which on the sun counts),
/// step (minutes).
#[pyfunction]
#[pyo3(signature = (scene, latitude, longitude, time, points, *, up = "Z", north = 0.0, elevation = 0.0, least_elevation = 0.0, step = 1.0, cancelled = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn sunlight<'py>(
    py: Python<'py>,
    scene: &Scene,
    latitude: f64,
    longitude: f64,
    time: &str,
    points: Vec<([f64; 3], [f64; 3])>,
    up: &str,
    north: f64,
    elevation: f64,
    least_elevation: f64,
    step: f64,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let up_axis = match up {
        "Y" => UpAxis::Y,
        "Z" => UpAxis::Z,
        other => return Err(setting("up", format!("'{other}' was found, expected Y or Z"))),
    };
    let place = Place { latitude_deg: latitude, longitude_deg: longitude, elevation_m: elevation };
    let day = Moment::parse(time).map_err(exception)?;
    let frame = Frame { up_axis, north_deg: north };
    let task = SunlightTask { place, day, frame, least_elevation_deg: least_elevation, step_min: step };
    let meter = |(number, (position, normal)): (usize, ([f64; 3], [f64; 3]))| Meter {
        origin: Origin::new(format!("point {number}")),
        position,
        normal,
        ..Meter::default()
    };
    let meters: Vec<Meter> = points.into_iter().enumerate().map(meter).collect();
    let description: Description = scene.scene.clone();
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    let (found, diagnostics) = watched(py, ask, |stop, progress| {
        let mut watch = Watch { previous: None, cancel: stop, progress };
        follow(&description, &meters, &task, Execution::detect(), &mut watch)
    })?;
    let described = PyDict::new(py);
    described.set_item("hours", (0..meters.len()).map(|point| found.hours(point)).collect::<Vec<_>>())?;
    described.set_item("spans", (0..meters.len()).map(|point| found.spans(point)).collect::<Vec<_>>())?;
    described.set_item("possible", found.possible_hours())?;
    let sun: Vec<[f64; 3]> = found.suns.iter().map(|(hour, sun)| [*hour, sun.azimuth_deg, sun.elevation_deg]).collect();
    described.set_item("sun", sun)?;
    described.set_item("diagnostics", told(&diagnostics))?;
    Ok(described)
}
