//! The dimming that meets targets.

use crate::{
    description::to_python,
    error::setting,
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    dim::{DimTask, Dimming, Near, dim as found_dimming},
    measure::{MOST_BOUNCES, Watch},
    scene::Integrator,
};
use gonio_simd::Execution;
use pyo3::{
    prelude::*,
    types::{PyDict, PyString},
};
use std::collections::BTreeMap;

/// Says how far each light group is dimmed so that targets of the scene's meters and grids are met at least power: a dict of `groups` (name, level, watts, …),
/// `targets` (text, reached, error, margin, verdict), `watts`, `watts_full`, `areas` with what each point gets of each group, `met`, and `notes`.
///
/// targets: such as 'Floor.mean>=500', 'Floor.min>=200', 'Floor.max<=1000', 'Floor.uo>=0.6', 'Desk=500+-25'; watts: a group's power at level 1, else by its
/// luminaires' files or its flux at 100 lm/W; fixed: groups that keep a level; min_level: of all others; near: levels by group to stay near, or 'equal', in place of the least
/// power; errors: standard errors to keep from each limit.
#[pyfunction]
#[pyo3(signature = (scene, targets, *, watts = None, fixed = None, min_level = 0.0, near = None, errors = 0.0, samples = 4096, max_bounces = None, cancelled = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn dim<'py>(
    py: Python<'py>,
    scene: &Scene,
    targets: Vec<String>,
    watts: Option<BTreeMap<String, f64>>,
    fixed: Option<BTreeMap<String, f64>>,
    min_level: f64,
    near: Option<&Bound<'py, PyAny>>,
    errors: f64,
    samples: u32,
    max_bounces: Option<u32>,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut description = scene.scene.clone();
    (description.settings.samples, description.settings.max_bounces) = (samples.max(1), max_bounces.unwrap_or(MOST_BOUNCES));
    description.settings.integrator = Integrator::Path;
    let numbers = |of: Option<BTreeMap<String, f64>>| of.into_iter().flatten().collect::<Vec<_>>();
    let (watts, fixed, near) = (numbers(watts), numbers(fixed), wished(near)?);
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    let found = watched(py, ask, |stop, progress| {
        let mut watch = Watch { previous: None, cancel: stop, progress };
        let (targets, watts, fixed) = (&targets[..], &watts[..], &fixed[..]);
        let task = DimTask { targets, watts, fixed, min_level, near: near.clone(), errors_kept: errors };
        found_dimming(&description, &task, Execution::detect(), &mut watch)
    })?;
    described(py, &found)
}

fn wished(near: Option<&Bound<'_, PyAny>>) -> PyResult<Near> {
    match near {
        None => Ok(Near::LeastPower),
        Some(word) if word.is_instance_of::<PyString>() => match word.extract()? {
            "equal" => Ok(Near::Equal),
            other => Err(setting("near", format!("'{other}' was found, expected 'equal' or levels by group"))),
        },
        Some(levels) => Ok(Near::Levels(levels.extract::<BTreeMap<String, f64>>()?.into_iter().collect())),
    }
}

fn described<'py>(py: Python<'py>, found: &Dimming) -> PyResult<Bound<'py, PyDict>> {
    let dict = to_python(py, &found.json())?.cast_into::<PyDict>()?;
    dict.set_item("met", found.solution.meets_all())?;
    let told = found.diagnostics.iter().map(ToString::to_string);
    dict.set_item("notes", found.notes.iter().cloned().chain(told).collect::<Vec<_>>())?;
    Ok(dict)
}
