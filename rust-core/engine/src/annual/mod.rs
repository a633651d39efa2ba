//! A year of daylight on a scene's grids: traced coefficients as `gonio_annual` takes them.
//!
//! [`AnnualGrid::all`] lays grids out, [`trace`] gives each a group of windows, and `gonio_annual::evaluate` makes a year of it.

mod facade;
mod file;
mod grid;
mod keeper;
mod sky;
mod suns;
#[cfg(test)]
mod tests;
mod traced;

pub use facade::{Facade, FacadeBlinds};
pub use grid::AnnualGrid;
pub use keeper::Checkpoints;
pub use suns::SunPositions;

use crate::{
    error::{Diagnostic, Error, Result},
    measure::{DaylightCoefficients, Keeping, Kept, Watch, trace_rounds},
    scene::{Meter, Scene},
    sky::Frame,
};
use file::Traced;
use gonio_annual::{AnnualError, Group, Year};
use gonio_simd::Execution;
use keeper::Keeper;
pub(crate) use sky::under_sky;
pub(crate) use traced::PointsTraced;

/// What is traced.
#[derive(Clone, Debug)]
pub struct AnnualTask<'a> {
    /// The year, whose suns are traced at their places.
    pub year: &'a Year,
    /// Where up and north are in the scene.
    pub frame: Frame,
    /// Reinhart's division of the sky, 1 to 6.
    pub factor: u32,
    /// Windows with blinds of their own, whose light is told apart; one without prims has all light.
    pub facades: &'a [Facade],
    /// Scenes with closed blinds.
    pub closed: &'a [Scene],
}

/// What was traced.
#[derive(Clone, Debug)]
pub struct GridsTraced {
    /// By grid its groups of windows: those of the task's facades in their order, then light that comes through none of them, where there is any. `None`
    /// where a part alone was asked for, which checkpoints keep.
    pub groups: Option<Vec<Vec<Group>>>,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

/// Traces grids: `scene.settings.samples` paths a point.
///
/// # Errors
/// Facades that are nowhere, what compiling finds, coefficients that would take too much memory, checkpoints of others, cancellation.
pub fn trace(
    scene: &Scene,
    grids: &[AnnualGrid],
    (task, checkpoints): (&AnnualTask<'_>, &Checkpoints),
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<GridsTraced> {
    let points: Vec<Meter> = grids.iter().flat_map(AnnualGrid::meters).collect();
    let traced = trace_points(scene, &points, (task, checkpoints), execution, watch)?;
    if checkpoints.part.is_some() {
        return Ok(GridsTraced { groups: None, diagnostics: traced.diagnostics });
    }
    let mut first = 0;
    let groups = |grid: &AnnualGrid| {
        let rows = first..first + grid.positions.len();
        first = rows.end;
        traced.groups(rows, task.facades)
    };
    let groups = grids.iter().map(groups).collect::<Result<_>>()?;
    Ok(GridsTraced { groups: Some(groups), diagnostics: traced.diagnostics })
}

/// Traces points in the scene and in those with closed blinds.
pub(crate) fn trace_points(
    scene: &Scene,
    points: &[Meter],
    (task, checkpoints): (&AnnualTask<'_>, &Checkpoints),
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<PointsTraced> {
    facade::check(scene, task.facades)?;
    let scenes: Vec<&Scene> = std::iter::once(scene).chain(task.closed).collect();
    let (kept, diagnostics) = rounds(&scenes, points, (task, checkpoints), execution, watch)?;
    Ok(PointsTraced { states: kept.into_iter().map(DaylightCoefficients::from).collect(), points: points.len(), diagnostics })
}

/// By scene what is found in it: what checkpoints have and what is traced.
fn rounds(
    scenes: &[&Scene],
    points: &[Meter],
    (task, checkpoints): (&AnnualTask<'_>, &Checkpoints),
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(Vec<Kept>, Vec<Diagnostic>)> {
    let (rounds, suns) = checkpoints.rounds()?;
    let mut diagnostics = Vec::new();
    let kept = under_sky(task, points.len(), |sky| {
        let are_wanted = checkpoints.are_wanted();
        let traced: Vec<Traced> = scenes.iter().filter(|_| are_wanted).map(|scene| Traced::new(scene, points, sky, execution)).collect();
        let mut all = if are_wanted { checkpoints.read(&traced)? } else { vec![Kept::default(); scenes.len()] };
        let mut keeper = Keeper::new(checkpoints, &traced);
        for (number, scene) in scenes.iter().enumerate() {
            let mut kept = std::mem::take(&mut all[number]);
            let others = &all;
            let mut keep = keeper.as_mut().map(|keeper| {
                move |kept: &Kept| {
                    let all: Vec<&Kept> =
                        others.iter().enumerate().map(|(place, other)| if place == number { kept } else { other }).collect();
                    keeper.keep_if_due(&all);
                }
            });
            let finished = keep.as_mut().map(|keep| keep as &mut (dyn FnMut(&Kept) + Send));
            let mut keeping = Keeping { kept: &mut kept, rounds: rounds.clone(), suns, finished };
            let told = trace_rounds(scene, points, sky, execution, watch, &mut keeping);
            all[number] = kept;
            let ends = told.is_err() || number + 1 == scenes.len();
            let written = keeper.as_mut().filter(|_| ends).map_or(Ok(()), |keeper| keeper.keep(&all.iter().collect::<Vec<_>>()));
            diagnostics.extend(told?);
            written?;
        }
        diagnostics.extend(keeper.into_iter().flat_map(|keeper| keeper.diagnostics));
        Ok(all)
    })?;
    Ok((kept, diagnostics))
}

/// A year's error as one of the scene's.
pub fn told(error: AnnualError) -> Error {
    match error {
        AnnualError::Content { path, error } => Error::in_file(path, &error),
        AnnualError::Setting { name, problem } => Error::setting(name, problem),
    }
}
