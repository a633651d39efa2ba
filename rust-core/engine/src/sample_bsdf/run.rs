//! A measurement from the scene to its reading.

use super::{
    Options, SampleReading, Side, Stop, Window,
    incident::{Incident, add_batch},
    place::{Place, box_in},
    reading::FromPatch,
    repeat::repeated,
    tally::{InOrder, Sum, Tally},
};
use crate::{
    compile::{Bounds, CompiledScene, compile, transport},
    error::{Diagnostic, Error, Result},
    goniometer::{Frame, Value},
    light_paths::{Channels, Estimate, Job, Watch, trace_batches},
    scene::{Origin, Scene, Settings},
    transport::{Arriving, Emission, LIGHT_BATCH, LightTracer, RayTable, Statistics, Transport, Wanted},
};
use gonio_simd::Execution;
use rayon::prelude::*;
use std::{
    sync::atomic::AtomicBool,
    time::{Duration, Instant},
};

/// Scatterings of a path; those that go on longer are told as cut off. More than that no path can count.
const MOST_BOUNCES: u32 = 256;
/// Share of the light that is too much to be lost sideways unsaid.
const MUCH_LOST: f64 = 0.01;
/// Share of the light that is too much to be cut off unsaid.
const MUCH_CUT: f64 = 1e-3;
/// More than all of the light, beyond any noise.
const TOO_MUCH: f64 = 1.01;

/// How far a measurement is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Rays traced.
    pub paths: u64,
    /// The most there may be.
    pub most: u64,
    /// The greatest error of an incident patch, once it is known.
    pub error: Option<f64>,
    /// Time since the start.
    pub elapsed: Duration,
}

/// Measures a sample: a scene that holds it and nothing else. `progress` is told how far it is, now and then; false ends it.
///
/// # Errors
/// No geometry; options out of their ranges; what compiling finds; cancellation.
pub fn measure(
    scene: &Scene,
    options: &Options,
    execution: Execution,
    cancel: &AtomicBool,
    progress: &mut dyn FnMut(&Progress) -> bool,
) -> Result<SampleReading> {
    let start = Instant::now();
    options.stop.checked()?;
    if options.sides == [false; 2] {
        return Err(Error::setting("sides", "neither front nor back was asked for"));
    }
    let frame = options.orientation.frame()?;
    let window = window(scene, options, &frame)?;
    let mut diagnostics = Vec::new();
    let scene = repeated(&dark(scene, &mut diagnostics), &frame, &window, options.repeats)?;
    let compiled = compile(&scene, None, cancel)?;
    diagnostics.extend(compiled.diagnostics.iter().cloned());
    if !compiled.tables.lights.is_empty() {
        let problem = "some of its surfaces shine; that light is not counted";
        diagnostics.push(Diagnostic::warning(&Origin::new("sample"), problem.to_owned()));
    }
    let place = Place::new(frame, window, box_in(&frame, &compiled.bounds), compiled.tables.origin)?;
    let incident = incident(options);
    let tally = Tally::new(&place, &options.basis, incident.len(), options.stop.batches() * LIGHT_BATCH as u64);
    let mut run = Run::new(options, &place, &tally, &incident, start);
    run.trace(&compiled, &unlimited(&compiled, options, execution), cancel, progress)?;
    let mut reading = run.reading(frame, window);
    reading.diagnostics = diagnostics;
    report(&mut reading);
    Ok(reading)
}

/// The part that light falls on.
fn window(scene: &Scene, options: &Options, frame: &Frame) -> Result<Window> {
    let bounds = Bounds::of_scene(scene);
    if bounds.is_empty() {
        return Err(Error::setting("sample", "it has no geometry"));
    }
    let bounds = box_in(frame, &bounds);
    let [min, max] = [bounds.min, bounds.max].map(|[x, y, _]| [x, y]);
    match options.window {
        Some(window) => window.checked(),
        None => Window { min, max }.checked().map_err(|_| {
            let [width, height] = [0, 1].map(|k| max[k] - min[k]);
            Error::setting("sample", format!("seen from its front it is {width} × {height} m large; does the front look that way?"))
        }),
    }
}

/// The scene without lights, and what a picture needs.
fn dark(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Scene {
    if let Some(first) = scene.lights.first() {
        let more = scene.lights.len() - 1;
        let others = if more > 0 { format!(" and {more} more") } else { String::new() };
        diagnostics.push(Diagnostic::warning(&first.origin, format!("this light{others} is no part of a sample and is left out")));
    }
    Scene { lights: Vec::new(), cameras: Vec::new(), meters: Vec::new(), grids: Vec::new(), ..scene.clone() }
}

/// The transport of measurements: nothing is clamped, and paths go as far as they can.
fn unlimited(compiled: &CompiledScene, options: &Options, execution: Execution) -> Transport {
    let settings = Settings { max_bounces: MOST_BOUNCES, seed: options.seed, aovs: Vec::new(), ..Settings::default() };
    transport(compiled, &settings, execution, [0.0; 3], [0.0, 0.0, -1.0])
}

/// Incident patches, those of the front first.
fn incident(options: &Options) -> Vec<Incident> {
    let sides = [true, false].into_iter().zip(options.sides).filter(|(_, wanted)| *wanted);
    sides.flat_map(|(from_front, _)| (0..options.basis.count()).map(move |patch| Incident { patch, from_front })).collect()
}

/// A measurement under way.
struct Run<'a> {
    options: &'a Options,
    place: &'a Place,
    tally: &'a Tally<'a>,
    incident: &'a [Incident],
    /// Batches of each incident patch.
    batches: Vec<u64>,
    /// The next batch's number is this one or greater.
    number: u64,
    start: Instant,
    statistics: Statistics,
    converged: bool,
}

impl<'a> Run<'a> {
    fn new(options: &'a Options, place: &'a Place, tally: &'a Tally<'a>, incident: &'a [Incident], start: Instant) -> Self {
        let batches = vec![0; incident.len()];
        Self { options, place, tally, incident, batches, number: 0, start, statistics: Statistics::default(), converged: false }
    }

    /// Traces until the rule says that it is enough for every patch; those that have enough are left alone.
    fn trace(
        &mut self,
        scene: &CompiledScene,
        transport: &Transport,
        cancel: &AtomicBool,
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<()> {
        let stop = &self.options.stop;
        let deadline = stop.time.and_then(|time| self.start.checked_add(time));
        let mut open: Vec<usize> = (0..self.incident.len()).collect();
        let (mut done, mut error) = (0, None);
        while !open.is_empty() && done < stop.batches() {
            let next = stop.next(done);
            for batch in done..next {
                let (before, most) = (self.paths(), stop.batches() * self.incident.len() as u64 * LIGHT_BATCH as u64);
                let start = self.start;
                let mut tell = |more: u64| {
                    let paths = before + more * LIGHT_BATCH as u64;
                    progress(&Progress { paths, most, error, elapsed: start.elapsed() })
                };
                // Without the first two batches nothing would be known.
                let deadline = deadline.filter(|_| batch >= 2);
                let traced = self.trace_one(scene, transport, &open, batch, deadline, &mut Watch { cancel, progress: &mut tell })?;
                if traced < open.len() {
                    return Ok(());
                }
            }
            done = next;
            let errors = open.iter().map(|incident| self.error(*incident));
            error = Some(errors.fold(0.0, f64::max));
            open.retain(|incident| stop.error == 0.0 || self.error(*incident) > stop.error);
        }
        self.converged = open.is_empty();
        Ok(())
    }

    /// Traces a batch of each of some incident patches; gives how many of them it came to.
    fn trace_one(
        &mut self,
        scene: &CompiledScene,
        transport: &Transport,
        order: &[usize],
        batch: u64,
        deadline: Option<Instant>,
        watch: &mut Watch<'_>,
    ) -> Result<usize> {
        let table = self.table(order, batch);
        let wanted = Wanted { arrivals: Arriving::No, specular_first: false, picture: None };
        let tracer = LightTracer { tables: &scene.tables, transport, emission: Emission::Rays(&table), wanted };
        let job = Job { scene, tracer: &tracer, threads: self.options.threads, deadline };
        // Numbers tell which rays of the table a batch takes: the first one is a multiple of the table's batches.
        let count = order.len() as u64;
        let first = self.number.next_multiple_of(count);
        self.number = first + count;
        let (traced, statistics) = trace_batches(&job, first..first + count, &InOrder { tally: self.tally, order }, watch)?;
        self.statistics.add(&statistics);
        order.iter().take(traced as usize).for_each(|incident| self.batches[*incident] += 1);
        Ok(traced as usize)
    }

    /// The rays of a batch of each of some incident patches, in their order.
    fn table(&self, order: &[usize], batch: u64) -> RayTable {
        let one = |incident: &usize| {
            let mut table = RayTable::default();
            add_batch(&mut table, self.place, &self.options.basis, self.incident[*incident], batch, self.options.seed);
            table
        };
        let parts: Vec<RayTable> = order.par_iter().map(one).collect();
        let joined = |column: fn(&RayTable) -> &[Vec<f32>; 3]| {
            [0, 1, 2].map(|k| parts.iter().flat_map(|part| &column(part)[k]).copied().collect::<Vec<f32>>())
        };
        RayTable { origin: joined(|table| &table.origin), direction: joined(|table| &table.direction), flux: joined(|table| &table.flux) }
    }

    fn paths(&self) -> u64 {
        self.batches.iter().sum::<u64>() * LIGHT_BATCH as u64
    }

    fn share(&self, incident: usize, to_front: bool, patch: usize) -> Estimate {
        self.tally.share(incident, to_front, patch, self.batches[incident])
    }

    fn error(&self, incident: usize) -> f64 {
        let patches = self.options.basis.count();
        Stop::error_of((0..2 * patches).map(|cell| {
            let share = self.share(incident, cell < patches, cell % patches);
            [share.luminance(), share.variance]
        }))
    }

    fn reading(&self, frame: Frame, window: Window) -> SampleReading {
        let patches = self.options.basis.count();
        SampleReading {
            basis: self.options.basis.clone(),
            colour: self.options.colour,
            frame,
            window,
            body: SampleReading::body(self.place),
            sides: (0..self.incident.len()).step_by(patches).map(|first| self.side(first..first + patches)).collect(),
            paths: self.paths(),
            elapsed: self.start.elapsed(),
            converged: self.converged,
            statistics: self.statistics,
            diagnostics: Vec::new(),
        }
    }

    fn side(&self, range: std::ops::Range<usize>) -> Side {
        let from_front = self.incident[range.start].from_front;
        let all = |to_front: bool| -> (Vec<Channels>, Vec<f64>) {
            let patches = 0..self.options.basis.count();
            let shares = range.clone().flat_map(|incident| patches.clone().map(move |patch| self.share(incident, to_front, patch)));
            shares.map(|share| (share.mean, share.error())).unzip()
        };
        let ((reflected, reflected_errors), (transmitted, transmitted_errors)) = (all(from_front), all(!from_front));
        let from = range.map(|incident| self.found(incident)).collect();
        Side { from_front, from, reflected, transmitted, reflected_errors, transmitted_errors }
    }

    fn found(&self, incident: usize) -> FromPatch {
        let sum = |sum: Sum| {
            let found = self.tally.sum(incident, sum, self.batches[incident]);
            Value { value: found.luminance(), error: found.error() }
        };
        let [reflected, transmitted] =
            if self.incident[incident].from_front { [Sum::Front, Sum::Back] } else { [Sum::Back, Sum::Front] }.map(sum);
        FromPatch {
            reflected,
            transmitted,
            lost: sum(Sum::Lost),
            cut_off: sum(Sum::CutOff),
            absorbed: sum(Sum::Absorbed),
            rays: self.batches[incident] * LIGHT_BATCH as u64,
            error: self.error(incident),
        }
    }
}

/// Says where light is lost that should not be, and where it comes from nothing.
fn report(reading: &mut SampleReading) {
    let mut problems = Vec::new();
    for side in &reading.sides {
        let name = if side.from_front { "front" } else { "back" };
        let most = |of: fn(&FromPatch) -> f64| {
            let found = side.from.iter().enumerate().max_by(|a, b| of(a.1).total_cmp(&of(b.1)));
            found.map_or((0, 0.0), |(patch, from)| (patch + 1, of(from)))
        };
        let lost = reading.of_diffuse(side, |from| from.lost).value;
        if lost > MUCH_LOST {
            let (patch, worst) = most(|from| from.lost.value);
            problems.push(format!(
                "{:.1} % of diffuse light from the {name} leaves sideways, {:.0} % of that from patch {patch}: let the sample go on beyond the window",
                100.0 * lost,
                100.0 * worst
            ));
        }
        let (patch, cut_off) = most(|from| from.cut_off.value);
        if cut_off > MUCH_CUT {
            problems.push(format!(
                "{:.2} % of the light from the {name}'s patch {patch} was still under way after {MOST_BOUNCES} surfaces and is cut off",
                100.0 * cut_off
            ));
        }
        let (patch, left) = most(|from| from.reflected.value + from.transmitted.value);
        if left > TOO_MUCH {
            problems
                .push(format!("{left:.3} of the light from the {name}'s patch {patch} leaves the sample; it is scaled down to all of it"));
        }
    }
    let origin = Origin::new("sample");
    reading.diagnostics.extend(problems.into_iter().map(|problem| Diagnostic::warning(&origin, problem)));
}
