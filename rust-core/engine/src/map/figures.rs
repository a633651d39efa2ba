//! Figures of the light's colour on maps, as meters have them: CCT, Duv, Ra, Rf, Rg, melanopic light.
//!
//! For each spectrum of the scene's lamps light paths are traced in one narrow band of wavelengths after another, by the same random numbers, and that in several
//! rounds, whose spread tells how far the figures may be off. They tell what the light of each part is made of; how much there is, the map's own paths tell.

use super::{
    gather::{Chart, Gathering, Places, SurfaceMap, Tracing, emission},
    options::MapOptions,
    side::{PartColour, SideMap},
    surface::MappedSurface,
    table::FluxTable,
};
use crate::{
    compile::{BandedScene, compile},
    error::{Diagnostic, Error, Result},
    light_paths::{FixedSums, Watch},
    measure::{ColourReading, Reading, SourceScene, by_spectrum, check_spectra},
    scene::{Measurand, Origin, Scene, Settings},
    threads::in_pool,
    transport::LIGHT_BATCH,
};
use gonio_simd::Execution;
use gonio_spectrum::{Bands, Mixture, bands_of};
use rayon::prelude::*;
use std::{sync::Arc, time::Instant};

/// The bands' width, nm; meters have the same.
const BAND_NM: f64 = 10.0;
/// Independent rounds.
const ROUNDS: usize = 8;
/// A round of a band takes this part of the map's paths.
const PART: u64 = 64;
/// Sets the seeds of rounds apart.
const APART: u32 = 0x85eb_ca6b;

/// What light paths brought to all rows of the map's table, lumens: by source, band and round.
pub(super) struct Banded {
    mixture: Arc<Mixture>,
    runs: Vec<Vec<f32>>,
    /// Sources and bands.
    size: [usize; 2],
}

/// Bytes that so many rows take for so many sources.
pub(super) fn memory(rows: u64, sources: u64) -> u64 {
    let bands = bands_of(BAND_NM).map_or(0, |bands| bands.count() as u64);
    FluxTable::memory(rows, false) + rows * 4 * sources * bands * ROUNDS as u64
}

/// Batches of light paths of a map of a scene, at most, figures of colour counted.
pub fn most_batches(scene: &Scene, options: &MapOptions) -> u64 {
    let own = options.paths.div_ceil(LIGHT_BATCH as u64);
    let sources = if options.figures { by_spectrum(scene).map_or(0, |sources| sources.len()) } else { 0 };
    let bands = bands_of(BAND_NM).map_or(0, Bands::count);
    own + (sources * bands * ROUNDS) as u64 * own.div_ceil(PART)
}

/// Checks that all lamps have spectra, and tells the scene by them.
///
/// # Errors
/// Lamps and surfaces that shine without one.
pub(super) fn sources(scene: &Scene, options: &MapOptions, diagnostics: &mut Vec<Diagnostic>) -> Result<Vec<SourceScene>> {
    if !options.figures {
        return Ok(Vec::new());
    }
    check_spectra(scene, &Origin::new("maps"), "figures of colour", diagnostics)?;
    by_spectrum(scene)
}

/// How the light of a map is traced by wavelength.
pub(super) struct ByWavelength<'a> {
    pub(super) places: &'a Places,
    pub(super) charts: &'a [Chart],
    pub(super) options: &'a MapOptions,
    pub(super) execution: Execution,
    /// Paths of the map itself.
    pub(super) paths: u64,
}

impl ByWavelength<'_> {
    /// Traces all sources in all bands.
    pub(super) fn traced(&self, sources: Vec<SourceScene>, watch: &mut Watch<'_>) -> Result<Banded> {
        let bands = bands_of(BAND_NM).ok_or_else(|| Error::Internal(format!("no bands of {BAND_NM} nm")))?;
        let (mut runs, mut spectra) = (Vec::new(), Vec::new());
        let mut done = self.paths / LIGHT_BATCH as u64;
        for SourceScene { scene, spectrum } in sources {
            let found = self.of_source(&scene, bands, &mut done, watch)?;
            // One that brings nothing anywhere has no part in the spectrum; one of all stays.
            if spectra.is_empty() || found.iter().flatten().any(|lumens| *lumens != 0.0) {
                runs.extend(found);
                spectra.push(spectrum);
            }
        }
        Ok(Banded { mixture: Arc::new(Mixture::new(bands, &spectra)), runs, size: [spectra.len(), bands.count()] })
    }

    /// The lumens of each row, by band and round.
    fn of_source(&self, scene: &Scene, bands: &'static Bands, done: &mut u64, watch: &mut Watch<'_>) -> Result<Vec<Vec<f32>>> {
        let compiled = compile(scene, None, watch.cancel)?;
        let sampler = emission(&compiled);
        let power = crate::colour::luminance(sampler.total_power());
        let rows = 2 * self.places.cells();
        let mut runs = Vec::with_capacity(bands.count() * ROUNDS);
        if sampler.is_empty() || !(power > 0.0 && power.is_finite()) {
            return Ok(vec![vec![0.0; rows]; bands.count() * ROUNDS]);
        }
        let mut banded = BandedScene::with_even_lamps(compiled, bands);
        let batches = (self.paths / LIGHT_BATCH as u64).div_ceil(PART).max(1);
        let options = MapOptions { paths: batches * LIGHT_BATCH as u64, error: 0.0, time_limit_s: 0.0, ..self.options.clone() };
        for band in 0..bands.count() {
            let at_band = banded.at(band)?;
            for round in 0..ROUNDS as u32 {
                let seed = scene.settings.seed.wrapping_add(APART.wrapping_mul(round));
                let settings = Settings { seed, ..scene.settings.clone() };
                let table = FluxTable::new(rows, false, power);
                let batches = FixedSums::new(2, sampler.total_power(), options.paths);
                let gathering = Gathering { places: self.places, charts: self.charts, table: &table, batches };
                let (compiled, execution) = (&**at_band, self.execution);
                let tracing = Tracing { settings: &settings, compiled, options: &options, execution, start: Instant::now() };
                let before = *done;
                let mut progress = |traced| (watch.progress)(before + traced);
                let mut part = Watch { cancel: watch.cancel, progress: &mut progress };
                let paths = tracing.run(&sampler, &gathering, &mut part, &|| 1.0)? as f64;
                runs.push((0..rows).map(|row| (table.row(row).total() / paths) as f32).collect());
                *done += paths as u64 / LIGHT_BATCH as u64;
            }
        }
        Ok(runs)
    }
}

impl Banded {
    /// What the light of some rows over an area says, each round by source and band.
    fn reading(&self, rows: impl Iterator<Item = usize> + Clone, area: f64) -> ColourReading {
        let [sources, bands] = self.size;
        let lux = |source: usize, band: usize, round: usize| {
            let run = &self.runs[(source * bands + band) * ROUNDS + round];
            rows.clone().map(|row| f64::from(run[row])).sum::<f64>() / area
        };
        let of_round = |round: usize| -> Vec<Vec<f64>> {
            (0..sources).map(|source| (0..bands).map(|band| lux(source, band, round)).collect()).collect()
        };
        ColourReading::of_rounds(&self.mixture, &(0..ROUNDS).map(of_round).collect::<Vec<_>>())
    }

    /// Gives the sides of surfaces that got light their figures.
    pub(super) fn add_to(&self, surfaces: &mut [SurfaceMap], areas: &[Vec<f64>], places: &Places) {
        for (number, (map, areas)) in surfaces.iter_mut().zip(areas).enumerate() {
            for side in 0..2 {
                let Some(lit) = &map.sides[side] else { continue };
                let row = |cell: usize| places.row(number, cell, side);
                let all = self.reading((0..areas.len()).map(row), map.surface.area());
                let parts = parts(&map.chart, lit, &map.surface, areas);
                let colour = |(first, count): &(usize, usize)| {
                    let cells = *first..first + count;
                    let light =
                        Reading { value: f64::from(lit.illuminance[*first]), standard_error: f64::from(lit.standard_error[*first]) };
                    let area = areas[cells.clone()].iter().sum();
                    PartColour::new(&self.reading(cells.map(row), area), &light)
                };
                let colours: Vec<PartColour> = in_pool(|| parts.par_iter().map(colour).collect());
                let mut figures = vec![PartColour::NONE; areas.len()];
                parts.iter().zip(colours).for_each(|((first, count), colour)| figures[*first..first + count].fill(colour));
                if let Some(lit) = &mut map.sides[side] {
                    lit.figures = figures;
                }
                map.summaries[side].colour = Some(Arc::new(all));
            }
        }
    }
}

/// First cell and number of cells of each part that has a value of its own.
fn parts(chart: &Chart, side: &SideMap, surface: &MappedSurface, areas: &[f64]) -> Vec<(usize, usize)> {
    match chart {
        Chart::Texels(_) => areas.iter().enumerate().filter(|(_, area)| **area > 0.0).map(|(cell, _)| (cell, 1)).collect(),
        Chart::Cells(cells) => {
            let of = |triangle: usize| {
                let whole = cells.level(triangle);
                cells.parts(triangle, &side.level).map(move |(first, _)| (first, 1 << (2 * (whole - side.level[first]))))
            };
            let lit = surface.areas.iter().enumerate().filter(|(_, area)| **area > 0.0);
            lit.flat_map(|(triangle, _)| of(triangle)).collect()
        }
    }
}

impl PartColour {
    /// Of a part with so much light.
    fn new(colour: &ColourReading, light: &Reading) -> Self {
        let figure = |measurand: Measurand| match measurand {
            Measurand::MelanopicEdi => colour.melanopic_of(light),
            other => colour.of(other),
        };
        let found = Self::FIGURES.map(figure);
        Self {
            values: found.map(|reading| reading.map_or(f32::NAN, |reading| reading.value as f32)),
            errors: found.map(|reading| reading.map_or(f32::NAN, |reading| reading.standard_error as f32)),
        }
    }
}
