//! Light tracing: paths that start at lights (pbrt's light paths, photon or particle tracing), batch by batch through the same stages as
//! camera paths.

use crate::schedule::steps::{self, MOST_DEPTH};
use crate::schedule::tracer::{Start, Tracer};
use crate::stage::find::found_light::escape;
use crate::stage::find::intersect::find_surfaces;
use crate::stage::find::segments::Segments;
use crate::stage::find::sort::{list_materials, sort_by_material};
use crate::stage::light::shadow::occlude;
use crate::stage::light::textured_emission::emit_from_starts;
use crate::stage::medium;
use crate::stage::shade::closure::choose_closures;
use crate::stage::shade::forward::{LightIntegrator, Splat, Wanted};
use crate::stage::start::emit::{Emission, dim_starts, emit};
use crate::stage::start::start_media::start_media;
use crate::stage::walk::subsurface::{WalkContext, walk};
use crate::state::light_paths::{Arrivals, Escapes};
use crate::state::paths::Paths;
use crate::state::sample::SampleContext;
use crate::state::wavelengths::SlotWavelengths;
use crate::state::workspace::Workspace;
use crate::statistics::Stage;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_camera::sampler::{BATCH, Runs, Sampler};
use gonio_simd::dispatch;
use std::time::Instant;

/// Paths of a batch.
pub const LIGHT_BATCH: usize = BATCH;

/// Takes what light paths bring, bounce by bounce.
pub trait Receiver {
    /// Flux that arrived on surfaces.
    fn arrived(&mut self, arrivals: &Arrivals);
    /// Flux that left the scene.
    fn escaped(&mut self, escapes: &Escapes);
    /// Flux on its way to either.
    fn travelled(&mut self, _: &Segments<'_>) {}
}

/// Traces light paths of a scene.
#[derive(Debug)]
pub struct LightTracer<'a> {
    /// The scene.
    pub tables: &'a Tables,
    /// Settings: limits, execution, seed.
    pub transport: &'a Transport,
    /// Where paths start.
    pub emission: Emission<'a>,
    /// What is wanted of them.
    pub wanted: Wanted<'a>,
}

/// Flux of a batch whose whereabouts no receiver is told; R, G, B.
#[derive(Clone, Copy, Debug, Default)]
pub struct BatchFlux {
    /// What the paths started with.
    pub emitted: [f64; 3],
    /// What was still under way when paths were cut off by the limits' last bounce.
    pub cut_off: [f64; 3],
}

impl LightTracer<'_> {
    /// Traces the paths of a batch; what they bring goes to the receiver, light for the picture to `splats`.
    ///
    /// Random numbers depend on seed and batch alone. `cancelled` is asked once a stage; a cancelled batch is incomplete.
    pub fn trace(
        &self,
        batch: u64,
        receiver: &mut dyn Receiver,
        splats: &mut Vec<Splat>,
        ws: &mut Workspace,
        cancelled: &dyn Fn() -> bool,
    ) -> BatchFlux {
        let time = Instant::now();
        // A set of batches shares one sequence.
        let set = batch / u64::from(BATCHES);
        let sampler = Sampler::new(self.transport.seed ^ OTHER_SEED, [set as u32, (set >> 32) as u32], BATCHES);
        let runs = Runs::whole((batch % u64::from(BATCHES)) as u32);
        let wavelengths = ws.draw_wavelengths(self.tables.wavelengths.as_ref(), self.transport.execution, (&sampler, &runs));
        let first = SampleContext { sampler, runs: &runs, depth: 0, wavelengths: wavelengths.as_deref() };
        ws.times.draw(self.transport.execution, self.transport.shutter.as_deref(), &sampler, &runs, 0);
        let starts = &mut ws.queues.light_paths.starts;
        dispatch!(self.transport.execution, l => emit(l, self.tables, self.emission, &first, batch, starts, &mut ws.paths));
        let from_lights = matches!(self.emission, Emission::Lights(_));
        if self.tables.lights.has_media() && from_lights && !self.wanted.is_whole() {
            let starts = &mut ws.queues.light_paths.starts;
            dispatch!(self.transport.execution, l => dim_starts(l, self.tables, starts));
        }
        if self.tables.lights.any_shaded() && from_lights {
            let room = ws.queues.light_paths.emission.get_or_insert_default();
            emit_from_starts(
                self.tables,
                self.transport.execution,
                &ws.paths,
                &mut ws.queues.light_paths.starts,
                room,
                wavelengths.as_deref(),
            );
        }
        self.find_media(wavelengths.as_deref(), ws);
        ws.paths.set_masks();
        let mut flux = BatchFlux { emitted: self.under_way(&first, ws), ..BatchFlux::default() };
        ws.statistics.spent(Stage::Generate, time);
        ws.statistics.camera_rays += ws.paths.count as u64;
        // Stages ask the tracer for tables and settings alone; no path of it starts.
        let tracer = Tracer { tables: self.tables, start: Start::Lights, transport: self.transport.clone() };
        for depth in 0..MOST_DEPTH {
            if ws.paths.count == 0 || cancelled() {
                return flux;
            }
            self.follow_bounce(&tracer, &SampleContext { depth, ..first }, receiver, splats, ws, cancelled);
            std::mem::swap(&mut ws.paths, &mut ws.queues.next);
            ws.paths.set_masks();
        }
        flux.cut_off = self.under_way(&first, ws);
        flux
    }

    /// What bodies hold the places where the paths start.
    fn find_media(&self, wavelengths: Option<&SlotWavelengths>, ws: &mut Workspace) {
        let bodies = match self.emission {
            Emission::Lights(_) => &self.tables.bodies.around_lights,
            Emission::Rays(_) => &self.tables.bodies.absorbing,
        };
        if bodies.is_empty() {
            return;
        }
        ws.paths.set_times(&ws.times);
        let slots = wavelengths.map(|_| (0..ws.paths.count).map(|path| ws.paths.slot(path)).collect::<Vec<u32>>());
        let wavelengths = wavelengths.zip(slots.as_deref());
        let room = ws.queues.light_paths.media.get_or_insert_default();
        let Paths { count, rays, media, .. } = &mut ws.paths;
        start_media(self.tables, self.transport.execution, bodies, (rays, wavelengths), *count, media, room);
    }

    fn follow_bounce(
        &self,
        tracer: &Tracer<'_>,
        sample: &SampleContext<'_>,
        receiver: &mut dyn Receiver,
        splats: &mut Vec<Splat>,
        ws: &mut Workspace,
        cancelled: &dyn Fn() -> bool,
    ) {
        let Tracer { tables, transport, .. } = tracer;
        let time = Instant::now();
        ws.statistics.rays += ws.paths.count as u64;
        ws.paths.set_times(&ws.times);
        find_surfaces(tables, transport, &ws.paths, &mut ws.nearest);
        receiver.travelled(&Segments::new(tables, (&ws.paths, &ws.nearest.hits), &ws.queues.light_paths.starts, sample.wavelengths));
        ws.queues.next.clear();
        // What light paths bring of caustics alone is dimmed by what scatters: camera paths find the scattered light.
        if tables.materials.media.scatters() && !self.wanted.specular_only {
            medium::pass_light((tables, transport), sample, &mut ws.paths, &mut ws.nearest, &mut ws.queues.next);
        } else if tables.materials.media.varies() {
            medium::dim((tables, transport), sample, &mut ws.paths, &ws.nearest);
        }
        let light_paths = &mut ws.queues.light_paths;
        (light_paths.arrivals.count, light_paths.escapes.count) = (0, 0);
        dispatch!(transport.execution, l => {
            escape(l, (tables, sample), &ws.paths, &mut ws.nearest.escaped, &light_paths.starts, &mut light_paths.escapes);
            list_materials(l, tables, &ws.nearest.hits, &mut ws.materials.material_of);
        });
        choose_closures(tables, transport, sample, &mut ws.paths, &ws.nearest.hits, &mut ws.materials, &mut ws.chunk, None);
        sort_by_material(tables, transport, &mut ws.materials);
        ws.statistics.spent(Stage::Intersect, time);
        steps::shade(tracer, &LightIntegrator { wanted: self.wanted }, sample, ws);
        let time = Instant::now();
        let context = WalkContext { tables, transport, sample, paths: &ws.paths, times: &ws.times, lit: false };
        ws.statistics.rays += walk(&context, &mut ws.walk_hits, &mut ws.chunk, &mut ws.queues, &mut ws.deposits, cancelled);
        self.connect(splats, ws);
        receiver.arrived(&ws.queues.light_paths.arrivals);
        receiver.escaped(&ws.queues.light_paths.escapes);
        ws.statistics.spent(Stage::Shadow, time);
    }

    /// Traces the rays to the camera, and keeps what nothing blocked.
    fn connect(&self, splats: &mut Vec<Splat>, ws: &mut Workspace) {
        let connections = &mut ws.queues.light_paths.connections;
        ws.statistics.shadow_rays += connections.rays.count as u64;
        if connections.rays.count > 0 {
            ws.shadow_trace.wavelengths.clone_from(&ws.wavelengths);
            occlude(self.tables, self.transport, false, &mut connections.rays, &mut ws.shadow_trace, &mut ws.chunk);
            Splat::collect(connections, &ws.shadow_trace, splats);
            connections.rays.count = 0;
        }
    }

    /// Flux of the paths under way.
    fn under_way(&self, sample: &SampleContext<'_>, ws: &Workspace) -> [f64; 3] {
        dispatch!(self.transport.execution, l => sum_flux(l, sample, ws))
    }
}

/// Batches that share one sequence of random numbers: together they are a net.
const BATCHES: u32 = 256;
/// Other random numbers than camera paths'.
const OTHER_SEED: u32 = 0x6c62_272e;

#[inline(always)]
fn sum_flux<L: gonio_simd::Lanes>(l: L, sample: &SampleContext<'_>, ws: &Workspace) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for at in (0..ws.paths.count).step_by(L::COUNT) {
        let path = l.iota() + at as u32;
        let flux = ws.queues.light_paths.starts.carried(l, ws.paths.track(l, path).slot, ws.paths.carried(l, path).throughput);
        let flux = sample.to_film(ws.paths.track(l, path).slot, flux);
        let alive = L::COUNT.min(ws.paths.count - at);
        for (sum, column) in sum.iter_mut().zip([flux.r, flux.g, flux.b]) {
            *sum += column.to_array()[..alive].iter().map(|x| f64::from(*x)).sum::<f64>();
        }
    }
    sum
}
