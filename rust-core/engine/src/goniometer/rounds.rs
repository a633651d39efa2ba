//! A measurement under way: rounds of batches until it is exact enough, and the reading at the end.

use super::{
    Opening, Options, Product, Reading,
    angles::Cell,
    opening::Departure,
    reading::{Fluxes, ScreenReading, Value},
    shining::{Sources, power},
    sources::NEGATIVE,
    tally::{Flux, Instrument, Tally},
};
use crate::{
    compile::{Bounds, CompiledScene},
    error::{Error, Result},
    light_paths::{Estimate, Job, Progress, Watch, trace_batches},
    transport::{Arriving, Emission, LIGHT_BATCH, LightTracer, Statistics, Transport, Wanted},
};
use gonio_formats::photometry::measured::Measurement;
use std::{sync::atomic::AtomicBool, time::Instant};

/// A measurement under way.
pub(super) struct Run<'a> {
    options: &'a Options,
    instrument: &'a Instrument,
    parts: Vec<(Emission<'a>, Tally<'a>)>,
    /// Batches of each part.
    batches: u64,
    start: Instant,
    statistics: Statistics,
    converged: bool,
}

impl<'a> Run<'a> {
    pub(super) fn new(options: &'a Options, instrument: &'a Instrument, sources: &'a Sources, start: Instant) -> Self {
        let most = options.stop.batches() * LIGHT_BATCH as u64;
        let parts = sources.emissions().map(|emission| (emission, Tally::new(instrument, power(emission), most))).collect();
        Self { options, instrument, parts, batches: 0, start, statistics: Statistics::default(), converged: false }
    }

    /// Traces until the rule says that it is enough.
    pub(super) fn trace(
        &mut self,
        scene: &CompiledScene,
        transport: &Transport,
        cancel: &AtomicBool,
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<()> {
        let stop = &self.options.stop;
        let deadline = stop.time.and_then(|time| self.start.checked_add(time));
        let wanted = Wanted { arrivals: Arriving::No, specular_only: false, picture: None };
        let most = stop.batches() * self.parts.len() as u64 * LIGHT_BATCH as u64;
        let mut error = None;
        while self.batches < stop.batches() {
            let round = self.batches..stop.next(self.batches);
            let mut before = self.batches * self.parts.len() as u64;
            let mut traced = round.end;
            for (emission, tally) in &self.parts {
                let tracer = LightTracer { tables: &scene.tables, transport, emission: *emission, wanted };
                // All parts trace as many batches: what one has the others get, even late.
                let end = traced;
                // The first round is traced in any case: without it nothing would be known.
                let deadline = deadline.filter(|_| end == round.end && round.start > 0);
                let job = Job { scene, tracer: &tracer, threads: self.options.threads, deadline };
                let mut tell = |done: u64| {
                    progress(&Progress { paths: (before + done) * LIGHT_BATCH as u64, most, error, elapsed: self.start.elapsed() })
                };
                let (done, statistics) = trace_batches(&job, round.start..end, tally, &mut Watch { cancel, progress: &mut tell })?;
                self.statistics.add(&statistics);
                before += done;
                traced = round.start + done;
            }
            self.batches = traced;
            self.parts.iter().for_each(|(_, tally)| tally.departures().settle());
            let peak = self.symmetric_peak()?.0;
            error = Some(peak.relative_error());
            // Who asks for no error asks for all rays.
            self.converged = if stop.error > 0.0 { self.is_exact_enough(&peak) } else { traced == stop.batches() };
            if self.converged || traced < round.end {
                break;
            }
        }
        Ok(())
    }

    fn sum(&self, of: impl Fn(&Tally<'a>) -> Estimate) -> Estimate {
        let part = |(emission, tally): &(Emission<'a>, Tally<'a>)| {
            let estimate = of(tally);
            Estimate { variance: estimate.variance * self.passes(*emission), ..estimate }
        };
        self.parts.iter().map(part).fold(Estimate::default(), |sum, part| sum.plus(&part))
    }

    /// How often rays of a table were taken: rays that come again tell nothing new of what they were drawn from.
    fn passes(&self, emission: Emission<'a>) -> f64 {
        match emission {
            Emission::Lights(_) => 1.0,
            Emission::Rays(table) => ((self.batches * LIGHT_BATCH as u64) as f64 / table.len() as f64).max(1.0),
        }
    }

    fn flux(&self, flux: Flux) -> Estimate {
        self.sum(|tally| tally.flux(flux, self.batches))
    }

    /// Intensity at angles by their numbers.
    fn intensity(&self, plane: usize, gamma: usize) -> Estimate {
        let (below, above) = self.instrument.cells.of(plane, gamma);
        let of = |(cell, solid_angle): Cell| self.sum(|tally| tally.direction(cell, self.batches)).scaled(1.0 / solid_angle);
        above.map_or_else(|| of(below), |above| at_horizon(&of(below), &of(above)))
    }

    fn intensities(&self) -> Vec<Estimate> {
        let gammas = self.options.angles.gamma.len();
        (0..self.options.angles.c.len() * gammas).map(|i| self.intensity(i / gammas, i % gammas)).collect()
    }

    /// The greatest intensity as files will have it, by the symmetry that they will have, and its direction.
    fn symmetric_peak(&self) -> Result<(Value, [f64; 2])> {
        let estimates = self.intensities();
        let darkest = estimates.iter().map(Estimate::luminance).fold(0.0, f64::min);
        if darkest < 0.0 {
            return Err(Error::setting("luminaire", format!("{darkest:.3} cd leave it in a direction, {NEGATIVE}")));
        }
        let [emitted, escaped] = [Flux::Emitted, Flux::Escaped].map(|flux| self.flux(flux));
        let measurement = Measurement {
            planes: self.options.angles.c.clone(),
            gammas: self.options.angles.gamma.clone(),
            intensities: estimates.iter().map(Estimate::luminance).collect(),
            errors: estimates.iter().map(Estimate::error).collect(),
            source_flux: emitted.luminance(),
            flux: escaped.luminance().min(emitted.luminance()),
            flux_error: escaped.error(),
            ..Measurement::default()
        };
        let reduced = measurement.reduced(self.options.symmetry).map_err(|error| Error::setting("symmetry", error.problem))?;
        let figures = reduced.figures();
        Ok((Value { value: figures.peak.value, error: figures.peak.error }, figures.peak_direction))
    }

    fn is_exact_enough(&self, peak: &Value) -> bool {
        let error = self.options.stop.error;
        let escaped = self.flux(Flux::Escaped);
        // Where nothing leaves there is nothing to wait for.
        let closed = escaped.mean == [0.0; 3];
        closed || peak.relative_error() <= error && escaped.relative_error() <= error
    }

    pub(super) fn reading(&self, body: &Bounds) -> Result<Reading> {
        let estimates = self.intensities();
        let value = |estimate: Estimate| Value { value: estimate.luminance(), error: estimate.error() };
        let flux = |flux: Flux| value(self.flux(flux));
        let departures: Vec<Departure> = self.parts.iter().flat_map(|(_, tally)| tally.departures().all()).collect();
        let (peak, peak_direction) = self.symmetric_peak()?;
        Ok(Reading {
            frame: self.options.frame,
            angles: self.options.angles.clone(),
            rgb: estimates.iter().map(|estimate| estimate.mean).collect(),
            intensities: estimates.iter().map(Estimate::luminance).collect(),
            errors: estimates.iter().map(Estimate::error).collect(),
            peak,
            peak_direction,
            fluxes: Fluxes {
                emitted: flux(Flux::Emitted),
                escaped: flux(Flux::Escaped),
                up: flux(Flux::Up),
                absorbed: flux(Flux::Absorbed),
                cut_off: flux(Flux::CutOff),
            },
            escaped_rgb: self.flux(Flux::Escaped).mean,
            opening: Opening::of(&departures),
            body: if body.is_empty() { [[0.0; 3]; 2] } else { [body.min, body.max] },
            product: Product::default(),
            screen: self.screen(),
            paths: self.batches * self.parts.len() as u64 * LIGHT_BATCH as u64,
            elapsed: self.start.elapsed(),
            converged: self.converged,
            statistics: self.statistics,
            diagnostics: Vec::new(),
        })
    }

    fn screen(&self) -> Option<ScreenReading> {
        let (screen, plane) = self.options.screen.zip(self.instrument.screen.as_ref())?;
        let cells = (0..plane.len()).map(|cell| self.sum(|tally| tally.on_screen(cell, self.batches)).scaled(1.0 / plane.cell_area));
        let (illuminance, errors) = cells.map(|cell| (cell.luminance(), cell.error())).unzip();
        Some(ScreenReading { screen, illuminance, errors })
    }
}

/// The intensity at the horizon by those just below and above it: the harmonic mean. It is both where they are the same, and none where no light goes
/// to one of the sides, so that interpolation puts none there.
fn at_horizon(below: &Estimate, above: &Estimate) -> Estimate {
    let [a, b] = [below, above].map(Estimate::luminance);
    let sum = a + b;
    if a <= 0.0 || b <= 0.0 {
        return Estimate::default();
    }
    let mean = below.plus(above).scaled(2.0 * a * b / (sum * sum)).mean;
    let [of_below, of_above] = [b, a].map(|other| 2.0 * (other / sum).powi(2));
    Estimate { mean, variance: of_below * of_below * below.variance + of_above * of_above * above.variance }
}
