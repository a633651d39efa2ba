//! Subsurface random walks: from where paths entered a surface to where they come out again, are lit and scatter.
//!
//! All walks of a batch step together: sample a free flight, trace it within the instance, then exit or scatter. Chiang, Kutz, Burley:
//! Practical and Controllable Subsurface Scattering for Production Path Tracing (2016).

use crate::accumulate::deposit::Deposits;
use crate::graph::{CHUNK, Program};
use crate::kernels;
use crate::stage::find::surface::{ChunkRays, ChunkSource};
use crate::stage::walk::exit::light_and_scatter;
use crate::state::chunk::{ChunkColumns, ChunkContext};
use crate::state::columns::load3;
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use crate::state::queue::walks::{WalkHits, Walks};
use crate::state::sample::SampleContext;
use crate::state::times::SlotTimes;
use crate::state::vertex::{CONE_PER_ROUGHNESS, Interaction, Vertex};
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::{counts, flag};
use gonio_accel::{Hits, NONE};
use gonio_bsdf::subsurface::{Flight, LEAST_THROUGHPUT, MAXIMUM_STEPS, REDUCED_FROM};
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Frame, Lanes, M, PADDING, U, Vec3, dispatch};

/// What the walks of a batch read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WalkContext<'a> {
    pub(crate) tables: &'a Tables,
    pub(crate) transport: &'a Transport,
    pub(crate) sample: &'a SampleContext<'a>,
    pub(crate) paths: &'a Paths,
    pub(crate) times: &'a SlotTimes,
    /// Whether what comes out is lit, as camera paths want it.
    pub(crate) lit: bool,
}

/// Walks until all walks are out or lost; those that are out are lit and scatter. Returns how many rays were traced.
pub(crate) fn walk(
    context: &WalkContext<'_>,
    walk_hits: &mut WalkHits,
    columns: &mut ChunkColumns,
    queues: &mut Queues,
    deposits: &mut Deposits,
    cancelled: &dyn Fn() -> bool,
) -> u64 {
    let WalkContext { tables, transport, sample, .. } = *context;
    let mut rays = 0;
    for step in 0..MAXIMUM_STEPS {
        let walks = &mut queues.walks;
        if walks.count == 0 || cancelled() {
            break;
        }
        dispatch!(transport.execution, l => sample_flights(l, sample, step, walks));
        walks.set_times(context.times);
        tables.bvh.first_hit_within(transport.execution, &walks.rays.batch(0..walks.count), &walks.instance, &mut walk_hits.hits);
        rays += walks.count as u64;
        walk_hits.out.clear();
        walk_hits.out.extend(walk_hits.hits.instance.iter().enumerate().filter(|(_, hit)| **hit != NONE).map(|(walk, _)| walk as u32));
        dispatch!(transport.execution, l => weigh_flights(l, walks, &walk_hits.hits));
        exit_walks(context, walk_hits, columns, queues, deposits);
        dispatch!(transport.execution, l => scatter_walks(l, sample, step, &mut queues.walks, &walk_hits.hits));
    }
    queues.walks.count = 0;
    rays
}

/// The random numbers of a step: two pairs beyond those of all surfaces.
fn step_dimension(sample: &SampleContext<'_>, step: u32) -> u32 {
    (1 << 16) + (sample.depth * MAXIMUM_STEPS + step) * 2
}

#[inline(always)]
fn random<L: Lanes>(l: L, sample: &SampleContext<'_>, slot: U<L>, dimension: u32) -> [F<L>; 2] {
    sample.sampler.pair(l, sample.index(l, slot), dimension)
}

/// Draws the length of every walk's next flight.
#[inline(always)]
fn sample_flights<L: Lanes>(l: L, sample: &SampleContext<'_>, step: u32, walks: &mut Walks) {
    for at in (0..walks.count).step_by(L::COUNT) {
        let mut walk = walks.load(l, at);
        if step == REDUCED_FROM {
            walk.medium = walk.medium.reduced();
            walks.albedo.store(walk.medium.albedo, at);
            walks.extinction.store(walk.medium.extinction, at);
            walk.medium.anisotropy.store(&mut walks.anisotropy, at);
        }
        let u = random(l, sample, walk.core.slot, step_dimension(sample, step));
        let flight = walk.medium.flight(walk.core.throughput, u);
        flight.distance.store(&mut walks.rays.t_max, at);
        walks.channels.store(flight.channels, at);
    }
}

/// Where walks met the surface.
#[inline(always)]
fn surface_mask<L: Lanes>(l: L, hits: &Hits, at: usize, count: usize) -> M<L> {
    let mut bits = 0u64;
    for lane in 0..L::COUNT.min(count - at) {
        bits |= u64::from(hits.instance[at + lane] != NONE) << lane;
    }
    M(l.mask_from_bits(bits))
}

/// Weighs the flights, which end at the surface or at a scattering.
#[inline(always)]
fn weigh_flights<L: Lanes>(l: L, walks: &mut Walks, hits: &Hits) {
    for at in (0..walks.count).step_by(L::COUNT) {
        let walk = walks.load(l, at);
        let flight = Flight { distance: l.load(&walks.rays.t_max, at), channels: walks.channels.load(l, at) };
        let here = L::COUNT.min(walks.count - at);
        let mut distance = [0.0; PADDING];
        distance[..here].copy_from_slice(&hits.t[at..at + here]);
        let surface = surface_mask(l, hits, at, walks.count);
        let throughput = walk.medium.arrive(walk.core.throughput, &flight, l.load(&distance, 0), surface);
        walks.throughput.store(throughput, at);
    }
}

/// Lights the walks that reached the surface and sends them on, a chunk at a time; where materials bend normals, a material at a time.
fn exit_walks(
    context: &WalkContext<'_>,
    walk_hits: &mut WalkHits,
    columns: &mut ChunkColumns,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    let WalkContext { tables, .. } = *context;
    let WalkHits { hits, out } = walk_hits;
    if !tables.materials.any_exit {
        return exit_alike(context, &Program::default(), (hits, out), columns, queues, deposits);
    }
    let material = |walk: u32| tables.geometry.material(hits.instance[walk as usize], hits.primitive[walk as usize]);
    out.sort_unstable_by_key(|walk| (material(*walk), *walk));
    for same in out.chunk_by(|one, next| material(*one) == material(*next)) {
        let nothing = Program::default();
        let program = tables.materials.exit(material(same[0])).unwrap_or(&nothing);
        exit_alike(context, program, (hits, same), columns, queues, deposits);
    }
}

/// Lights and sends on the walks that come `out` of surfaces whose normals a program bends alike.
fn exit_alike(
    context: &WalkContext<'_>,
    program: &Program,
    (hits, out): (&Hits, &[u32]),
    columns: &mut ChunkColumns,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    for chunk in out.chunks(CHUNK) {
        let mut order = [chunk[0]; CHUNK + PADDING];
        order[..chunk.len()].copy_from_slice(chunk);
        dispatch!(context.transport.execution, l => {
            let source = ChunkSource { order: &order, count: chunk.len(), rays: ChunkRays::Walks(&queues.walks) };
            kernels::run_program(l, context.tables, program, hits, &source, columns);
            exit_chunk(l, context, hits, (&order, chunk.len()), columns, queues, deposits);
        });
    }
}

#[inline(always)]
fn exit_chunk<L: Lanes>(
    l: L,
    context: &WalkContext<'_>,
    hits: &Hits,
    (order, count): (&[u32], usize),
    columns: &ChunkColumns,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    let WalkContext { tables, transport, sample, paths, lit, .. } = *context;
    let chunk = ChunkContext { l, tables, transport, sample, shader: None, count, order, paths, hits, columns, straight: counts::STRAIGHT };
    let base = sample.dimension(dimension::EXIT);
    for at in (0..count).step_by(L::COUNT) {
        let point = exit_point(&chunk, at, &queues.walks);
        light_and_scatter(&chunk, &point, base, lit, queues, deposits);
    }
}

/// Where walks come out; the normal is the direction they are seen from.
#[inline(always)]
fn exit_point<L: Lanes>(chunk: &ChunkContext<'_, L>, at: usize, walks: &Walks) -> Vertex<L> {
    let (l, surface) = (chunk.l, &chunk.columns.surface);
    let walk = l.load_integers(chunk.order, at);
    let normal = load3(l, &surface.shading_normal, at);
    let instance = l.gather_integers(&walks.instance, walk);
    let place = Interaction {
        position: load3(l, &surface.position, at),
        error: l.load(&surface.error, at),
        geometric: load3(l, &surface.geometric_normal, at),
        frame: Frame::from_normal(normal),
        receiver: chunk.tables.links.receiver(l, instance),
    };
    let mut core = walks.core(l, walk, chunk.paths, chunk.tables.any_absorbing);
    core.spread = l.f(CONE_PER_ROUGHNESS);
    // Light paths bring nothing to where a walk comes out.
    core.flags = core.flags | (flag::WALKED | flag::ROUGH);
    Vertex::new(place, [normal, Vec3::splat(l, [0.0, 0.0, 1.0])], core, [l.u(0), instance], at, l.first(chunk.count - at))
}

/// Scatters the walks that are still inside and closes the ranks.
#[inline(always)]
fn scatter_walks<L: Lanes>(l: L, sample: &SampleContext<'_>, step: u32, walks: &mut Walks, hits: &Hits) {
    let count = walks.count;
    walks.count = 0;
    for at in (0..count).step_by(L::COUNT) {
        let mut walk = walks.load(l, at);
        let lit = walk.core.throughput.max_component().gt(LEAST_THROUGHPUT) & l.first(count - at);
        let inside = lit.and_not(surface_mask(l, hits, at, count));
        walk.ray.origin = walk.ray.direction.mul_add(walk.ray.t_max, walk.ray.origin);
        walk.ray.t_min = l.f(0.0);
        let u = random(l, sample, walk.core.slot, step_dimension(sample, step) + 1);
        walk.ray.direction = walk.medium.scatter(walk.ray.direction, u);
        // What is appended lies at or before what was just read.
        walks.append(&walk, inside);
    }
}
