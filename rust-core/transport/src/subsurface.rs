//! Light under surfaces: walks from where paths entered to where they come out again, and what they do there.
//!
//! All walks of a batch take their steps together: a flight each, a ray within the same instance, then out or scattered. Chiang, Kutz, Burley:
//! Practical and Controllable Subsurface Scattering for Production Path Tracing (2016).

use super::{
    columns::{Columns3, append3, columns3, gather3, load3},
    exit::leave,
    flag, kernels,
    material::Tables,
    path::SampleContext,
    shade::{CONE_PER_ROUGHNESS, Point, Stage},
    surface::{ChunkRays, ChunkSource, store3},
    transport::Transport,
    workspace::Workspace,
};
use crate::graph::{CHUNK, Program};
use gonio_accel::{Hits, NONE, RayBatch};
use gonio_bsdf::subsurface::{Flight, LEAST_THROUGHPUT, MAXIMUM_STEPS, Medium, REDUCED_FROM};
use gonio_camera::sampler::CAPACITY;
use gonio_camera::sampler::dimension;
use gonio_simd::{Column, F, Frame, Lanes, M, PADDING, Rgb, U, Vec3, dispatch, padded};

/// Walks under way, a column entry each.
#[derive(Debug)]
pub(super) struct Walks {
    pub(super) count: usize,
    origin: Columns3,
    direction: Columns3,
    /// Distance within which the surface that was entered is not met again: walks start on it, for an offset would count as depth.
    t_min: Column,
    throughput: Columns3,
    albedo: Columns3,
    extinction: Columns3,
    anisotropy: Column,
    /// Length of the flight, and the probabilities of the channels it was drawn by.
    distance: Column,
    channels: Columns3,
    instance: Column<u32>,
    slot: Column<u32>,
    flags: Column<u32>,
    counts: Column<u32>,
    width: Column,
}

impl Default for Walks {
    fn default() -> Self {
        let room = padded(CAPACITY) + PADDING;
        let three = || columns3(room);
        Self {
            count: 0,
            origin: three(),
            direction: three(),
            t_min: Column::new(room),
            throughput: three(),
            albedo: three(),
            extinction: three(),
            anisotropy: Column::new(room),
            distance: Column::new(room),
            channels: three(),
            instance: Column::new(room),
            slot: Column::new(room),
            flags: Column::new(room),
            counts: Column::new(room),
            width: Column::new(room),
        }
    }
}

/// One register of walks.
#[derive(Clone, Copy, Debug)]
pub(super) struct WalkLanes<L: Lanes> {
    pub(super) origin: Vec3<L>,
    pub(super) direction: Vec3<L>,
    pub(super) t_min: F<L>,
    pub(super) throughput: Rgb<L>,
    pub(super) medium: Medium<L>,
    pub(super) instance: U<L>,
    pub(super) slot: U<L>,
    pub(super) flags: U<L>,
    pub(super) counts: U<L>,
    pub(super) width: F<L>,
}

impl Walks {
    #[inline(always)]
    pub(super) fn append<L: Lanes>(&mut self, w: &WalkLanes<L>, chosen: M<L>) {
        let n = self.count;
        append3(w.origin, chosen, &mut self.origin, n);
        append3(w.direction, chosen, &mut self.direction, n);
        w.t_min.append(chosen, &mut self.t_min, n);
        append3(w.throughput.into(), chosen, &mut self.throughput, n);
        append3(w.medium.albedo.into(), chosen, &mut self.albedo, n);
        append3(w.medium.extinction.into(), chosen, &mut self.extinction, n);
        w.medium.anisotropy.append(chosen, &mut self.anisotropy, n);
        w.instance.append(chosen, &mut self.instance, n);
        w.slot.append(chosen, &mut self.slot, n);
        w.flags.append(chosen, &mut self.flags, n);
        w.counts.append(chosen, &mut self.counts, n);
        w.width.append(chosen, &mut self.width, n);
        self.count += chosen.count();
    }

    #[inline(always)]
    fn load<L: Lanes>(&self, l: L, at: usize) -> WalkLanes<L> {
        WalkLanes {
            origin: load3(l, &self.origin, at),
            direction: load3(l, &self.direction, at),
            t_min: l.load(&self.t_min, at),
            throughput: load3(l, &self.throughput, at).into(),
            medium: Medium {
                albedo: load3(l, &self.albedo, at).into(),
                extinction: load3(l, &self.extinction, at).into(),
                anisotropy: l.load(&self.anisotropy, at),
            },
            instance: l.load_integers(&self.instance, at),
            slot: l.load_integers(&self.slot, at),
            flags: l.load_integers(&self.flags, at),
            counts: l.load_integers(&self.counts, at),
            width: l.load(&self.width, at),
        }
    }

    fn rays<'a>(&'a self, mask: &'a [u8]) -> RayBatch<'a> {
        let n = self.count;
        RayBatch {
            origin: [&self.origin[0][..n], &self.origin[1][..n], &self.origin[2][..n]],
            direction: [&self.direction[0][..n], &self.direction[1][..n], &self.direction[2][..n]],
            t_min: &self.t_min[..n],
            t_max: &self.distance[..n],
            mask: &mask[..n],
        }
    }
}

/// Walks until all walks are out or lost; those that are out are lit and scatter.
pub(super) fn walk(tables: &Tables, transport: &Transport, context: &SampleContext<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
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
fn exit_point<L: Lanes>(l: L, order: &[u32], at: usize, alive: M<L>, ws: &Workspace) -> Point<L> {
    let walk = l.load_integers(order, at);
    let (walks, surface) = (&ws.walks, &ws.surface);
    // Surface columns face the ray's start, which is inside; the way out is the other one.
    let normal = -load3(l, &surface.shading_normal, at);
    let flags = l.gather_integers(&walks.flags, walk);
    Point {
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
        only_delta: l.m(false),
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
