//! Subsurface random walks: from where paths entered a surface to where they come out again, are lit and scatter.
//!
//! All walks of a batch step together: sample a free flight, trace it within the instance, then exit or scatter. Chiang, Kutz, Burley:
//! Practical and Controllable Subsurface Scattering for Production Path Tracing (2016).

use crate::graph::{CHUNK, Program};
use crate::kernels;
use crate::stage::exit::leave;
use crate::stage::surface::{ChunkRays, ChunkSource, store3};
use crate::state::columns::{gather3, load3};
use crate::state::flag;
use crate::state::sample::SampleContext;
use crate::state::vertex::{CONE_PER_ROUGHNESS, Stage, Vertex};
use crate::state::walks::Walks;
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_accel::{Hits, NONE};
use gonio_bsdf::subsurface::{Flight, LEAST_THROUGHPUT, MAXIMUM_STEPS, REDUCED_FROM};
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Frame, Lanes, M, PADDING, Rgb, U, dispatch};

/// Walks until all walks are out or lost; those that are out are lit and scatter.
pub(crate) fn walk(tables: &Tables, transport: &Transport, context: &SampleContext<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
    for step in 0..MAXIMUM_STEPS {
        if ws.walks.count == 0 || cancelled() {
            break;
        }
        dispatch!(transport.execution, l => fly(l, context, step, &mut ws.walks));
        let rays = ws.walks.rays(&ws.shadows.mask);
        tables.bvh.first_hit_within(transport.execution, &rays, &ws.walks.instance, &mut ws.walk_hits);
        ws.statistics.rays += ws.walks.count as u64;
        ws.out.clear();
        ws.out.extend(ws.walk_hits.instance.iter().enumerate().filter(|(_, hit)| **hit != NONE).map(|(walk, _)| walk as u32));
        dispatch!(transport.execution, l => arrive(l, &mut ws.walks, &ws.walk_hits));
        come_out(tables, transport, context, ws);
        dispatch!(transport.execution, l => turn(l, context, step, &mut ws.walks, &ws.walk_hits));
    }
    ws.walks.count = 0;
}

/// The random numbers of a step: two pairs beyond those of all surfaces.
fn step_dimension(context: &SampleContext<'_>, step: u32) -> u32 {
    (1 << 16) + (context.depth * MAXIMUM_STEPS + step) * 2
}

#[inline(always)]
fn random<L: Lanes>(l: L, context: &SampleContext<'_>, slot: U<L>, dimension: u32) -> [F<L>; 2] {
    context.sampler.pair(l, context.index(l, slot), dimension)
}

/// Draws the length of every walk's next flight.
#[inline(always)]
fn fly<L: Lanes>(l: L, context: &SampleContext<'_>, step: u32, walks: &mut Walks) {
    for at in (0..walks.count).step_by(L::COUNT) {
        let mut walk = walks.load(l, at);
        if step == REDUCED_FROM {
            walk.medium = walk.medium.reduced();
            store3(walk.medium.albedo.into(), &mut walks.albedo, at);
            store3(walk.medium.extinction.into(), &mut walks.extinction, at);
            walk.medium.anisotropy.store(&mut walks.anisotropy, at);
        }
        let u = random(l, context, walk.slot, step_dimension(context, step));
        let flight = walk.medium.flight(walk.throughput, u);
        flight.distance.store(&mut walks.distance, at);
        store3(flight.channels.into(), &mut walks.channels, at);
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
fn arrive<L: Lanes>(l: L, walks: &mut Walks, hits: &Hits) {
    for at in (0..walks.count).step_by(L::COUNT) {
        let walk = walks.load(l, at);
        let flight = Flight { distance: l.load(&walks.distance, at), channels: load3(l, &walks.channels, at).into() };
        let here = L::COUNT.min(walks.count - at);
        let mut distance = [0.0; PADDING];
        distance[..here].copy_from_slice(&hits.t[at..at + here]);
        let surface = surface_mask(l, hits, at, walks.count);
        let throughput = walk.medium.arrive(walk.throughput, &flight, l.load(&distance, 0), surface);
        store3(throughput.into(), &mut walks.throughput, at);
    }
}

/// Lights the walks that reached the surface and sends them on, a chunk at a time.
fn come_out(tables: &Tables, transport: &Transport, context: &SampleContext<'_>, ws: &mut Workspace) {
    let out = std::mem::take(&mut ws.out);
    let nothing = Program::default();
    for chunk in out.chunks(CHUNK) {
        let mut order = [chunk[0]; CHUNK + PADDING];
        order[..chunk.len()].copy_from_slice(chunk);
        dispatch!(transport.execution, l => come_out_chunk(l, tables, transport, context, &nothing, &order, chunk.len(), ws));
    }
    ws.out = out;
}

#[expect(clippy::too_many_arguments, reason = "the whole state of a stage comes in here")]
#[inline(always)]
fn come_out_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    transport: &Transport,
    context: &SampleContext<'_>,
    program: &Program,
    order: &[u32; CHUNK + PADDING],
    count: usize,
    ws: &mut Workspace,
) {
    let source = ChunkSource { order, count, rays: ChunkRays::Directions(&ws.walks.direction) };
    kernels::surface_points(l, tables, program, &ws.walk_hits, &source, &mut ws.surface);
    let stage = Stage { l, tables, transport, context, shader: None, hits: 0..count };
    let base = dimension::FIRST_BOUNCE + context.depth * dimension::BOUNCE + dimension::MEASURE;
    for at in (0..count).step_by(L::COUNT) {
        let point = exit_point(l, order, at, l.first(count - at), ws);
        leave(&stage, &point, base, ws);
    }
}

/// Where walks come out; the normal is the direction they are seen from.
#[inline(always)]
fn exit_point<L: Lanes>(l: L, order: &[u32], at: usize, alive: M<L>, ws: &Workspace) -> Vertex<L> {
    let walk = l.load_integers(order, at);
    let (walks, surface) = (&ws.walks, &ws.surface);
    // Surface columns face the ray's start, which is inside; the way out is the other one.
    let normal = -load3(l, &surface.shading_normal, at);
    let flags = l.gather_integers(&walks.flags, walk);
    Vertex {
        alive,
        path: l.u(0),
        position: load3(l, &surface.position, at),
        error: l.load(&surface.error, at),
        geometric: -load3(l, &surface.geometric_normal, at),
        frame: Frame::from_normal(normal),
        wo: normal,
        throughput: gather3(l, &walks.throughput, walk).into(),
        flags,
        counts: l.gather_integers(&walks.counts, walk),
        slot: l.gather_integers(&walks.slot, walk),
        instance: l.gather_integers(&walks.instance, walk),
        width: l.gather(&walks.width, walk),
        spread: l.f(CONE_PER_ROUGHNESS),
        bounces: flags >> flag::BOUNCE_SHIFT,
        medium: Rgb::zero(l),
        behind: Rgb::zero(l),
        all_delta: l.m(false),
        pdf: l.f(0.0),
        share: l.f(0.0),
    }
}

/// Scatters the walks that are still inside and closes the ranks.
#[inline(always)]
fn turn<L: Lanes>(l: L, context: &SampleContext<'_>, step: u32, walks: &mut Walks, hits: &Hits) {
    let count = walks.count;
    walks.count = 0;
    for at in (0..count).step_by(L::COUNT) {
        let mut walk = walks.load(l, at);
        let distance = l.load(&walks.distance, at);
        let lit = walk.throughput.max_component().gt(LEAST_THROUGHPUT) & l.first(count - at);
        let inside = lit.and_not(surface_mask(l, hits, at, count));
        walk.origin = walk.direction.mul_add(distance, walk.origin);
        walk.t_min = l.f(0.0);
        let u = random(l, context, walk.slot, step_dimension(context, step) + 1);
        walk.direction = walk.medium.scatter(walk.direction, u);
        // What is appended lies at or before what was just read.
        walks.append(&walk, inside);
    }
}
