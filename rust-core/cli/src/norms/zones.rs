//! `gonio zones`.

use super::{Found, floors::floor_of, leave_burning, loaded, measured, plan, show, surfaces_left_out};
use crate::{arguments::ZonesOptions, messages::tell};
use gonio::{
    Diagnostic, Error, Result,
    scene::{Integrator, Origin},
};
use gonio_norms::zones::{Figures, Plan, lines};
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// Measures what the plan asks for and tells what it comes to.
pub(crate) fn zones(py: Python<'_>, options: &ZonesOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let (plan, options) = (plan(&options.plan, Plan::read)?, &options.norm);
    let (mut stage, up) = loaded(py, options, interrupted)?;
    let scene = &mut stage.scene;
    let plan = plan.placed(|name| floor_of(scene, name, up))?;
    plan.check().map_err(|problem| Error::setting("plan", problem))?;
    leave_burning(scene, (&plan.groups, &plan.lights), plan.maintenance_factor, "in the rooms")?;
    let Found { readings, mut told, .. } = measured(py, scene, (&plan.spots(up), &[]), (options, Integrator::Path), interrupted)?;
    let figures = Figures::new(&plan, up, &readings);
    let doubts = figures.doubts().into_iter().map(|doubt| Diagnostic::warning(&Origin::new("plan"), doubt));
    let notes: Vec<Diagnostic> = doubts.chain(surfaces_left_out(scene)).collect();
    let figures = figures.with_notes(notes.iter().map(|note| note.message.clone()).collect());
    told.extend(notes);
    tell(&options.stage, options.quiet, &told);
    show(options, || figures.json(), || lines(&figures));
    Ok(0)
}
