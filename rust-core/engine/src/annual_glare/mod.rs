//! A year of daylight glare at eyes in a scene: traced coefficients as `gonio_annual::GlareYear` takes them.

mod surfaces;

use crate::{
    annual::{AnnualTask, Checkpoints, Facade, trace_points},
    error::{Diagnostic, Error, Result},
    measure::Watch,
    scene::{Meter, Origin, Scene, Settings},
};
use gonio_annual::{Eyes, Group};
use gonio_simd::Execution;

/// Somebody who looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Eye {
    /// What it is called.
    pub origin: Origin,
    /// Where it is in the scene, metres.
    pub position: [f64; 3],
    /// Where it looks in the scene; any length.
    pub facing: [f64; 3],
}

/// Eyes, and what tells when direct sun closes blinds.
#[derive(Clone, Copy, Debug)]
pub struct GlareTask<'a> {
    /// Who looks.
    pub eyes: &'a [Eye],
    /// Points of a floor; none are needed where no blinds are closed by direct sun.
    pub floor: &'a [Meter],
    /// Whether bright surfaces are sources of glare too.
    pub surfaces: bool,
}

/// What was traced.
#[derive(Debug)]
pub struct EyesTraced {
    /// The eyes, the windows before them and those over the floor.
    pub eyes: Eyes,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

/// Traces eyes: `scene.settings.samples` paths each, with open and closed blinds as the year's task has them, and the points of the floor where direct sun
/// closes any.
///
/// # Errors
/// Eyes without a direction, blinds that nothing closes, what compiling finds, coefficients that would take too much memory, cancellation.
pub fn trace_eyes(
    scene: &Scene,
    glare: &GlareTask<'_>,
    task: &AnnualTask<'_>,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<EyesTraced> {
    let facings = glare.eyes.iter().map(unit_facing).collect::<Result<Vec<_>>>()?;
    let plane = |(eye, facing): (&Eye, &[f64; 3])| Meter {
        origin: eye.origin.clone(),
        position: eye.position,
        normal: *facing,
        ..Meter::default()
    };
    let floor = if closes_by_sun(task.facades) { glare.floor } else { &[] };
    if floor.is_empty() && closes_by_sun(task.facades) {
        let problem = "direct sun closes them by the points of a floor, and there is none; name one, or the hours in which they are closed";
        return Err(Error::setting("blinds", problem));
    }
    let planes: Vec<Meter> = glare.eyes.iter().zip(&facings).map(plane).collect();
    let traced = trace_points(scene, &planes, (task, &Checkpoints::default()), execution, watch)?;
    let windows = traced.groups(0..planes.len(), task.facades)?;
    let floor = if floor.is_empty() { Vec::new() } else { trace_floor(scene, floor, task, execution, watch)? };
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| task.frame.to_scene(axis));
    let compass = |facing: &[f64; 3]| axes.map(|axis| axis.iter().zip(facing).map(|(a, b)| a * b).sum::<f64>());
    let towards: Vec<[f64; 3]> = facings.iter().map(compass).collect();
    let surfaces = || surfaces::trace_surfaces(scene, (glare.eyes, &towards), task, execution, watch);
    let surfaces = glare.surfaces.then(surfaces).transpose()?;
    let eyes = Eyes { surfaces, facings: towards, windows, floor };
    Ok(EyesTraced { eyes, diagnostics: traced.diagnostics })
}

/// Traces the points of a floor. How bright groups of windows are matters only where direct sun chooses among several.
fn trace_floor(scene: &Scene, floor: &[Meter], task: &AnnualTask<'_>, execution: Execution, watch: &mut Watch<'_>) -> Result<Vec<Group>> {
    let are_several = closed_by_sun(task.facades).count() > 1;
    let of = |scene: &Scene| {
        let samples = if are_several { scene.settings.samples } else { 1 };
        let settings = Settings { samples, ..scene.settings.clone() };
        Scene { settings, ..scene.clone() }
    };
    let closed: Vec<Scene> = task.closed.iter().map(of).collect();
    let task = AnnualTask { closed: &closed, ..task.clone() };
    let traced = trace_points(&of(scene), floor, (&task, &Checkpoints::default()), execution, watch)?;
    traced.groups(0..floor.len(), task.facades)
}

fn closed_by_sun(facades: &[Facade]) -> impl Iterator<Item = &Facade> {
    facades.iter().filter(|facade| facade.blinds.is_some() && facade.closed.is_none())
}

/// Whether direct sun closes any blinds.
pub fn closes_by_sun(facades: &[Facade]) -> bool {
    closed_by_sun(facades).next().is_some()
}

fn unit_facing(eye: &Eye) -> Result<[f64; 3]> {
    let length = eye.facing.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        Ok(eye.facing.map(|part| part / length))
    } else {
        Err(Error::scene(&eye.origin, "an eye looks nowhere; its direction is zero or no number"))
    }
}
