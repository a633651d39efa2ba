//! `gonio emergency`.

use super::{leave_burning, measure_at, plan, readings};
use crate::{
    arguments::EmergencyOptions,
    measure::{apply_settings, evaluated},
    messages::{print, tell},
    progress::Reporter,
    render::stage_options,
    stage::Stage,
};
use gonio::{
    Result,
    compile::luminous_intensities,
    scene::{Integrator, Scene},
};
use gonio_norms::emergency::{Figures, Lamp, Plan, lines};
use gonio_usd::meter::axes;
use pyo3::prelude::*;
use std::{collections::BTreeMap, sync::atomic::AtomicBool};

/// Degrees between directions in which intensities are asked for, across and down.
const STEPS_DEG: [f64; 2] = [5.0, 1.0];

/// Measures what the plan asks for and tells what it comes to.
pub(crate) fn emergency(py: Python<'_>, options: &EmergencyOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let plan = plan(&options.plan, Plan::read)?;
    let stage_options = stage_options(&options.stage)?;
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    let [up, _] = axes(loaded.info.up_axis);
    let spots = plan.spots(up);
    let scene = &mut loaded.scene;
    let lamps = leave_burning(scene, &plan.groups, &plan.lights, "in an emergency")?;
    measure_at(scene, &spots);
    // What surfaces send on does not count (EN 1838).
    apply_settings(scene, (options.spp, None), Integrator::Direct, (&options.work, &options.textures));
    tell(&options.stage, options.quiet, &loaded.diagnostics);
    let (dark, lamps) = (scene.without_emission(), seen(scene, &lamps, &plan, up));
    let found = py.detach(|| evaluated(&dark, None, Reporter::new(options.quiet), interrupted))?;
    tell(&options.stage, options.quiet, &found.diagnostics);
    let figures = Figures::new(&plan, &spots, &readings(&found), lamps);
    if options.json {
        print(&figures.json().to_string());
    } else {
        lines(&figures).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// Luminaires with their height above the lowest floor of the plan and their greatest intensity within its angles; lights of one prim are one.
fn seen(scene: &Scene, burning: &[usize], plan: &Plan, up: [f64; 3]) -> Vec<Lamp> {
    let along = |p: [f64; 3]| p[0] * up[0] + p[1] * up[1] + p[2] * up[2];
    let corners = plan.routes.iter().flat_map(|route| &route.line).chain(plan.areas.iter().flat_map(|area| &area.outline));
    let floor = corners.map(|corner| along(*corner)).fold(f64::INFINITY, f64::min);
    let floor = if floor.is_finite() { floor } else { 0.0 };
    let intensities = luminous_intensities(scene, &directions(plan.glare_deg, up));
    let mut lamps: BTreeMap<&str, (f64, Vec<f64>)> = BTreeMap::new();
    for number in burning {
        let light = &scene.lights[*number];
        let Some(Some(found)) = intensities.get(*number) else { continue };
        let height = along(light.transform.point([0.0; 3])) - floor;
        let (_, sum) = lamps.entry(&light.origin.name).or_insert_with(|| (height, vec![0.0; found.len()]));
        sum.iter_mut().zip(found).for_each(|(sum, part)| *sum += part);
    }
    let lamp = |(name, (height, sum)): (&str, (f64, Vec<f64>))| Lamp {
        name: name.to_owned(),
        height,
        peak_cd: sum.into_iter().fold(0.0, f64::max),
    };
    lamps.into_iter().map(lamp).collect()
}

/// Directions between two angles from straight down, all around.
fn directions([from, to]: [f64; 2], up: [f64; 3]) -> Vec<[f64; 3]> {
    let side = [up[1], up[2], up[0]];
    let other = [up[1] * side[2] - up[2] * side[1], up[2] * side[0] - up[0] * side[2], up[0] * side[1] - up[1] * side[0]];
    let [around, down] = [(360.0 / STEPS_DEG[0]) as usize, ((to - from) / STEPS_DEG[1]).ceil().max(1.0) as usize];
    let direction = |k: usize, j: usize| {
        let (sin, cos) = (from + (to - from) * j as f64 / down as f64).to_radians().sin_cos();
        let (y, x) = (STEPS_DEG[0] * k as f64).to_radians().sin_cos();
        std::array::from_fn(|axis| sin * (x * side[axis] + y * other[axis]) - cos * up[axis])
    };
    (0..around).flat_map(|k| (0..=down).map(move |j| direction(k, j))).collect()
}
