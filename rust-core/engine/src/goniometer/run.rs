//! A measurement from the scene to its reading.

use super::{
    Options, Product, Progress, Reading, angles::Cells, reading::Fluxes, rounds::Run, screen::ScreenPlane, shining::Sources, sources,
    tally::Instrument,
};
use crate::{
    compile::{CompiledScene, compile, transport, unfollowed},
    error::{Diagnostic, Result},
    scene::{Origin, Scene, Settings, Transform},
    transport::Transport,
};
use gonio_simd::Execution;
use std::{sync::atomic::AtomicBool, time::Instant};

/// Scatterings of a path; those that go on longer are told as cut off. More than that no path can count.
const MOST_BOUNCES: u32 = 256;
/// Share of the sources' flux below which a luminaire counts as closed.
const CLOSED: f64 = 1e-3;
/// Standard errors that noise does not reach, and the share of the flux that rounding is.
const NOISE: f64 = 5.0;
const TINY: f64 = 1e-5;
/// Share of the sources' flux that is too much to be cut off unsaid.
const MUCH: f64 = 1e-3;

/// Measures what lights up in a scene, which holds the luminaire and nothing else. `progress` is told how far it is, now and then; false ends
/// it.
///
/// # Errors
/// No light within, or light that is taken away; options out of their ranges; what compiling finds; cancellation.
pub fn measure(
    scene: &Scene,
    options: &Options,
    execution: Execution,
    cancel: &AtomicBool,
    progress: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Reading> {
    let start = Instant::now();
    let options = Options { angles: options.angles.clone().checked()?, ..options.clone() };
    options.stop.checked()?;
    options.screen.as_ref().map_or(Ok(()), |screen| screen.checked())?;
    let mut diagnostics = Vec::new();
    let scene = sources::luminaire(scene, &mut diagnostics)?;
    let compiled = compile(&scene, None, cancel)?;
    diagnostics.extend(compiled.diagnostics.iter().cloned());
    diagnostics.extend(unfollowed(&scene, &compiled.tables));
    let bounds = sources::bounds(&scene, &options.rays, &Transform::IDENTITY);
    let body = sources::bounds(&scene, &options.rays, &options.frame.from_world());
    let sources = Sources::new(&compiled, &bounds, &options, &mut diagnostics)?;
    let instrument = Instrument {
        frame: options.frame,
        origin: [0, 1, 2].map(|k| options.frame.origin[k] - compiled.tables.origin[k]),
        cells: Cells::new(&options.angles),
        screen: options.screen.as_ref().map(|screen| ScreenPlane::new(screen, &options.frame)),
        rebased: compiled.tables.origin,
        execution,
    };
    let mut run = Run::new(&options, &instrument, &sources, start);
    run.trace(&compiled, &unlimited(&compiled, &options, execution), cancel, progress)?;
    let mut reading = run.reading(&body)?;
    reading.diagnostics = diagnostics;
    reading.product = Product::of(&scene, &options.frame.from_world());
    report_losses(&mut reading);
    reading.fluxes = reading.fluxes.bounded();
    Ok(reading)
}

/// The transport of measurements: nothing is clamped, and paths go as far as they can.
fn unlimited(compiled: &CompiledScene, options: &Options, execution: Execution) -> Transport {
    let settings = Settings { max_bounces: MOST_BOUNCES, seed: options.seed, aovs: Vec::new(), ..Settings::default() };
    transport(compiled, &settings, execution, [0.0; 3], [0.0, 0.0, -1.0])
}

/// Says where light is lost that should not be.
fn report_losses(reading: &mut Reading) {
    let Fluxes { emitted, escaped, absorbed, cut_off, .. } = reading.fluxes;
    let mut warn = |message: String| reading.diagnostics.push(Diagnostic::warning(&Origin::new("luminaire"), message));
    if escaped.value <= CLOSED * emitted.value {
        let [lost, all] = [absorbed.value, emitted.value];
        warn(format!("{lost:.1} of {all:.1} lm never leave: sources are inside solids, or the luminaire is closed"));
    }
    if -absorbed.value > NOISE * absorbed.error + TINY * emitted.value {
        let [more, error] = [-absorbed.value, absorbed.error];
        warn(format!("{more:.2} ± {error:.2} lm more leave than the sources send: a surface or a solid sends back more than it gets"));
    }
    if cut_off.value > MUCH * emitted.value {
        let lost = cut_off.value;
        warn(format!("{lost:.1} lm were still under way after {MOST_BOUNCES} surfaces and are cut off"));
    }
}
