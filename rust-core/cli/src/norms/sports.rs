//! `gonio sports`.

use super::{Found, leave_burning, loaded, measured, not_counted, plan, show, surfaces_left_out};
use crate::{arguments::SportsOptions, messages::tell};
use gonio::{
    Diagnostic, Result,
    scene::{Integrator, Origin},
};
use gonio_norms::sports::{Figures, Plan, Source, lines};
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// Measures what the plan asks for and tells what it comes to.
pub(crate) fn sports(py: Python<'_>, options: &SportsOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let (plan, options) = (plan(&options.plan, Plan::read)?, &options.norm);
    let (mut stage, up) = loaded(py, options, interrupted)?;
    let scene = &mut stage.scene;
    let burning = leave_burning(scene, (&plan.groups, &plan.lights), plan.maintenance_factor, "on the fields")?;
    let places = (&plan.spots(up)[..], &plan.eyes(up)[..]);
    let Found { readings, straight, mut told } = measured(py, scene, places, (options, Integrator::Path), interrupted)?;
    let source = |(direction, lx): &([f64; 3], f64)| Source { direction: *direction, lx: *lx };
    let sources: Vec<Vec<Source>> = straight.iter().map(|light| light.sources.iter().map(source).collect()).collect();
    let not_counted = not_counted(&straight, "eyes", "rated as glare");
    let not_counted: Vec<Diagnostic> = not_counted.into_iter().chain(surfaces_left_out(scene)).collect();
    let figures = Figures::new(&plan, up, &readings, &sources);
    let of_glare = |message: &str| Diagnostic::warning(&Origin::new("glare"), message);
    let nearer = "luminaires within 1.5° of a line of sight count as at 1.5°, where CIE 112's formula ends";
    let own = "glare is that of lamps with maintenance factors of their own: give the plan's in their place, and it is that of new ones";
    let has_own = figures.is_rated() && burning.iter().any(|light| scene.lights[*light].maintenance != 1.0);
    let of_figures = [(figures.has_nearer(), nearer), (has_own, own)].into_iter().filter(|(holds, _)| *holds);
    let notes: Vec<Diagnostic> = not_counted.into_iter().chain(of_figures.map(|(_, message)| of_glare(message))).collect();
    let figures = figures.with_notes(notes.iter().map(|note| note.message.clone()).collect());
    told.extend(notes);
    tell(&options.stage, options.quiet, &told);
    show(options, || figures.json(), || lines(&figures));
    Ok(0)
}
