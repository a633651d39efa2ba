//! Figures of the light's colour: CCT and Duv (CIE 15), Ra (CIE 13.3), Rf and Rg (TM-30-20).
//!
//! For each spectrum of the scene's lamps it is measured by how much its light changes on its way, in one narrow band of wavelengths after another, by the same
//! random numbers, so that noise hardly changes a spectrum's shape; and that in several rounds, each by random numbers of its own, whose spread tells how far
//! the figures may be off.

use super::{
    by_colour_alone, check_spectra,
    colour_reading::ColourReading,
    is_by_colours,
    sources::{SourceScene, by_spectrum},
};
use crate::{
    compile::{BandedScene, compile},
    error::{Diagnostic, Error, Result},
    measure::{
        sense::{Plan, Probe, Sensed},
        sensing::Effort,
        watch::Watch,
    },
    render::Progress,
    scene::{Meter, Origin, Scene, Settings},
};
use gonio_simd::Execution;
use gonio_spectrum::{Bands, Mixture, Spectrum, bands_of};
use std::{collections::HashMap, sync::Arc, time::Instant};

/// The bands' width, nm: walls, air and glass change light evenly within.
const BAND_NM: f64 = 10.0;
/// Independent rounds.
const ROUNDS: u32 = 8;
/// A round of a band takes this part of a point's samples, and no fewer than its error needs.
const PART: u32 = 128;
const FEWEST: u32 = 16;
/// Sets the seeds of rounds apart from those within a measurement.
const APART: u32 = 0x85eb_ca6b;

/// What meters of colour get.
pub(in super::super) struct Found {
    /// In the meters' order; places that several meters share are measured once.
    pub(in super::super) readings: Vec<Arc<ColourReading>>,
    /// What stands around the first measurement.
    pub(in super::super) first: Sensed,
}

/// Measures what these meters get, each with the probe that it is; there is at least one.
///
/// # Errors
/// Lamps without a spectrum where figures of colour rendering are asked for, what compiling finds, cancellation.
pub(in super::super) fn colours(
    scene: &Scene,
    (meters, probes): (&[&Meter], &[Probe]),
    execution: Execution,
    watch: &mut Watch<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Found> {
    check(scene, meters, diagnostics)?;
    let bands = bands_of(BAND_NM).ok_or_else(|| Error::Internal(format!("no bands of {BAND_NM} nm")))?;
    let sources = by_spectrum(scene)?;
    let (places, of_probe) = distinct(probes);
    let mut sweep = Sweep {
        bands,
        places: &places,
        execution,
        steps: sources.len() * bands.count() * ROUNDS as usize,
        done: 0,
        start: Instant::now(),
        first: None,
    };
    // By place, round and source, the lx of all bands.
    let mut values = vec![vec![Vec::with_capacity(sources.len()); ROUNDS as usize]; places.len()];
    for source in &sources {
        let factors = sweep.of_source(source, watch, diagnostics)?;
        values.iter_mut().zip(factors).for_each(|(rounds, found)| rounds.iter_mut().zip(found).for_each(|(all, one)| all.push(one)));
    }
    let spectra = without_absent(sources.into_iter().map(|source| source.spectrum).collect(), &mut values);
    let mixture = Arc::new(Mixture::new(bands, &spectra));
    let by_colours = is_by_colours(scene);
    let reading = |rounds: &Vec<_>| {
        let found = ColourReading::of_rounds(&mixture, rounds);
        Arc::new(if by_colours { found.of_colours() } else { found })
    };
    let readings: Vec<Arc<ColourReading>> = values.iter().map(reading).collect();
    let readings = of_probe.into_iter().map(|place| readings[place].clone()).collect();
    let first = sweep.first.ok_or_else(|| Error::Internal("no band of wavelengths was measured".to_owned()))?;
    Ok(Found { readings, first })
}

/// Leaves out sources that bring nothing anywhere, whose points would be some of the spectrum's; one stays.
fn without_absent(spectra: Vec<Spectrum>, values: &mut [Vec<Vec<Vec<f64>>>]) -> Vec<Spectrum> {
    let brings = |source: usize| values.iter().flatten().any(|round| round[source].iter().any(|lux| *lux != 0.0));
    let mut kept: Vec<bool> = (0..spectra.len()).map(brings).collect();
    if let (false, Some(first)) = (kept.contains(&true), kept.first_mut()) {
        *first = true;
    }
    for round in values.iter_mut().flatten() {
        let mut kept = kept.iter();
        round.retain(|_| kept.next().copied().unwrap_or(false));
    }
    spectra.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(spectrum, _)| spectrum).collect()
}

/// Measurements in all bands, for one source after the other.
struct Sweep<'a> {
    bands: &'static Bands,
    places: &'a [Probe],
    execution: Execution,
    /// How many measurements there will be, and have been.
    steps: usize,
    done: usize,
    start: Instant,
    /// What stands around the first.
    first: Option<Sensed>,
}

impl Sweep<'_> {
    /// By place and round, the source's lx in each band.
    fn of_source(&mut self, source: &SourceScene, watch: &mut Watch<'_>, diagnostics: &mut Vec<Diagnostic>) -> Result<Vec<Vec<Vec<f64>>>> {
        let scene = &source.scene;
        let compiled = compile(scene, watch.previous, watch.cancel)?;
        if self.first.is_none() {
            diagnostics.extend(compiled.diagnostics.iter().cloned());
        }
        let plan = Plan::new(&compiled, self.places, &scene.settings, watch);
        let mut banded = BandedScene::with_even_lamps(compiled, self.bands);
        let samples = (scene.settings.samples / PART).max(FEWEST);
        let mut values = vec![vec![Vec::with_capacity(self.bands.count()); ROUNDS as usize]; self.places.len()];
        for band in 0..self.bands.count() {
            let at_band = banded.at(band)?;
            for round in 0..ROUNDS {
                let seed = scene.settings.seed.wrapping_add(APART.wrapping_mul(round));
                let settings = Settings { samples, seed, ..scene.settings.clone() };
                let Self { done, steps, start, .. } = *self;
                let mut progress = |part: &Progress| (watch.progress)(&part.of_whole(done, steps, start));
                let mut watch = Watch { previous: None, cancel: watch.cancel, progress: &mut progress };
                let mut sensed = plan.follow(at_band, Effort::of_part(samples), &settings, self.execution, &mut watch)?;
                let readings = std::mem::take(&mut sensed.readings);
                values.iter_mut().zip(readings).for_each(|(rounds, reading)| rounds[round as usize].push(reading.value));
                self.first.get_or_insert(sensed);
                self.done += 1;
            }
        }
        Ok(values)
    }
}

/// Which spectra stand in for others.
fn check(scene: &Scene, meters: &[&Meter], diagnostics: &mut Vec<Diagnostic>) -> Result<()> {
    let Some(first) = meters.first() else { return Ok(()) };
    let wants_spectra = |meter: &&&Meter| meter.measurand.wants_spectra();
    if let Some(meter) = meters.iter().find(wants_spectra) {
        return check_spectra(scene, &meter.origin, "figures of colour rendering", diagnostics);
    }
    if by_colour_alone(scene).next().is_some() {
        diagnostics.push(stands_in(&first.origin));
    }
    Ok(())
}

fn stands_in(of: &Origin) -> Diagnostic {
    Diagnostic::info(of, "lights without a spectrum count as daylight D65 of their colour, which is enough for CCT and Duv")
}

/// Places that are measured, each once, and the number of each probe's.
fn distinct(probes: &[Probe]) -> (Vec<Probe>, Vec<usize>) {
    let mut known = HashMap::new();
    let mut places = Vec::new();
    let mut number = |probe: &Probe| {
        *known.entry(probe.bits()).or_insert_with(|| {
            places.push(*probe);
            places.len() - 1
        })
    };
    let of_probe = probes.iter().map(&mut number).collect();
    (places, of_probe)
}
