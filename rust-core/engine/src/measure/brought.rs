//! The light that light paths bring to meters: what mirrors and clear glass send on, counted on the meters' discs.

use super::{disc::Disc, discs::Discs, reading::Reading, sensing::Sensing, watch::Watch};
use crate::{
    colour::luminance,
    compile::{CompiledScene, transport},
    error::Result,
    light::EmissionSampler,
    light_paths::{self, Batch, BatchEstimates, Collector, Job, WorkerSums, next_round, trace_batches},
    render::Progress,
    transport::{Arrivals, Arriving, Emission, Escapes, LIGHT_BATCH, LightTracer, Receiver, Segments, Wanted},
};
use std::time::Instant;

/// Numbers of batches that neither splats nor photons use.
const FIRST_BATCH: u64 = 1 << 62;
/// Relative standard error that is good enough, and the part of the error that a meter has from its own paths.
const ENOUGH: f64 = 0.005;
const OF_OWN: f64 = 0.5;

/// What light paths start with, and what of them counts.
pub(super) struct Brought<'a> {
    pub(super) sampler: &'a EmissionSampler,
    /// All light that has been scattered in any way; else by mirrors and smooth glass alone.
    pub(super) whole: bool,
}

/// What light paths bring to each disc, lux, after at most as many batches as there are samples. `own` is what meters' own paths have found beside.
pub(super) fn brought(
    sensing: &Sensing<'_>,
    discs: &Discs,
    own: &[Reading],
    paths: &Brought<'_>,
    watch: &mut Watch<'_>,
) -> Result<Vec<Reading>> {
    let Sensing { settings, execution, effort, .. } = *sensing;
    let scene: &CompiledScene = sensing.scene;
    let Brought { sampler, whole } = *paths;
    if discs.is_empty() {
        return Ok(vec![Reading::default(); own.len()]);
    }
    let start = Instant::now();
    let transport = transport(scene, settings, execution, [0.0; 3], [0.0, 0.0, -1.0]);
    let wanted = Wanted { arrivals: Arriving::No, specular_only: !whole, picture: None };
    let tracer = LightTracer { tables: &scene.tables, transport: &transport, emission: Emission::Lights(sampler), wanted };
    let most = effort.most_batches(settings.samples);
    let power = sampler.total_power();
    let crossings = Crossings { discs, fluxes: BatchEstimates::new(own.len(), power, most * LIGHT_BATCH as u64) };
    let job = Job { scene, tracer: &tracer, threads: settings.threads, deadline: None };
    let mut done = 0;
    loop {
        let end = next_round(done, effort.first_look, most);
        let mut progress = |traced: u64| {
            let fraction = (done + traced) as f64 / most as f64;
            let samples_total = settings.samples;
            let samples = (fraction * f64::from(samples_total)) as u32;
            let rays = (done + traced) * LIGHT_BATCH as u64;
            (watch.progress)(&Progress { fraction, samples, samples_total, elapsed: start.elapsed(), remaining: None, rays })
        };
        let mut part = light_paths::Watch { cancel: watch.cancel, progress: &mut progress };
        let first = FIRST_BATCH | u64::from(whole) << 61;
        trace_batches(&job, first + done..first + end, &crossings, &mut part)?;
        done = end;
        let readings: Vec<Reading> = (0..own.len()).map(|meter| crossings.reading(meter, done, luminance(power))).collect();
        if done >= most || readings.iter().zip(own).all(|(brought, own)| is_enough(brought, own)) {
            return Ok(readings);
        }
    }
}

/// Whether more light paths would not tell more.
fn is_enough(brought: &Reading, own: &Reading) -> bool {
    brought.standard_error <= (ENOUGH * (own.value + brought.value).abs()).max(OF_OWN * own.standard_error)
}

/// Flux that crosses discs.
struct Crossings<'a> {
    discs: &'a Discs,
    fluxes: BatchEstimates,
}

/// A worker's.
struct Room<'a> {
    discs: &'a Discs,
    fluxes: WorkerSums,
    waiting: Vec<usize>,
}

impl Crossings<'_> {
    /// Illuminance on a disc after so many batches, of lights of a power.
    fn reading(&self, meter: usize, batches: u64, power: f64) -> Reading {
        let area = Disc::area(&self.discs.all()[meter]);
        if area <= 0.0 {
            return Reading::default();
        }
        let flux = self.fluxes.get(meter, batches, LIGHT_BATCH);
        // Where no path came by, one might have: it carries about all of the power over their number.
        let unseen = power / (batches * LIGHT_BATCH as u64) as f64;
        Reading { value: flux.luminance() / area, standard_error: flux.error().hypot(unseen) / area }
    }
}

impl Receiver for Room<'_> {
    fn arrived(&mut self, _: &Arrivals) {}
    fn escaped(&mut self, _: &Escapes) {}
    fn travelled(&mut self, segments: &Segments<'_>) {
        let Self { discs, fluxes, waiting } = self;
        for number in (0..segments.count()).filter(|number| segments.bounces(*number) > 0) {
            discs.crossed(&segments.get(number), waiting, |disc, at, weight| {
                fluxes.add(disc, segments.flux(number, at as f32).map(|flux| f64::from(flux) * weight));
            });
        }
    }
}

impl<'a> Collector for Crossings<'a> {
    type Room = Room<'a>;

    fn room(&self) -> Room<'a> {
        Room { discs: self.discs, fluxes: WorkerSums::new(self.discs.all().len()), waiting: Vec::new() }
    }
    fn add(&self, _: &Batch<'_>, room: &mut Room<'a>) {
        self.fluxes.complete(&mut room.fluxes);
    }
    fn join(&self, room: &mut Room<'a>) {
        self.fluxes.join(&mut room.fluxes);
    }
}
