//! `gonio view-out`.

mod areas;
mod files;
mod json;
mod text;

use super::{
    arguments::ViewOutOptions,
    file::check_targets,
    measure::{author_grids, check_asked, take_points, watched},
    messages::{print, tell},
    progress::Reporter,
    reading::triple,
    render::stage_options,
    stage::Stage,
};
use areas::Areas;
use gonio::{
    Result,
    measure::Watch,
    scene::{Meter, Origin, SITTING, Scene},
    view_out::{ViewTask, view_out as seen},
};
use gonio_simd::Execution;
use gonio_usd::{Loaded, meter::axes};
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// Looks out from eyes over grids and at points.
pub(super) fn view_out(py: Python<'_>, options: &ViewOutOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let stage_options = stage_options(&options.stage)?;
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let mut grids = options.grids.clone();
    grids.height = grids.height.or((!grids.grid.is_empty()).then_some(SITTING));
    author_grids(py, &stage, &grids, None)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    options.work.apply(&mut loaded.scene.settings);
    options.textures.apply(&mut loaded.scene.settings);
    let [up, _] = axes(loaded.info.up_axis);
    raise(&mut loaded.scene, options, up);
    take_points(&mut loaded.scene, &options.grids, points(options)?);
    if !options.grids.grid.is_empty() {
        // Who names a grid has not asked for what the stage would measure besides.
        loaded.scene.grids.retain(|grid| options.grids.grid.iter().any(|prim| *prim == *grid.origin.name));
        loaded.scene.meters.retain(|meter| options.at.iter().any(|text| *text == *meter.origin.name));
    }
    check_asked(&loaded.scene)?;
    let task = ViewTask {
        up,
        field_deg: options.field,
        step_deg: options.step,
        nearest_m: options.nearest,
        horizon_deg: options.horizon,
        ground: options.ground.clone(),
        openings: options.openings.clone(),
    };
    py.detach(|| run(options, &loaded, &task, interrupted))
}

/// Moves the stage's own grids and sensors to the height of eyes.
fn raise(scene: &mut Scene, options: &ViewOutOptions, up: [f64; 3]) {
    let own = scene.grids.iter_mut().filter(|grid| !options.grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    own.for_each(|grid| grid.height += options.raise);
    for meter in &mut scene.meters {
        (0..3).for_each(|axis| meter.position[axis] += options.raise * up[axis]);
    }
}

/// The eyes of `--at`.
fn points(options: &ViewOutOptions) -> Result<Vec<Meter>> {
    let meter = |text: &String| Ok(Meter { origin: Origin::new(text), position: triple("at", text)?, ..Meter::default() });
    options.at.iter().map(meter).collect()
}

fn run(options: &ViewOutOptions, loaded: &Loaded, task: &ViewTask, interrupted: &AtomicBool) -> Result<i32> {
    let tell = |diagnostics: &[gonio::Diagnostic]| tell(&options.stage, options.quiet, diagnostics);
    tell(&loaded.diagnostics);
    let scene = &loaded.scene;
    let areas = Areas::laid_out(scene)?;
    if let Some(folder) = &options.output {
        check_targets(files::paths(folder, scene).iter())?;
    }
    let look = |watch: &mut Watch<'_>| seen(scene, &areas.eyes(), task, Execution::detect(), watch);
    let (views, diagnostics) = watched(Reporter::new(options.quiet), None, interrupted, look)?;
    tell(&diagnostics);
    let found = areas.with(&views);
    if let Some(folder) = &options.output {
        files::write(folder, &found, !options.quiet && !options.json)?;
    }
    if options.json {
        print(&json::whole(&found, task, loaded.diagnostics.iter().chain(&diagnostics)).to_string());
    } else {
        text::lines(&found).iter().for_each(|line| print(line));
    }
    Ok(0)
}
