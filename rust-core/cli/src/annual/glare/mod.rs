//! `gonio annual-glare`.

mod eyes;
mod told;

use super::{
    facades::facades,
    inputs::{positions, weather, year},
    settings, tell_doubts,
};
use crate::{
    arguments::{AnnualGlareOptions, GridArguments},
    file::check_targets,
    measure::{apply_settings, author_grids, watched},
    messages::tell,
    progress::Reporter,
    render::{stage_options, variants},
    stage::Stage,
};
use gonio::{
    Diagnostic, Error, Result,
    annual::{AnnualTask, told},
    annual_glare::{EyesTraced, GlareTask, trace_eyes},
    scene::{Integrator, SITTING, Scene},
    sky::Frame,
};
use gonio_annual::{GlareYear, Schedule, Year};
use gonio_simd::Execution;
use gonio_usd::{Loaded, daylight::up_axis, meter::axes};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Traces the eyes and rates their year.
pub(crate) fn annual_glare(py: Python<'_>, options: &AnnualGlareOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let (year, schedule) = year(&options.year, positions(&options.year), &weather(&options.year)?)?;
    tell_doubts(&options.year, &year);
    let (facades, states) = facades(&options.facades, &year)?;
    let loaded = load(py, options, &[], interrupted)?;
    let closed = states.iter().map(|state| Ok(load(py, options, state, interrupted)?.scene)).collect::<Result<Vec<Scene>>>()?;
    let [up, ahead] = axes(loaded.info.up_axis);
    let eyes = eyes::eyes(options, &loaded.scene, up, ahead)?;
    let floor = eyes::floor(options, &loaded.scene, &facades)?;
    let frame = Frame { up_axis: up_axis(loaded.info.up_axis), north_deg: options.year.north };
    py.detach(|| {
        let tell = |diagnostics: &[Diagnostic]| tell(&options.stage, options.quiet, diagnostics);
        tell(&loaded.diagnostics);
        if let Some(folder) = &options.year.output {
            check_targets(told::paths(folder, eyes.len()).iter())?;
        }
        let task = AnnualTask { year: &year, frame, factor: options.factor, facades: &facades, closed: &closed };
        let glare = GlareTask { eyes: &eyes, floor: &floor, surfaces: options.surfaces };
        let follow = |watch: &mut gonio::measure::Watch<'_>| trace_eyes(&loaded.scene, &glare, &task, Execution::detect(), watch);
        let traced = watched(Reporter::new(options.quiet), None, interrupted, follow)?;
        tell(&traced.diagnostics);
        let told: Vec<Diagnostic> = loaded.diagnostics.iter().chain(&traced.diagnostics).cloned().collect();
        let glare = rated(options, (&year, &schedule), &traced, interrupted)?;
        let names: Vec<&str> = facades.iter().map(|facade| facade.name.as_str()).collect();
        told::finish(options, (&year, &schedule), (&eyes, &told), (&glare, &names))
    })
}

/// The stage with some more variants chosen.
fn load(py: Python<'_>, options: &AnnualGlareOptions, more: &[String], interrupted: &'static AtomicBool) -> Result<Loaded> {
    let mut stage_options = stage_options(&options.stage)?;
    stage_options.variants.extend(variants("closed-variant", more)?);
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let mut grids = options.grids.clone();
    grids.height = grids.height.or((!grids.grid.is_empty()).then_some(SITTING));
    author_grids(py, &stage, &grids, None)?;
    let floors = options.blinds_floor.iter().filter(|prim| !grids.grid.contains(prim)).cloned().collect();
    author_grids(py, &stage, &GridArguments { grid: floors, spacing: None, margin: None, height: None }, None)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    apply_settings(&mut loaded.scene, (options.spp, options.max_bounces), Integrator::Path, (&options.work, &options.textures));
    Ok(loaded)
}

/// The year of all eyes.
fn rated(
    options: &AnnualGlareOptions,
    (year, schedule): (&Year, &Schedule),
    traced: &EyesTraced,
    interrupted: &AtomicBool,
) -> Result<GlareYear> {
    let settings = settings(&options.year, None, options.work.threads)?;
    let goes_on = || !interrupted.load(Ordering::Relaxed);
    GlareYear::new(year, schedule, &traced.eyes, &settings, &goes_on).map_err(told)?.ok_or(Error::Cancelled)
}
