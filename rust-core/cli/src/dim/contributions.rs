//! What each group brings to the points: one measurement a group, with all other light put out.

use super::{asked::Asked, groups::LightGroup, told::told};
use crate::{
    arguments::MeasuringArguments,
    measure::evaluated,
    messages::{say, tell},
    progress::Reporter,
};
use gonio::{
    Diagnostic, Error, Result,
    compile::{CompiledScene, compile},
    measure::{Measurements, Reading},
    scene::{Measurand, Scene},
};
use gonio_dimming::{Area, Estimate, Point, Problem, Reached};
use std::sync::atomic::AtomicBool;

/// The readings of what is measured, by its name.
type Named = (String, Vec<Reading>);

/// What a measurement takes beside the scene.
struct Run<'a> {
    options: &'a MeasuringArguments,
    compiled: CompiledScene,
    interrupted: &'a AtomicBool,
    told: Vec<Diagnostic>,
}

impl Run<'_> {
    /// The readings of all points that the scene measures, meters first, each by name, and what is not as asked for.
    fn readings(&self, scene: &Scene) -> Result<(Vec<Named>, Vec<Diagnostic>)> {
        let found = evaluated(scene, Some(&self.compiled), Reporter::new(self.options.quiet), self.interrupted)?;
        Ok((by_name(&found), found.diagnostics))
    }

    /// Lists what was not told before.
    fn tell(&mut self, diagnostics: Vec<Diagnostic>) {
        let new: Vec<Diagnostic> = diagnostics.into_iter().filter(|one| !self.told.contains(one)).collect();
        tell(&self.options.stage, self.options.quiet, &new);
        self.told.extend(new);
    }
}

fn by_name(found: &Measurements) -> Vec<Named> {
    let meters = found.meters.iter().map(|meter| (meter.meter.origin.name.to_string(), vec![meter.reading]));
    let grids = found.grids.iter().map(|grid| {
        let readings = grid.points.iter().flatten().map(|(_, reading)| *reading).collect();
        (grid.origin.name.to_string(), readings)
    });
    meters.chain(grids).collect()
}

/// What the points that targets of light name get of each group and of all other light. Runs have seeds of their own, so that their errors are
/// independent.
pub(super) fn measured(
    options: &MeasuringArguments,
    scene: &mut Scene,
    groups: &[LightGroup],
    asked: &Asked,
    interrupted: &AtomicBool,
) -> Result<Vec<Area>> {
    let mut only = scene.clone();
    only.meters.retain(|meter| meter.measurand != Measurand::Ugr && asked.names_light(&meter.origin.name));
    only.grids.retain(|grid| grid.measurand != Measurand::Ugr && asked.names_light(&grid.origin.name));
    let mut run = Run { options, compiled: compile(&only, None, interrupted)?, interrupted, told: Vec::new() };
    run.tell(run.compiled.diagnostics.clone());
    let strengths: Vec<f32> = only.lights.iter().map(|light| light.dimming).collect();
    for light in groups.iter().flat_map(|group| &group.lights) {
        only.lights[*light].dimming = 0.0;
    }
    // A scene whose lamps are out has other things to be told than the one that was asked for.
    let (fixed, _) = run.readings(&only)?;
    only = only.without_emission();
    only.lights.iter_mut().for_each(|light| light.dimming = 0.0);
    let mut of_groups = Vec::new();
    for group in groups {
        only.settings.seed = only.settings.seed.wrapping_add(1);
        group.lights.iter().for_each(|light| only.lights[*light].dimming = strengths[*light]);
        let (readings, diagnostics) = run.readings(&only)?;
        run.tell(diagnostics);
        of_groups.push(readings);
        group.lights.iter().for_each(|light| only.lights[*light].dimming = 0.0);
    }
    fixed.into_iter().enumerate().map(|(number, (name, fixed))| area(name, &fixed, number, &of_groups)).collect()
}

/// An area's points, those left out that have no figure in one of the runs.
fn area(name: String, fixed: &[Reading], number: usize, of_groups: &[Vec<Named>]) -> Result<Area> {
    let reading = |group: &Vec<Named>, point: usize| group.get(number).and_then(|(_, readings)| readings.get(point)).copied();
    let point = |(point, fixed): (usize, &Reading)| {
        let of_groups = of_groups.iter().map(|group| reading(group, point)).collect::<Option<Vec<_>>>()?;
        let is_known = fixed.is_known() && of_groups.iter().all(Reading::is_known);
        is_known.then(|| Point { fixed: estimate(fixed), of_groups: of_groups.iter().map(estimate).collect() })
    };
    let points: Vec<Point> = fixed.iter().enumerate().filter_map(point).collect();
    if points.is_empty() {
        return Err(Error::setting("target", format!("{name}: none of its points could be measured")));
    }
    if points.len() < fixed.len() {
        say(&format!("warning: {name}: {} of {} points could not be measured and do not count", fixed.len() - points.len(), fixed.len()));
    }
    Ok(Area { name, points })
}

fn estimate(reading: &Reading) -> Estimate {
    Estimate::new(reading.value, reading.standard_error)
}

/// What the targets of glare come to at levels that are found; each group's lights with its level.
pub(super) fn glare(
    options: &MeasuringArguments,
    scene: &mut Scene,
    (groups, levels): (&[Vec<usize>], &[f64]),
    asked: &Asked,
    interrupted: &AtomicBool,
) -> Result<Vec<Reached>> {
    if asked.glare.is_empty() {
        return Ok(Vec::new());
    }
    scene.meters.retain(|meter| meter.measurand == Measurand::Ugr && asked.names_glare(&meter.origin.name));
    scene.grids.retain(|grid| grid.measurand == Measurand::Ugr && asked.names_glare(&grid.origin.name));
    for (lights, level) in groups.iter().zip(levels) {
        lights.iter().for_each(|light| scene.lights[*light].dimming *= *level as f32);
    }
    let found = evaluated(scene, None, Reporter::new(options.quiet), interrupted)?;
    let area = |(name, readings): Named| Area {
        name,
        points: readings.iter().map(|reading| Point { fixed: estimate(reading), of_groups: Vec::new() }).collect(),
    };
    let areas = by_name(&found).into_iter().map(area).collect();
    let rated = Problem { groups: Vec::new(), areas, targets: asked.glare.clone(), goal: asked.goal.clone(), errors_kept: 0.0 };
    Ok(rated.at(Vec::new()).map_err(|error| told("target", error))?.targets)
}
