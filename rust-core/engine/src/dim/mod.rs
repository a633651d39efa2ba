//! The dimming of a scene's light groups that meets lighting targets: what each group brings to the points, measured, and `gonio_dimming`'s program over it.

mod asked;
mod contributions;
mod groups;

pub use groups::{LightGroup, PowerSource};

use crate::{
    error::{Diagnostic, Error, Result},
    measure::Watch,
    scene::Scene,
};
use asked::Asked;
use contributions::Run;
use gonio_dimming::{Area, DimmingError, Problem, Solution};
use gonio_simd::Execution;
use serde_json::{Value, json};

/// What is sought among the levels that meet the targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Near {
    /// The least power.
    #[default]
    LeastPower,
    /// Levels as alike as may be.
    Equal,
    /// Levels near these, by group.
    Levels(Vec<(String, f64)>),
}

/// What is asked of a scene that has meters and grids.
#[derive(Clone, Debug)]
pub struct DimTask<'a> {
    /// Targets as `gonio_dimming::Target::parse` reads them.
    pub targets: &'a [String],
    /// Power of groups at level 1, W.
    pub watts: &'a [(String, f64)],
    /// Groups that keep a level.
    pub fixed: &'a [(String, f64)],
    /// The least level of all others.
    pub min_level: f64,
    /// What is sought beyond the targets.
    pub near: Near,
    /// Standard errors to keep from each limit.
    pub errors_kept: f64,
}

/// Groups with what was measured of them, and the levels that were found.
#[derive(Debug)]
pub struct Dimming {
    /// The scene's groups.
    pub groups: Vec<LightGroup>,
    /// Where light was measured, and what it gets of each group.
    pub areas: Vec<Area>,
    /// The levels, and what they make of the targets.
    pub solution: Solution,
    /// What to know of the groups.
    pub notes: Vec<String>,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

/// Measures each group, and solves.
///
/// # Errors
/// A scene without light groups, targets that are none or name nothing that is measured, numbers out of range, what measuring finds, cancellation.
pub fn dim(scene: &Scene, task: &DimTask<'_>, execution: Execution, watch: &mut Watch<'_>) -> Result<Dimming> {
    let (mut told_first, mut notes) = (Vec::new(), Vec::new());
    let groups = LightGroup::all(task, scene, &mut told_first, &mut notes)?;
    let asked = Asked::new(task, scene, &groups)?;
    let mut run = Run::new(execution, watch, 1 + groups.len() + usize::from(!asked.glare.is_empty()), told_first);
    let areas = contributions::measured(&mut run, scene, &groups, &asked)?;
    let problem = Problem {
        groups: groups.iter().map(|group| group.group.clone()).collect(),
        areas,
        targets: asked.light.clone(),
        goal: asked.goal.clone(),
        errors_kept: task.errors_kept,
    };
    let mut solution = problem.solve().map_err(|error| told("target", error))?;
    solution.targets.extend(contributions::glare(&mut run, scene, (&groups, &solution.levels), &asked)?);
    Ok(Dimming { diagnostics: run.told, areas: problem.areas, groups, solution, notes })
}

impl Dimming {
    /// Power of all groups at level 1, W.
    pub fn watts_full(&self) -> f64 {
        self.groups.iter().map(|group| group.group.watts).sum()
    }

    /// Groups, targets, power, and what each point gets of each group at level 1; `docs/dimming.md` lists the keys.
    pub fn json(&self) -> Value {
        let group = |(light, level): (&LightGroup, &f64)| {
            let LightGroup { group, source, prims, .. } = light;
            json!({
                "name": group.name,
                "level": level,
                "watts": group.watts * level,
                "watts_full": group.watts,
                "watts_from": source.name(),
                "range": group.range,
                "lights": prims,
            })
        };
        let point = |point: &gonio_dimming::Point| json!({ "fixed": point.fixed, "groups": point.of_groups });
        let area = |area: &Area| {
            let mut found = json!({ "name": area.name, "points": area.points.iter().map(point).collect::<Vec<_>>() });
            if !area.colours.is_empty() {
                found["colours"] = json!(area.colours);
            }
            found
        };
        json!({
            "groups": self.groups.iter().zip(&self.solution.levels).map(group).collect::<Vec<_>>(),
            "targets": self.solution.targets,
            "watts": self.solution.watts,
            "watts_full": self.watts_full(),
            "areas": self.areas.iter().map(area).collect::<Vec<_>>(),
        })
    }
}

/// A dimming's error as that of a setting.
fn told(setting: &str, error: DimmingError) -> Error {
    match error {
        DimmingError::Solver(problem) => Error::Internal(problem),
        other => Error::setting(setting, other.to_string()),
    }
}
