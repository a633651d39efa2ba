//! The path tracer: the wavefront schedule, stage by stage and bounce by bounce (pbrt's `WavefrontPathIntegrator::Render`).
//!
//! In go a tile's pixels and the samples of a batch, out come the sums of the [`Workspace`]. Stages are in `stage`, one file each.

use crate::kernels;
use crate::schedule::whitted;
use crate::stage::catcher;
use crate::stage::closure::choose_closures;
use crate::stage::generate::{TileArea, generate, generate_at};
use crate::stage::intersect::{find_first, intersect};
use crate::stage::measure::measure;
use crate::stage::sensors::{SensorTable, place};
use crate::stage::shade::shade_chunk;
use crate::stage::shadow::{make_room, trace_shadows};
use crate::stage::sort::sort_by_material;
use crate::stage::subsurface::walk;
use crate::stage::surface::{ChunkRays, ChunkSource};
use crate::state::flag;
use crate::state::sample::SampleContext;
use crate::state::vertex::Stage;
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_camera::CameraTable;
use gonio_camera::Placement;
use gonio_camera::sampler::Runs;
use gonio_camera::sampler::Sampler;
use gonio_simd::{Lanes, dispatch};
use std::time::Instant;

/// Most surfaces of a path, those that it went straight through included: a guard against endless stacks of cut-outs.
pub(crate) const MOST_DEPTH: u32 = 256;

/// Where paths start.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// At a camera, at places in the pixels.
    Camera(&'a CameraTable, &'a Placement),
    /// At sensors; depth 1 is their first rays'.
    Sensors(&'a SensorTable),
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

impl Tracer<'_> {
    /// Adds the samples of a batch to the workspace's sums, those of pixels in `[min, max)` (at most a tile's width).
    ///
    /// `cancelled` is asked once a stage; a cancelled batch leaves the sums incomplete.
    pub fn trace(&self, min: [u32; 2], max: [u32; 2], runs: &Runs, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        let execution = self.transport.execution;
        let tile = [min[0] / gonio_camera::sampler::TILE as u32, min[1] / gonio_camera::sampler::TILE as u32];
        let sampler = Sampler::new(self.transport.seed, tile, self.transport.samples);
        let area = TileArea { min, max };
        let time = Instant::now();
        let first = match self.start {
            Start::Camera(camera, placement) => {
                dispatch!(execution, l => generate(l, camera, placement, &sampler, area, runs, &mut ws.paths));
                0
            }
            Start::Sensors(sensors) => {
                dispatch!(execution, l => place(l, sensors, &sampler, area, runs, ws));
                self.light_sensors(&SampleContext { sampler, runs, depth: 0 }, ws);
                1
            }
        };
        ws.statistics.spent(0, time);
        ws.statistics.camera_rays += ws.paths.count as u64;
        if self.transport.fixed_samples.is_some() {
            whitted::follow(self, sampler, runs, first, ws, cancelled);
        } else {
            self.follow(sampler, runs, first, ws, cancelled);
        }
    }

    /// Adds a sample at each of some raster positions to the sums of its slot; slots differ. For cameras and trees of rays (Whitted).
    ///
    /// There are at most [`gonio_camera::sampler::BATCH`] of them; consecutive sixteen are a packet.
    pub fn trace_at(&self, places: [&[f32]; 2], slots: &[u32], ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        self.start_at(places, slots, ws);
        ws.statistics.camera_rays += ws.paths.count as u64;
        whitted::follow(self, Sampler::new(self.transport.seed, [0; 2], 1), &Runs::whole(0), 0, ws, cancelled);
    }

    /// Finds the nearest hits of camera rays at some raster positions: [`Workspace::hits_by_slot`].
    pub fn first_hits_at(&self, places: [&[f32]; 2], slots: &[u32], ws: &mut Workspace) {
        self.start_at(places, slots, ws);
        find_first(self.tables, &self.transport, true, ws);
    }

    fn start_at(&self, places: [&[f32]; 2], slots: &[u32], ws: &mut Workspace) {
        if let Start::Camera(camera, _) = self.start {
            dispatch!(self.transport.execution, l => generate_at(l, camera, places, slots, &mut ws.paths));
        }
    }

    /// Follows all paths to their ends, bounce by bounce.
    fn follow(&self, sampler: Sampler, runs: &Runs, first: u32, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        for depth in first..MOST_DEPTH {
            if ws.paths.count == 0 || cancelled() {
                break;
            }
            let context = SampleContext { sampler, runs, depth };
            let mut time = Instant::now();
            intersect(self.tables, &self.transport, depth, ws);
            choose_closures(self.tables, &self.transport, &context, ws);
            sort_by_material(self.tables, &self.transport, ws);
            ws.statistics.spent(1, time);
            ws.next.count = 0;
            self.shade(&context, ws);
            time = Instant::now();
            walk(self.tables, &self.transport, &context, ws, cancelled);
            measure(self.tables, &self.transport, &context, ws);
            trace_shadows(self.tables, &self.transport, depth == 0, ws);
            ws.statistics.spent(5, time);
            std::mem::swap(&mut ws.paths, &mut ws.next);
            catcher::join(self.tables, &mut ws.paths);
            ws.paths.set_masks();
            catcher::set_masks(self.tables, &mut ws.paths);
        }
    }

    /// Lights the sensors and starts their paths.
    fn light_sensors(&self, context: &SampleContext<'_>, ws: &mut Workspace) {
        measure(self.tables, &self.transport, context, ws);
        trace_shadows(self.tables, &self.transport, true, ws);
        std::mem::swap(&mut ws.paths, &mut ws.next);
        ws.paths.set_masks();
        catcher::set_masks(self.tables, &mut ws.paths);
    }

    /// Shades all surface hits, material by material, a chunk at a time.
    pub(crate) fn shade(&self, context: &SampleContext<'_>, ws: &mut Workspace) {
        let most = self.transport.hits_together();
        for material in 0..self.tables.materials.surfaces.len() {
            let (mut first, end) = (ws.material_start[material] as usize, ws.material_end[material] as usize);
            while first < end {
                let count = (end - first).min(most);
                make_room(self.tables, &self.transport, context.depth == 0, count, ws);
                dispatch!(self.transport.execution, l => self.shade_one(l, context, material, first, count, ws));
                first += count;
            }
        }
    }

    #[inline(always)]
    fn shade_one<L: Lanes>(&self, l: L, context: &SampleContext<'_>, material: usize, first: usize, count: usize, ws: &mut Workspace) {
        let shader = ws.shader_program(&self.transport, material, first, count);
        let material = &self.tables.materials.surfaces[material];
        let start = Instant::now();
        let source = ChunkSource { order: &ws.order[first..], count, rays: ChunkRays::Paths(&ws.paths) };
        kernels::surface_points(l, self.tables, &material.program, &ws.hits, &source, &mut ws.surface);
        let mut start = ws.statistics.spent(2, start);
        if let Some(program) = shader {
            // Before the surface's own program bends the normals.
            kernels::evaluate(l, self.tables, program, &mut ws.surface, count, &mut ws.scratch, &mut ws.shader_outputs);
        }
        if !material.program.is_empty() {
            kernels::evaluate(l, self.tables, &material.program, &mut ws.surface, count, &mut ws.scratch, &mut ws.outputs);
        }
        start = ws.statistics.spent(3, start);
        let (sent, going_on) = (ws.shadows.count, ws.next.count);
        let hits = first..first + count;
        shade_chunk(&Stage { l, tables: self.tables, transport: &self.transport, context, shader, hits }, material, ws);
        ws.statistics.spent(4, start);
        let run = count.next_multiple_of(L::COUNT);
        for (stage, alive) in [(1, count), (2, ws.shadows.count - sent), (3, ws.next.count - going_on)] {
            ws.statistics.count_lanes(context.depth, stage, run, alive);
        }
    }
}

const _: () = assert!(MOST_DEPTH < 1 << (32 - flag::BOUNCE_SHIFT));
