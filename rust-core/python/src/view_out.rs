//! What eyes see of the outside.

use crate::{
    daylight::up_axis,
    error::told,
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    measure::Watch,
    scene::Scene as Description,
    sky::Frame,
    view_out::{AreaView, Criterion, Layer, View, ViewLevel, ViewTask, view_out as seen},
};
use gonio_simd::Execution;
use pyo3::{prelude::*, types::PyDict};

/// Says what eyes at some points, in metres, see of the outside, as EN 17037 has it: a dict of lists by point: `sight_angle` and `widest` (degrees), `distance`
/// and `distances` (median, and least, quartiles and greatest, metres; 5000 m has no end, None is no view), `layers` (names), `level`; and of `area`, a dict of
/// the points together: `level`, `levels` by criterion, `sight_angle` and `distance` that 75 % of them have, `shares` of those that reach minimum, medium and high.
/// ground, openings: names of elements; field, step, horizon: degrees; nearest: metres.
#[pyfunction]
#[pyo3(signature = (scene, points, *, up = "Z", ground = Vec::new(), openings = Vec::new(), field = 60.0, step = 0.5, nearest = 1.0, horizon = 0.0, cancelled = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn view_out<'py>(
    py: Python<'py>,
    scene: &Scene,
    points: Vec<[f64; 3]>,
    up: &str,
    ground: Vec<String>,
    openings: Vec<String>,
    field: f64,
    step: f64,
    nearest: f64,
    horizon: f64,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let frame = Frame { up_axis: up_axis(up)?, north_deg: 0.0 };
    let task = ViewTask {
        up: frame.to_scene([0.0, 0.0, 1.0]),
        field_deg: field,
        step_deg: step,
        nearest_m: nearest,
        horizon_deg: horizon,
        ground,
        openings,
    };
    let description: Description = scene.scene.clone();
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    let (views, diagnostics) = watched(py, ask, |stop, progress| {
        seen(&description, &points, &task, Execution::detect(), &mut Watch { previous: None, cancel: stop, progress })
    })?;
    let described = PyDict::new(py);
    let all = |of: fn(&View) -> f64| views.iter().map(of).collect::<Vec<_>>();
    described.set_item("sight_angle", all(|view| view.sight_angle_deg))?;
    described.set_item("widest", all(|view| view.widest_deg))?;
    described.set_item("distance", all(View::distance_m))?;
    described.set_item("distances", views.iter().map(|view| view.distances_m).collect::<Vec<_>>())?;
    described.set_item("layers", views.iter().map(layers).collect::<Vec<_>>())?;
    described.set_item("level", views.iter().map(|view| view.level().name()).collect::<Vec<_>>())?;
    described.set_item("area", together(py, &AreaView::new(&views))?)?;
    described.set_item("diagnostics", told(&diagnostics))?;
    Ok(described)
}

fn layers(view: &View) -> Vec<&'static str> {
    Layer::NAMES.iter().filter(|(layer, _)| view.sees(*layer)).map(|(_, name)| *name).collect()
}

/// All points together.
fn together<'py>(py: Python<'py>, area: &AreaView) -> PyResult<Bound<'py, PyDict>> {
    let [described, levels, shares] = [PyDict::new(py), PyDict::new(py), PyDict::new(py)];
    for ((criterion, level), reached) in Criterion::ALL.iter().zip(area.levels).zip(area.shares) {
        levels.set_item(criterion.name(), level.name())?;
        shares.set_item(criterion.name(), by_level(py, reached)?)?;
    }
    shares.set_item("all", by_level(py, area.shares_of_all)?)?;
    described.set_item("level", area.level().name())?;
    described.set_item("levels", levels)?;
    described.set_item("shares", shares)?;
    described.set_item("sight_angle", area.sight_angle_deg)?;
    described.set_item("distance", area.distance_m)?;
    Ok(described)
}

fn by_level(py: Python<'_>, shares: [f64; 3]) -> PyResult<Bound<'_, PyDict>> {
    let described = PyDict::new(py);
    for (level, share) in ViewLevel::REACHED.iter().zip(shares) {
        described.set_item(level.name(), share)?;
    }
    Ok(described)
}
