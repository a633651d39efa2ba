//! `gonio sports`.

use super::{leave_burning, measure_at, not_counted, plan, readings};
use crate::{
    arguments::SportsOptions,
    measure::{apply_settings, evaluated, watched},
    messages::{print, tell},
    progress::Reporter,
    render::stage_options,
    stage::Stage,
};
use gonio::{
    Diagnostic, Result,
    measure::straight_light,
    scene::{Integrator, Origin},
};
use gonio_norms::sports::{Figures, Plan, Source, lines};
use gonio_usd::meter::axes;
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// Measures what the plan asks for and tells what it comes to.
pub(crate) fn sports(py: Python<'_>, options: &SportsOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let plan = plan(&options.plan, Plan::read)?;
    let stage_options = stage_options(&options.stage)?;
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    let [up, _] = axes(loaded.info.up_axis);
    let scene = &mut loaded.scene;
    leave_burning(scene, &plan.groups, &plan.lights, "on the fields")?;
    measure_at(scene, &plan.spots(up));
    apply_settings(scene, (options.spp, None), Integrator::Path, (&options.work, &options.textures));
    tell(&options.stage, options.quiet, &loaded.diagnostics);
    let (lit, eyes) = (scene.without_emission(), plan.eyes(up));
    let found = py.detach(|| evaluated(&lit, None, Reporter::new(options.quiet), interrupted))?;
    tell(&options.stage, options.quiet, &found.diagnostics);
    let (straight, covered, mut diagnostics) =
        py.detach(|| watched(Reporter::new(true), None, interrupted, |watch| straight_light(&lit, &eyes, watch)))?;
    let source = |(direction, lx): ([f64; 3], f64)| Source { direction, lx };
    let sources: Vec<Vec<Source>> = straight.into_iter().map(|light| light.into_iter().map(source).collect()).collect();
    let not_counted = not_counted(&covered, "eyes", "rated as glare");
    let notes = not_counted.iter().map(|note| note.message.clone()).collect();
    let figures = Figures::new(&plan, up, &readings(&found), &sources).with_notes(notes);
    diagnostics.extend(not_counted);
    if figures.has_nearer() {
        let message = "luminaires within 1.5° of a line of sight count as at 1.5°, where CIE 112's formula ends";
        diagnostics.push(Diagnostic::warning(&Origin::new("glare"), message));
    }
    diagnostics.retain(|diagnostic| !found.diagnostics.contains(diagnostic));
    tell(&options.stage, options.quiet, &diagnostics);
    if options.json {
        print(&figures.json().to_string());
    } else {
        lines(&figures).iter().for_each(|line| print(line));
    }
    Ok(0)
}
