//! The tracer: starts batches of paths at a camera or at sensors, and hands them to the schedule of the view's estimator.
//!
//! In go a tile's pixels and the samples of a batch, out come the sums of the [`Workspace`]. Stages are in `stage`, one file each.

use crate::schedule::path::{self, PathIntegrator};
use crate::schedule::steps;
use crate::schedule::whitted::{self, WhittedIntegrator};
use crate::stage::find::covered::find_covered;
use crate::stage::find::intersect::find_first;
use crate::stage::shade::integrator::Integrator;
use crate::stage::start::generate::{TileArea, generate, generate_at};
use crate::stage::start::places::{PlaceBatch, PlaceTable, Started, look_at_places, start_places};
use crate::stage::start::sensors::{SensorTable, start_sensors};
use crate::state::sample::SampleContext;
use crate::state::wavelengths::SlotWavelengths;
use crate::state::workspace::Workspace;
use crate::statistics::Stage;
use crate::tables::Tables;
use crate::tables::transport::{Estimator, Transport};
use gonio_camera::sampler::{Runs, Sampler, TILE};
use gonio_camera::{CameraTable, Placement};
use gonio_simd::dispatch;
use std::time::Instant;

/// Where paths start.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// At a camera, at places in the pixels.
    Camera(&'a CameraTable, &'a Placement),
    /// At sensors; depth 1 is their first rays'.
    Sensors(&'a SensorTable),
    /// At places on surfaces, whose hits are known.
    Places(&'a PlaceTable),
    /// Nowhere: light paths start at lights, see [`crate::LightTracer`].
    Lights,
}

/// Traces batches of one view of a scene.
#[derive(Debug)]
pub struct Tracer<'a> {
    /// The scene.
    pub tables: &'a Tables,
    /// Where paths start.
    pub start: Start<'a>,
    /// Settings of the view.
    pub transport: Transport,
}

/// The pixels and samples of a batch.
struct Batch<'a> {
    area: TileArea,
    sampler: Sampler,
    runs: &'a Runs,
    /// Of its slots' paths, where light has any.
    wavelengths: Option<&'a SlotWavelengths>,
}

impl<'a> Batch<'a> {
    fn sample(&self, depth: u32) -> SampleContext<'a> {
        SampleContext { sampler: self.sampler, runs: self.runs, depth, wavelengths: self.wavelengths }
    }
}

impl Tracer<'_> {
    /// Adds the samples of a batch to the workspace's sums, those of pixels in `[min, max)` (at most a tile's width).
    ///
    /// `cancelled` is asked once a stage; a cancelled batch leaves the sums incomplete.
    pub fn trace(&self, min: [u32; 2], max: [u32; 2], runs: &Runs, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        let tile = [min[0] / TILE as u32, min[1] / TILE as u32];
        let sampler = Sampler::new(self.transport.seed, tile, self.transport.samples);
        // Trees of rays have few samples: light is colour there.
        let spectral = !matches!(self.transport.estimator, Estimator::Trees(_));
        let wavelengths =
            ws.draw_wavelengths(self.tables.wavelengths.as_ref().filter(|_| spectral), self.transport.execution, (&sampler, runs));
        let batch = Batch { area: TileArea { min, max }, sampler, runs, wavelengths: wavelengths.as_deref() };
        ws.chunk.surface.lookup_width = self.transport.lookup_width();
        match &self.transport.estimator {
            estimator @ (Estimator::Paths | Estimator::Seen) => {
                let integrator = PathIntegrator { lit: matches!(estimator, Estimator::Paths) };
                let first = self.begin(&integrator, &batch, ws);
                path::follow(self, &integrator, batch.sample(first), ws, cancelled);
            }
            Estimator::Trees(samples) => {
                let integrator = WhittedIntegrator { samples };
                let first = self.begin(&integrator, &batch, ws);
                whitted::follow(self, &integrator, batch.sample(first), ws, cancelled);
            }
        }
        if self.transport.passes.deep.is_some() {
            ws.deposits.sums.settle_depths();
        }
    }

    /// Adds a sample at each of some raster positions to the sums of its slot; slots differ. For cameras and trees of rays (Whitted).
    ///
    /// There are at most [`gonio_camera::sampler::BATCH`] of them; consecutive sixteen are a packet.
    pub fn trace_at(&self, places: [&[f32]; 2], slots: &[u32], ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        let Estimator::Trees(samples) = &self.transport.estimator else { return };
        self.start_at(places, slots, ws);
        ws.statistics.camera_rays += ws.paths.count as u64;
        let sampler = Sampler::new(self.transport.seed, [0; 2], 1);
        ws.deposits.wavelengths = None;
        let first = SampleContext { sampler, runs: &Runs::whole(0), depth: 0, wavelengths: None };
        whitted::follow(self, &WhittedIntegrator { samples }, first, ws, cancelled);
    }

    /// Finds the nearest hits of camera rays at some raster positions: [`Workspace::hits_by_slot`].
    pub fn first_hits_at(&self, places: [&[f32]; 2], slots: &[u32], ws: &mut Workspace) {
        self.start_at(places, slots, ws);
        ws.statistics.rays += ws.paths.count as u64;
        find_first(self.tables, &self.transport, true, &ws.paths, &mut ws.nearest);
    }

    fn start_at(&self, places: [&[f32]; 2], slots: &[u32], ws: &mut Workspace) {
        ws.chunk.surface.lookup_width = 1.0;
        // Antialiasing compares neighbours, all at one time.
        ws.times.clear();
        ws.paths.set_times(&ws.times);
        if let Start::Camera(camera, _) = self.start {
            dispatch!(self.transport.execution, l => generate_at(l, camera, places, slots, &mut ws.paths));
        }
    }

    /// Starts the paths of a batch, and lights its sensors; returns the depth of the paths.
    fn begin<I: Integrator>(&self, integrator: &I, batch: &Batch<'_>, ws: &mut Workspace) -> u32 {
        let Batch { area, ref sampler, runs, wavelengths } = *batch;
        let column = wavelengths.map(SlotWavelengths::column).unwrap_or_default();
        let time = Instant::now();
        ws.times.draw(self.transport.execution, self.transport.shutter.as_deref(), sampler, runs, area.min[1]);
        let first = match self.start {
            Start::Camera(camera, placement) => {
                let (times, paths) = (ws.times.by_slot(), &mut ws.paths);
                dispatch!(self.transport.execution, l => generate(l, camera, placement, sampler, area, runs, times, column, paths));
                0
            }
            Start::Sensors(sensors) => {
                let queues = &mut ws.queues;
                dispatch!(self.transport.execution, l => {
                    start_sensors(l, sensors, sampler, area, (runs, column), &mut queues.measure, &mut queues.next);
                });
                self.begin_measuring(integrator, batch, ws)
            }
            Start::Places(table) => {
                let Workspace { paths, nearest, queues, covered, .. } = &mut *ws;
                queues.next.clear();
                let (execution, places) = (self.transport.execution, PlaceBatch { sampler, area, runs });
                let count = dispatch!(execution, l => look_at_places(l, self.tables, table, places, nearest));
                find_covered(self.tables, execution, count, nearest, covered);
                dispatch!(execution, l => {
                    let mut started =
                        Started { paths: &mut *paths, hits: &mut nearest.hits, points: &mut queues.measure, covered: &covered[..] };
                    start_places(l, self.tables, table, places, &mut started);
                });
                if table.looks() { 0 } else { self.begin_measuring(integrator, batch, ws) }
            }
            Start::Lights => {
                ws.paths.clear();
                0
            }
        };
        ws.statistics.spent(Stage::Generate, time);
        ws.statistics.camera_rays += ws.paths.count as u64;
        first
    }

    /// Lights the points that are queued, and takes what they started for the batch's paths; returns the depth of the paths.
    fn begin_measuring<I: Integrator>(&self, integrator: &I, batch: &Batch<'_>, ws: &mut Workspace) -> u32 {
        let context = &batch.sample(0);
        steps::measure(self, integrator, context, ws);
        steps::trace_shadows(self, context, ws);
        std::mem::swap(&mut ws.paths, &mut ws.queues.next);
        steps::set_masks(self.tables, &mut ws.paths);
        1
    }
}
