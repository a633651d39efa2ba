//! What each group brings to the points: one measurement a group, with all other light put out.

use super::{asked::Asked, groups::LightGroup, told};
use crate::{
    compile::{CompiledScene, compile},
    error::{Diagnostic, Error, Result},
    measure::{ColourReading, Measurements, Reading, Watch, measure},
    render::Progress,
    scene::{Grid, Measurand, Meter, Origin, Scene},
};
use gonio_dimming::{Area, Colour, Estimate, Light, Point, Problem, Reached};
use gonio_simd::Execution;
use std::{sync::Arc, time::Instant};

/// The readings of what is measured, by its name, and the colours of the light where they are wanted.
#[derive(Clone, Debug)]
struct Named {
    name: String,
    readings: Vec<Reading>,
    colours: Vec<Arc<ColourReading>>,
}

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
    let meters = found.meters.iter().map(|meter| (&meter.meter.origin.name, vec![meter.reading], meter.colour.iter().cloned().collect()));
    // Eyes count one by one: so the mean is that of the points' means, and the least that of the least eye.
    let grids = found.grids.iter().map(|grid| (&grid.origin.name, grid.readings(), grid.colours.clone()));
    let mut all: Vec<Named> = Vec::new();
    for (name, readings, colours) in meters.chain(grids) {
        let known = all.iter_mut().find(|known| known.name == **name && known.colours.is_empty());
        match known.filter(|_| !colours.is_empty()) {
            Some(known) => known.colours = colours,
            None if colours.is_empty() => all.push(Named { name: name.to_string(), readings, colours }),
            // A temperature is no amount.
            None => {
                let readings = colours.iter().map(|colour: &Arc<ColourReading>| colour.illuminance).collect();
                all.push(Named { name: name.to_string(), readings, colours });
            }
        }
    }
    all
}

/// Measures the colour of the light too where targets want it.
fn with_colours(scene: &mut Scene, asked: &Asked) {
    let meters = scene.meters.iter().filter(|meter| meter.measurand != Measurand::Cct && asked.names_colour(&meter.origin.name));
    let meters: Vec<Meter> = meters.map(|meter| Meter { measurand: Measurand::Cct, ..meter.clone() }).collect();
    let grids = scene.grids.iter().filter(|grid| grid.measurand != Measurand::Cct && asked.names_colour(&grid.origin.name));
    let grids: Vec<Grid> = grids.map(|grid| Grid { measurand: Measurand::Cct, ..grid.clone() }).collect();
    scene.meters.extend(meters);
    scene.grids.extend(grids);
}

/// What the points that targets of light name get of each group and of all other light. Runs have seeds of their own, so that their errors are
/// independent.
pub(super) fn measured(run: &mut Run<'_, '_>, scene: &Scene, groups: &[LightGroup], asked: &Asked) -> Result<Vec<Area>> {
    let mut only = scene.clone();
    only.meters.retain(|meter| meter.measurand != Measurand::Ugr && asked.names_light(&meter.origin.name));
    only.grids.retain(|grid| grid.measurand != Measurand::Ugr && asked.names_light(&grid.origin.name));
    with_colours(&mut only, asked);
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
    fixed.into_iter().enumerate().map(|(number, fixed)| area(run, fixed, number, &of_groups)).collect()
}

/// An area's points, those left out that have no figure in one of the runs.
fn area(run: &mut Run<'_, '_>, fixed: Named, number: usize, of_groups: &[Vec<Named>]) -> Result<Area> {
    let reading = |group: &Vec<Named>, point: usize| group.get(number).and_then(|named| named.readings.get(point)).copied();
    let point = |(point, fixed): (usize, &Reading)| {
        let of_groups = of_groups.iter().map(|group| reading(group, point)).collect::<Option<Vec<_>>>()?;
        let is_known = fixed.is_known() && of_groups.iter().all(Reading::is_known);
        is_known.then(|| Point { fixed: estimate(fixed), of_groups: of_groups.iter().map(estimate).collect() })
    };
    let light = |named: &Named, point: usize| named.colours.get(point).map(|colour| light(colour));
    let colour = |point: usize| {
        let of_groups = of_groups.iter().map(|group| light(group.get(number)?, point)).collect::<Option<Vec<_>>>()?;
        let colour = Colour { fixed: light(&fixed, point)?, of_groups };
        let is_known = colour.of_groups.iter().chain([&colour.fixed]).all(|light| !light.lux.value.is_nan());
        is_known.then_some(colour)
    };
    let colours = (0..fixed.readings.len()).filter_map(colour).collect();
    let points: Vec<Point> = fixed.readings.iter().enumerate().filter_map(point).collect();
    let Named { name, readings: fixed, .. } = fixed;
    if points.is_empty() {
        return Err(Error::setting("target", format!("{name}: none of its points could be measured")));
    }
    if points.len() < fixed.len() {
        let (lost, count) = (fixed.len() - points.len(), fixed.len());
        run.told
            .push(Diagnostic::warning(&Origin::new(&*name), format!("{lost} of {count} points could not be measured and do not count")));
    }
    Ok(Area { name, points, colours })
}

fn estimate(reading: &Reading) -> Estimate {
    Estimate::new(reading.value, reading.standard_error)
}

/// Light with its colour; of none where nothing arrives.
fn light(colour: &ColourReading) -> Light {
    let lux = estimate(&colour.illuminance);
    let over_y = |part: fn([f64; 2]) -> f64| colour.figure(|figures| Some(part(figures.xy) / figures.xy[1]));
    let [x, z] =
        [over_y(|[x, _]| x), over_y(|[x, y]| 1.0 - x - y)].map(|reading| reading.as_ref().map_or_else(Estimate::default, estimate));
    Light { lux, x, z }
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
    let area = |Named { name, readings, .. }: Named| Area {
        name,
        colours: Vec::new(),
        points: readings.iter().map(|reading| Point { fixed: estimate(reading), of_groups: Vec::new() }).collect(),
    };
    let areas = found.into_iter().map(area).collect();
    let rated = Problem { groups: Vec::new(), areas, targets: asked.glare.clone(), goal: asked.goal.clone(), errors_kept: 0.0 };
    Ok(rated.at(Vec::new()).map_err(|error| told("target", error))?.targets)
}
