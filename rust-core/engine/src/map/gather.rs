//! From light paths to maps: charts are laid over surfaces, batches of paths are traced until there is enough, and sums become lux.

use super::{
    cells::{CellChart, cells_for},
    figures::{self, ByWavelength},
    join::join,
    options::{MOST_SIDE, MapOptions, TexelSize},
    side::{SideMap, Summary},
    surface::{MappedSurface, chosen},
    table::{FluxTable, Sums},
    texels::{TexelChart, coordinates, resolution},
};
use crate::{
    compile::{CompiledScene, compile, transport, unfollowed},
    error::{Diagnostic, Error, Result},
    light::EmissionSampler,
    light_paths::{Batch, Channels, Collector, FixedSums, Job, Watch, trace_batches},
    scene::{Integrator, Scene, Settings},
    transport::{Arrivals, Arriving, Emission, Escapes, LIGHT_BATCH, LightTracer, Receiver, Wanted},
};
use gonio_simd::Execution;
use std::time::{Duration, Instant};

/// How a surface is divided.
#[derive(Clone, Debug)]
pub enum Chart {
    /// By texels.
    Texels(TexelChart),
    /// By triangles.
    Cells(CellChart),
}

impl Chart {
    /// Parts that have a value each.
    pub fn len(&self) -> usize {
        match self {
            Self::Texels(chart) => chart.len(),
            Self::Cells(chart) => chart.len(),
        }
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The part at barycentric coordinates of corners 1 and 2.
    pub fn cell(&self, triangle: u32, place: [f32; 2]) -> usize {
        match self {
            Self::Texels(chart) => chart.cell(triangle, place),
            Self::Cells(chart) => chart.cell(triangle, place),
        }
    }
    /// Square metres of a part of a surface whose triangles have these areas.
    fn areas(&self, triangles: &[f64]) -> Vec<f64> {
        match self {
            Self::Texels(chart) => chart.areas().to_vec(),
            Self::Cells(chart) => {
                let of = |(triangle, area): (usize, &f64)| {
                    std::iter::repeat_n(area / chart.cells(triangle).len() as f64, chart.cells(triangle).len())
                };
                triangles.iter().enumerate().flat_map(of).collect()
            }
        }
    }
}

/// A surface with its light.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    /// Which it is.
    pub surface: MappedSurface,
    /// How it is divided.
    pub chart: Chart,
    /// Front and back, which the triangles' winding tells apart; none where nothing arrived.
    pub sides: [Option<SideMap>; 2],
    /// What they get.
    pub summaries: [Summary; 2],
}

/// Maps of a scene.
#[derive(Clone, Debug)]
pub struct IlluminationMaps {
    /// The surfaces.
    pub surfaces: Vec<SurfaceMap>,
    /// The surface of each of the scene's instances, [`u32::MAX`] of those without.
    pub of_instance: Vec<u32>,
    /// Light paths.
    pub paths: u64,
    /// Relative standard error of a part's illuminance, averaged over the area where any arrived; before parts were joined.
    pub error: f64,
    /// Luminous flux that paths started with, lumens.
    pub emitted: f64,
    /// Luminous flux of paths that were cut off by the most bounces, lumens.
    pub cut_off: f64,
    /// Bytes that were asked for.
    pub memory: u64,
    /// What is to be known of the maps.
    pub diagnostics: Vec<Diagnostic>,
}

/// Traces light paths of a scene until its maps are as certain as was asked for, or other limits are reached. `watch` is told of batches of
/// [`LIGHT_BATCH`] paths.
///
/// # Errors
/// Settings that make no map, coordinates that a surface does not have, more memory than allowed, no lights, cancellation.
pub fn illumination_maps(
    scene: &Scene,
    compiled: &CompiledScene,
    options: &MapOptions,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<IlluminationMaps> {
    options.check()?;
    if options.figures && !scene.settings.spectral {
        // What figures tell of light by wavelength is of as many lux as light with wavelengths brings.
        let mut spectral = scene.clone();
        spectral.settings.spectral = true;
        let compiled = compile(&spectral, Some(compiled), watch.cancel)?;
        return illumination_maps(&spectral, &compiled, options, execution, watch);
    }
    let start = Instant::now();
    let surfaces = chosen(scene, compiled, options)?;
    let mut of_colour = Vec::new();
    let sources = figures::sources(scene, options, &mut of_colour)?;
    let (charts, memory) = charts(scene, &surfaces, options, sources.len())?;
    let sampler = emission(compiled);
    let power = crate::colour::luminance(sampler.total_power());
    if sampler.is_empty() || !(power > 0.0 && power.is_finite()) {
        return Err(Error::setting("light", "nothing in the scene sends light"));
    }
    let mut places = Places::new(&charts, compiled.tables.first_light_instance as usize, &surfaces);
    let table = FluxTable::new(2 * places.cells(), options.colours, power);
    let gathering =
        Gathering { places: &places, charts: &charts, table: &table, batches: FixedSums::new(2, sampler.total_power(), options.paths) };
    let tracing = Tracing { settings: &scene.settings, compiled, options, execution, start };
    let areas: Vec<Vec<f64>> = charts.iter().zip(&surfaces).map(|(chart, surface)| chart.areas(&surface.areas)).collect();
    let paths = tracing.run(&sampler, &gathering, watch, &|| mean_error(&places, &table, &areas))?;
    if paths == 0 {
        return Err(Error::setting("time limit", "it ended before any light path did"));
    }
    let lumens = |at: usize| crate::colour::luminance(gathering.batches.get(at)) / paths as f64;
    let (emitted, cut_off) = (lumens(0), lumens(1));
    let error = mean_error(&places, &table, &areas);
    let by_wavelength = ByWavelength { places: &places, charts: &charts, options, execution, paths };
    let banded = if sources.is_empty() { None } else { Some(by_wavelength.traced(sources, watch)?) };
    let mut diagnostics = diagnostics(&surfaces, &charts);
    diagnostics.extend(of_colour);
    diagnostics.extend(unfollowed(scene, &compiled.tables));
    let finished = surfaces.into_iter().zip(charts).zip(&areas).enumerate();
    let of = |(number, ((surface, chart), areas)): (usize, ((MappedSurface, Chart), &Vec<f64>))| {
        finish(surface, chart, areas, paths as f64, options, &|side, cell| table.row(places.row(number, cell, side)))
    };
    let mut surfaces: Vec<SurfaceMap> = finished.map(of).collect();
    banded.iter().for_each(|banded| banded.add_to(&mut surfaces, &areas, &places));
    diagnostics.extend(surfaces.iter().filter_map(|surface| too_coarse(surface, options)));
    let of_instance = std::mem::take(&mut places.of_instance);
    Ok(IlluminationMaps { surfaces, of_instance, paths, error, emitted, cut_off, memory, diagnostics })
}

/// How light paths start.
pub(super) fn emission(compiled: &CompiledScene) -> EmissionSampler {
    let (centre, radius) = compiled.bounds.sphere(compiled.tables.origin);
    EmissionSampler::new(&compiled.tables.lights, None, (centre, radius as f32), &[])
}

/// Where surfaces stand in the table.
pub(super) struct Places {
    /// First cell of each surface, and the number of all.
    first: Vec<usize>,
    of_instance: Vec<u32>,
}

impl Places {
    fn new(charts: &[Chart], instances: usize, surfaces: &[MappedSurface]) -> Self {
        let mut first = vec![0];
        charts.iter().for_each(|chart| first.push(first[first.len() - 1] + chart.len()));
        let mut of_instance = vec![u32::MAX; instances];
        surfaces.iter().enumerate().for_each(|(number, surface)| of_instance[surface.instance as usize] = number as u32);
        Self { first, of_instance }
    }
    pub(super) fn cells(&self) -> usize {
        self.first.last().copied().unwrap_or(0)
    }
    /// The row of a surface's cell; side 1 is the back.
    pub(super) fn row(&self, surface: usize, cell: usize, side: usize) -> usize {
        2 * (self.first[surface] + cell) + side
    }
}

/// Divides surfaces, and says how much memory the maps take, by the light of so many sources where its colour is asked for.
fn charts(scene: &Scene, surfaces: &[MappedSurface], options: &MapOptions, sources: usize) -> Result<(Vec<Chart>, u64)> {
    let total: f64 = surfaces.iter().map(MappedSurface::area).sum();
    let metres = match options.texel {
        TexelSize::Metres(metres) => metres,
        _ => (total / AUTOMATIC_CELLS).sqrt(),
    };
    let triangles: u64 = surfaces.iter().map(|surface| surface.areas.len() as u64).sum();
    let Some(uv) = &options.uv else {
        let mut wanted = metres * metres;
        let needed = |wanted: f64| {
            let cells: u64 = surfaces.iter().map(|surface| cells_for(&surface.areas, wanted)).sum();
            (cells, memory_of(cells, triangles, options, sources))
        };
        // What was not asked for may be coarser.
        while options.texel == TexelSize::Automatic && needed(wanted).1 > options.memory && wanted < total {
            wanted *= 2.0;
        }
        let (cells, memory) = needed(wanted);
        check_memory(cells, memory, options)?;
        return Ok((surfaces.iter().map(|surface| Chart::Cells(CellChart::new(&surface.areas, wanted))).collect(), memory));
    };
    let mut placed = Vec::new();
    let mut texels = 0;
    for surface in surfaces {
        let mesh = &scene.meshes[surface.mesh.index()];
        let corners = coordinates(mesh, uv, surface)?;
        let size = match options.texel {
            TexelSize::Resolution(size) => size,
            _ => resolution(surface, mesh, &corners, metres),
        };
        texels += u64::from(size[0]) * u64::from(size[1]);
        placed.push((size, corners));
    }
    let memory = memory_of(texels, triangles, options, sources);
    check_memory(texels, memory, options)?;
    let charts =
        placed.into_iter().zip(surfaces).map(|((size, corners), surface)| Chart::Texels(TexelChart::new(size, corners, &surface.areas)));
    Ok((charts.collect(), memory))
}

/// Parts that all surfaces together have where nothing is said.
const AUTOMATIC_CELLS: f64 = 65_536.0;

/// Bytes that maps of so many cells over so many triangles take, all in all: sums, areas, and the values of both sides.
fn memory_of(cells: u64, triangles: u64, options: &MapOptions, sources: usize) -> u64 {
    let chart = match options.uv {
        Some(_) => TexelChart::memory(triangles as usize, cells),
        None => CellChart::memory(triangles),
    };
    let values = 2 * SideMap::memory([options.colours, options.figures], options.uv.is_none());
    let by_wavelength = if sources > 0 { figures::memory(2 * cells, sources as u64) } else { 0 };
    FluxTable::memory(2 * cells, options.colours) + by_wavelength + chart + triangles * 8 + cells * (8 + values)
}

fn check_memory(cells: u64, memory: u64, options: &MapOptions) -> Result<()> {
    if memory <= options.memory && cells < u64::from(u32::MAX) {
        return Ok(());
    }
    let mebibytes = |bytes: u64| bytes.div_ceil(1 << 20);
    let problem = format!(
        "{cells} parts of surfaces take {} MiB, and {} are allowed: larger texels, fewer prims, or more memory",
        mebibytes(memory),
        mebibytes(options.memory)
    );
    Err(Error::setting("memory", problem))
}

/// What light paths leave.
pub(super) struct Gathering<'a> {
    pub(super) places: &'a Places,
    pub(super) charts: &'a [Chart],
    pub(super) table: &'a FluxTable,
    /// What paths started with, and what was cut off.
    pub(super) batches: FixedSums,
}

/// What a worker is told goes straight into the table.
pub(super) struct Keeper<'a> {
    places: &'a Places,
    charts: &'a [Chart],
    table: &'a FluxTable,
}

impl Receiver for Keeper<'_> {
    fn arrived(&mut self, arrivals: &Arrivals) {
        for entry in 0..arrivals.count {
            let Some(surface) = self.places.of_instance.get(arrivals.instance[entry] as usize) else { continue };
            let Some(chart) = self.charts.get(*surface as usize) else { continue };
            let place = [arrivals.barycentric[0][entry], arrivals.barycentric[1][entry]];
            let cell = chart.cell(arrivals.primitive[entry], place);
            let side = usize::from(arrivals.side[entry] < 0.0);
            self.table.add(self.places.row(*surface as usize, cell, side), arrivals, entry);
        }
    }
    fn escaped(&mut self, _: &Escapes) {}
}

impl<'a> Collector for Gathering<'a> {
    type Room = Keeper<'a>;

    fn room(&self) -> Keeper<'a> {
        Keeper { places: self.places, charts: self.charts, table: self.table }
    }
    fn add(&self, batch: &Batch<'_>, _: &mut Keeper<'a>) {
        let channels: [Channels; 2] = [batch.flux.emitted, batch.flux.cut_off];
        channels.into_iter().enumerate().for_each(|(at, flux)| self.batches.add(at, flux));
    }
}

/// What is traced how.
pub(super) struct Tracing<'a> {
    pub(super) settings: &'a Settings,
    pub(super) compiled: &'a CompiledScene,
    pub(super) options: &'a MapOptions,
    pub(super) execution: Execution,
    pub(super) start: Instant,
}

/// Batches before the error is looked at for the first time, and between looks later: a net of the sampler's whole.
const FIRST_LOOK: u64 = 16;
const WHOLE_NET: u64 = 256;

impl Tracing<'_> {
    /// Traces until there is enough; gives the number of paths.
    pub(super) fn run(
        &self,
        sampler: &EmissionSampler,
        gathering: &Gathering<'_>,
        watch: &mut Watch<'_>,
        error: &dyn Fn() -> f64,
    ) -> Result<u64> {
        let settings = self.settings();
        let transport = transport(self.compiled, &settings, self.execution, [0.0; 3], [0.0, 0.0, -1.0]);
        let wanted = Wanted { arrivals: Arriving::All, specular_only: false, picture: None };
        let tracer = LightTracer { tables: &self.compiled.tables, transport: &transport, emission: Emission::Lights(sampler), wanted };
        let limit = self.options.time_limit_s;
        let deadline = (limit > 0.0).then(|| self.start + Duration::from_secs_f64(limit));
        let job = Job { scene: self.compiled, tracer: &tracer, threads: settings.threads, deadline };
        let most = self.options.paths.div_ceil(LIGHT_BATCH as u64);
        let mut done = 0;
        while done < most {
            let end = next_look(done).min(most);
            let mut progress = |traced| (watch.progress)(done + traced);
            let mut part = Watch { cancel: watch.cancel, progress: &mut progress };
            let (traced, _) = trace_batches(&job, done..end, gathering, &mut part)?;
            let late = done + traced < end;
            done += traced;
            // Looked at by number of paths alone, so that maps do not depend on threads.
            if late || (self.options.error > 0.0 && done < most && error() <= self.options.error) {
                break;
            }
        }
        Ok(done * LIGHT_BATCH as u64)
    }

    fn settings(&self) -> Settings {
        Settings {
            integrator: Integrator::Path,
            max_bounces: self.options.max_bounces,
            kind_bounces: [255; 4],
            volume_bounces: 255,
            clamp_direct: 0.0,
            clamp_indirect: 0.0,
            aovs: Vec::new(),
            shader_passes: Vec::new(),
            ..self.settings.clone()
        }
    }
}

/// Batches after which the error is looked at next.
fn next_look(done: u64) -> u64 {
    if done < WHOLE_NET { (2 * done).max(FIRST_LOOK) } else { done + (done / 4).next_multiple_of(WHOLE_NET).max(WHOLE_NET) }
}

/// Relative standard error averaged over the area where anything arrived; 1 where nothing did.
fn mean_error(places: &Places, table: &FluxTable, areas: &[Vec<f64>]) -> f64 {
    let (mut sum, mut lit) = (0.0, 0.0);
    for (surface, areas) in areas.iter().enumerate() {
        for (cell, area) in areas.iter().enumerate() {
            for side in 0..2 {
                let sums = table.row(places.row(surface, cell, side));
                if sums.count > 0.0 {
                    sum += area * sums.relative_error();
                    lit += area;
                }
            }
        }
    }
    if lit > 0.0 { sum / lit } else { 1.0 }
}

/// What is to be known of charts.
fn diagnostics(surfaces: &[MappedSurface], charts: &[Chart]) -> Vec<Diagnostic> {
    let shared = |(surface, chart): (&MappedSurface, &Chart)| match chart {
        Chart::Texels(chart) if chart.shared() > 0 => {
            let share = 100.0 * chart.shared() as f64 / chart.len() as f64;
            let message = format!("several parts of the surface share {share:.1} % of the texels, which show their mean");
            Some(Diagnostic::warning(&surface.origin, message))
        }
        _ => None,
    };
    surfaces.iter().zip(charts).filter_map(shared).collect()
}

/// Says where parts are wider than was asked for.
fn too_coarse(map: &SurfaceMap, options: &MapOptions) -> Option<Diagnostic> {
    let TexelSize::Metres(asked) = options.texel else { return None };
    let told = |problem: String| Some(Diagnostic::warning(&map.surface.origin, problem));
    let cells = match &map.chart {
        Chart::Texels(chart) if chart.size().contains(&MOST_SIDE) => {
            return told(format!("texels of {asked} m would be more than {MOST_SIDE} a side; they are larger"));
        }
        Chart::Texels(_) => return None,
        Chart::Cells(cells) => cells,
    };
    let (mut lit, mut coarse, mut widest) = (0.0, 0.0, 0.0f64);
    for side in map.sides.iter().flatten() {
        for (triangle, area) in map.surface.areas.iter().enumerate() {
            let own = area / cells.cells(triangle).len() as f64;
            for cell in cells.cells(triangle) {
                let width = (area / f64::from(1u32 << (2 * side.level[cell]))).sqrt();
                lit += own;
                if width > asked * (1.0 + 1e-6) {
                    coarse += own;
                    widest = widest.max(width);
                }
            }
        }
    }
    let (share, error) = (100.0 * coarse / lit, 100.0 * options.error);
    let reason = format!("where their own error would be more than {error} %: more paths, or an error of 0 %");
    if coarse > 0.0 {
        return told(format!("{share:.0} % of it has parts wider than the {asked} m asked for, up to {widest:.3} m, {reason}"));
    }
    None
}

/// Turns the sums of a surface into lux.
fn finish(
    surface: MappedSurface,
    chart: Chart,
    areas: &[f64],
    paths: f64,
    options: &MapOptions,
    sums: &dyn Fn(usize, usize) -> Sums,
) -> SurfaceMap {
    let mut summaries: [Summary; 2] = Default::default();
    let sides = [0, 1].map(|side| {
        let all = (0..areas.len()).fold(Sums::default(), |all, cell| all.plus(&sums(side, cell)));
        let area = surface.area();
        summaries[side] = Summary {
            flux: all.total() / paths,
            direct: all.flux[0] / paths,
            area,
            standard_error: all.squares.sqrt() / paths,
            extremes: [0.0; 2],
            colour: None,
        };
        if all.count == 0.0 {
            return None;
        }
        let mut map = SideMap::new(areas.len(), options.colours, matches!(chart, Chart::Cells(_)));
        match &chart {
            Chart::Cells(cells) => join(cells, &surface.areas, paths, options.error, &|cell| sums(side, cell), &mut map),
            Chart::Texels(_) => {
                let covered = areas.iter().enumerate().filter(|(_, area)| **area > 0.0);
                covered.for_each(|(cell, area)| map.set(cell..cell + 1, &sums(side, cell), 1.0 / (paths * area)));
            }
        }
        let known = || map.illuminance.iter().copied().filter(|lux| lux.is_finite());
        summaries[side].extremes = [known().fold(f32::INFINITY, f32::min), known().reduce(f32::max).unwrap_or(0.0)];
        Some(map)
    });
    SurfaceMap { surface, chart, sides, summaries }
}
