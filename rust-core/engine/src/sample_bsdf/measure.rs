//! A measurement from the scene to its reading.

use super::{
    Options, Progress, SampleReading, Window,
    incident::Incident,
    place::{Place, box_in},
    reading::FromPatch,
    repeat::repeated,
    run::Run,
    tally::Tally,
};
use crate::{
    compile::{Bounds, CompiledScene, compile, transport},
    error::{Diagnostic, Error, Result},
    goniometer::Frame,
    scene::{Origin, Scene, Settings},
    transport::{LIGHT_BATCH, Transport},
};
use gonio_simd::Execution;
use std::{sync::atomic::AtomicBool, time::Instant};

/// Scatterings of a path; those that go on longer are told as cut off. More than that no path can count.
const MOST_BOUNCES: u32 = 256;
/// Share of the light that is too much to be lost sideways unsaid.
const MUCH_LOST: f64 = 0.01;
/// Share of the light that is too much to be cut off unsaid.
const MUCH_CUT: f64 = 1e-3;
/// More than all of the light, beyond any noise.
const TOO_MUCH: f64 = 1.01;

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
                "{:.1} % of diffuse light from the {name} leaves sideways, most of patch {patch}'s ({:.0} %): let the sample go on farther",
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
