//! What each group brings to the points: one measurement a group, with all other light put out.

use super::{asked::Asked, groups::LightGroup, told};
use crate::{
    compile::{CompiledScene, compile},
    error::{Diagnostic, Error, Result},
    measure::{Measurements, Reading, Watch, measure},
    render::Progress,
    scene::{Measurand, Origin, Scene},
};
use gonio_dimming::{Area, Estimate, Point, Problem, Reached};
use gonio_simd::Execution;
use std::time::Instant;

/// The readings of what is measured, by its name.
type Named = (String, Vec<Reading>);

/// Measurements one after the other.
pub(super) struct Run<'a, 'b> {
    execution: Execution,
    watch: &'a mut Watch<'b>,
    /// How many there are in all, and are done.
    count: usize,
    done: usize,
    started: Instant,
    /// What is not as asked for.
    pub(super) told: Vec<Diagnostic>,
}

impl<'a, 'b> Run<'a, 'b> {
    pub(super) fn new(execution: Execution, watch: &'a mut Watch<'b>, count: usize, told: Vec<Diagnostic>) -> Self {
        Self { execution, watch, count, done: 0, started: Instant::now(), told }
    }

    /// The readings of all points that the scene measures, meters first, each by name, and what is not as asked for.
    fn readings(&mut self, scene: &Scene, compiled: Option<&CompiledScene>) -> Result<(Vec<Named>, Vec<Diagnostic>)> {
        let (done, count, started) = (self.done, self.count, self.started);
        let mut progress = |of_run: &Progress| (self.watch.progress)(&of_run.of_whole(done, count, started));
        let mut watch = Watch { previous: compiled, cancel: self.watch.cancel, progress: &mut progress };
        let found = measure(scene, self.execution, &mut watch)?;
        self.done += 1;
        Ok((by_name(&found), found.diagnostics))
    }

    /// Keeps what was not told before.
    fn tell(&mut self, diagnostics: &[Diagnostic]) {
        let new: Vec<Diagnostic> = diagnostics.iter().filter(|one| !self.told.contains(one)).cloned().collect();
        self.told.extend(new);
    }
}

fn by_name(found: &Measurements) -> Vec<Named> {
    let meters = found.meters.iter().map(|meter| (meter.meter.origin.name.to_string(), vec![meter.reading]));
    // Eyes count one by one: so the mean is that of the points' means, and the least that of the least eye.
    let grids = found.grids.iter().map(|grid| (grid.origin.name.to_string(), grid.readings()));
    meters.chain(grids).collect()
}

/// What the points that targets of light name get of each group and of all other light. Runs have seeds of their own, so that their errors are
/// independent.
pub(super) fn measured(run: &mut Run<'_, '_>, scene: &Scene, groups: &[LightGroup], asked: &Asked) -> Result<Vec<Area>> {
    let mut only = scene.clone();
    only.meters.retain(|meter| meter.measurand != Measurand::Ugr && asked.names_light(&meter.origin.name));
    only.grids.retain(|grid| grid.measurand != Measurand::Ugr && asked.names_light(&grid.origin.name));
    let compiled = compile(&only, run.watch.previous, run.watch.cancel)?;
    run.tell(&compiled.diagnostics);
    let strengths: Vec<f32> = only.lights.iter().map(|light| light.dimming).collect();
    for light in groups.iter().flat_map(|group| &group.lights) {
        only.lights[*light].dimming = 0.0;
    }
    // A scene whose lamps are out has other things to be told than the one that was asked for.
    let (fixed, _) = run.readings(&only, Some(&compiled))?;
    only = only.without_emission();
    only.lights.iter_mut().for_each(|light| light.dimming = 0.0);
    let mut of_groups = Vec::new();
    for group in groups {
        only.settings.seed = only.settings.seed.wrapping_add(1);
        group.lights.iter().for_each(|light| only.lights[*light].dimming = strengths[*light]);
        let (readings, diagnostics) = run.readings(&only, Some(&compiled))?;
        run.tell(&diagnostics);
        of_groups.push(readings);
        group.lights.iter().for_each(|light| only.lights[*light].dimming = 0.0);
    }
    fixed.into_iter().enumerate().map(|(number, (name, fixed))| area(run, (name, &fixed), number, &of_groups)).collect()
}

/// An area's points, those left out that have no figure in one of the runs.
fn area(run: &mut Run<'_, '_>, (name, fixed): (String, &[Reading]), number: usize, of_groups: &[Vec<Named>]) -> Result<Area> {
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
        let (lost, count) = (fixed.len() - points.len(), fixed.len());
        run.told
            .push(Diagnostic::warning(&Origin::new(&*name), format!("{lost} of {count} points could not be measured and do not count")));
    }
    Ok(Area { name, points })
}

fn estimate(reading: &Reading) -> Estimate {
    Estimate::new(reading.value, reading.standard_error)
}

/// What the targets of glare come to at levels that are found.
pub(super) fn glare(
    run: &mut Run<'_, '_>,
    scene: &Scene,
    (groups, levels): (&[LightGroup], &[f64]),
    asked: &Asked,
) -> Result<Vec<Reached>> {
    if asked.glare.is_empty() {
        return Ok(Vec::new());
    }
    let mut scene = scene.clone();
    scene.meters.retain(|meter| meter.measurand == Measurand::Ugr && asked.names_glare(&meter.origin.name));
    scene.grids.retain(|grid| grid.measurand == Measurand::Ugr && asked.names_glare(&grid.origin.name));
    for (group, level) in groups.iter().zip(levels) {
        group.lights.iter().for_each(|light| scene.lights[*light].dimming *= *level as f32);
    }
    let (found, diagnostics) = run.readings(&scene, None)?;
    run.tell(&diagnostics);
    let area = |(name, readings): Named| Area {
        name,
        points: readings.iter().map(|reading| Point { fixed: estimate(reading), of_groups: Vec::new() }).collect(),
    };
    let areas = found.into_iter().map(area).collect();
    let rated = Problem { groups: Vec::new(), areas, targets: asked.glare.clone(), goal: asked.goal.clone(), errors_kept: 0.0 };
    Ok(rated.at(Vec::new()).map_err(|error| told("target", error))?.targets)
}
