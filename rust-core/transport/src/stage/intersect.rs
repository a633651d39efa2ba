//! Intersection: nearest hits of all paths by packets or ray streams, told apart into light, surface and escaped.
//!
//! Light of shapes and infinite lights is added here, weighted by MIS (multiple importance sampling). Out come the materials of surface hits.

use crate::accumulate::add::{add, add_light, code_of};
use crate::accumulate::guides;
use crate::accumulate::light_groups::add_of_lights;
use crate::accumulate::light_sums::code;
use crate::accumulate::surface_aovs::clamped;
use crate::kernels::{self, LightHit};
use crate::stage::catcher;
use crate::stage::sort::list_materials;
use crate::state::columns::gather3;
use crate::state::flag;
use crate::state::paths::{CarriedLanes, Paths, TrackLanes, VertexLanes};
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_accel::{NONE, RayBatch};
use gonio_light::power_heuristic;
use gonio_simd::{Lanes, M, PADDING, U, dispatch};

/// Finds what every path hits, adds the light that shapes and the environment send, and looks up the materials of the surface hits.
pub(crate) fn intersect(tables: &Tables, transport: &Transport, depth: u32, ws: &mut Workspace) {
    find_first(tables, transport, depth == 0, ws);
    dispatch!(transport.execution, l => classify(l, tables, ws));
    while !ws.at_lights.is_empty() {
        dispatch!(transport.execution, l => add_shapes(l, tables, transport, depth, ws));
        pass_through_lights(tables, transport, ws);
    }
    let count = ws.escaped.len();
    dispatch!(transport.execution, l => add_environment(l, tables, transport, depth, ws));
    let lanes = transport.execution.lanes();
    ws.statistics.count_lanes(depth, 0, count.next_multiple_of(lanes), count);
    catcher::fork(tables, ws);
    dispatch!(transport.execution, l => list_materials(l, tables, ws));
}

/// Finds what every path hits; `coherent` ones in packets.
pub(crate) fn find_first(tables: &Tables, transport: &Transport, coherent: bool, ws: &mut Workspace) {
    ws.statistics.rays += ws.paths.count as u64;
    tables.bvh.first_hit(transport.execution, &rays_of(&ws.paths), coherent, &mut ws.hits);
}

fn rays_of(paths: &Paths) -> RayBatch<'_> {
    let n = paths.count;
    RayBatch {
        origin: [&paths.origin[0][..n], &paths.origin[1][..n], &paths.origin[2][..n]],
        direction: [&paths.direction[0][..n], &paths.direction[1][..n], &paths.direction[2][..n]],
        t_min: &paths.t_min[..n],
        t_max: &paths.t_max[..n],
        mask: &paths.mask[..n],
    }
}

/// Appends the numbers of some lanes.
#[inline(always)]
fn push<L: Lanes>(numbers: U<L>, chosen: M<L>, list: &mut Vec<u32>) {
    let mut first = [0; PADDING];
    numbers.append(chosen, &mut first, 0);
    list.extend_from_slice(&first[..chosen.count()]);
}

/// Lists the paths that escaped and those that stand before a light's shape.
#[inline(always)]
fn classify<L: Lanes>(l: L, tables: &Tables, ws: &mut Workspace) {
    ws.escaped.clear();
    ws.at_lights.clear();
    let instances = &ws.hits.instance;
    for at in (0..instances.len()).step_by(L::COUNT) {
        let instance = l.load_integers_to_end(instances, at);
        let others = !instance.lt(tables.first_light_instance) & l.first(instances.len() - at);
        if others.any() {
            let (path, escaped) = (l.iota() + at as u32, instance.eq(NONE));
            push(path, others & escaped, &mut ws.escaped);
            push(path, others.and_not(escaped), &mut ws.at_lights);
        }
    }
}

/// Adds the emission of light shapes that paths hit, weighted by MIS against next event estimation.
#[inline(always)]
fn add_shapes<L: Lanes>(l: L, tables: &Tables, transport: &Transport, depth: u32, ws: &mut Workspace) {
    let count = ws.at_lights.len();
    ws.at_lights.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(&ws.at_lights, at);
        let instance = l.gather_integers(&ws.hits.instance, path);
        let light = l.gather_integers(&tables.instance_light, instance - tables.first_light_instance);
        let direction = ws.paths.cone(l, path).direction;
        let from = ws.paths.vertex(l, path);
        let point = direction.mul_add(l.gather(&ws.hits.t, path), gather3(l, &ws.paths.origin, path));
        let hit = LightHit { light, from: from.position, normal: from.normal, direction, point };
        let (radiance, pdf) = kernels::eval_light(l, tables, transport.light_cache.as_deref(), &hit, alive);
        let (carried, TrackLanes { slot, flags, .. }) = (ws.paths.carried(l, path), ws.paths.track(l, path));
        let sampled = (flags & flag::DELTA).eq(0);
        let weight = sampled.select(power_heuristic(carried.pdf, pdf), l.f(1.0));
        let value = clamped(radiance * carried.throughput * weight, transport.clamp(depth));
        let arrives = guides::see(transport, flags, slot, value, alive & value.is_lit(), ws);
        add_light(&mut ws.sums, code_of(flags, code::EMISSION), slot, value, arrives);
        add_of_lights(l, &transport.passes.groups, light, slot, value, arrives, &mut ws.sums.groups);
    }
    ws.at_lights.truncate(count);
}

/// Takes paths on behind the shapes of lights, which block nothing. With loose lights the hit behind was found before; else it is traced.
fn pass_through_lights(tables: &Tables, transport: &Transport, ws: &mut Workspace) {
    for path in &ws.at_lights {
        let i = *path as usize;
        // Far enough that the same shape is not met again, near enough that nothing behind it is lost.
        ws.paths.t_min[i] = (ws.hits.t[i] * (1.0 + 1e-6)).next_up();
    }
    let mut waiting = std::mem::take(&mut ws.at_lights);
    ws.retraced_rays.select(&ws.paths, &waiting);
    let chosen = &ws.retraced_rays;
    let rays = RayBatch {
        origin: [&chosen.origin[0], &chosen.origin[1], &chosen.origin[2]],
        direction: [&chosen.direction[0], &chosen.direction[1], &chosen.direction[2]],
        t_min: &chosen.t_min,
        t_max: &chosen.t_max,
        mask: &chosen.mask,
    };
    if tables.bvh.has_loose_lights() {
        tables.bvh.first_hit_before(transport.execution, &rays, &ws.hits.covered, &mut ws.retraced);
    } else {
        tables.bvh.first_hit(transport.execution, &rays, false, &mut ws.retraced);
    }
    std::mem::swap(&mut ws.hits.covered, &mut ws.retraced.covered);
    for (from, to) in waiting.iter().enumerate() {
        let to = *to as usize;
        ws.hits.t[to] = ws.retraced.t[from];
        ws.hits.u[to] = ws.retraced.u[from];
        ws.hits.v[to] = ws.retraced.v[from];
        ws.hits.primitive[to] = ws.retraced.primitive[from];
        ws.hits.instance[to] = ws.retraced.instance[from];
    }
    let hits = &ws.hits;
    ws.escaped.extend(waiting.iter().filter(|i| hits.instance[**i as usize] == NONE));
    waiting.retain(|i| {
        let instance = hits.instance[*i as usize];
        instance != NONE && instance >= tables.first_light_instance
    });
    ws.at_lights = waiting;
}

/// Adds the light of infinite lights to paths that escaped, weighted by MIS against next event estimation.
#[inline(always)]
fn add_environment<L: Lanes>(l: L, tables: &Tables, transport: &Transport, depth: u32, ws: &mut Workspace) {
    let count = ws.escaped.len();
    ws.escaped.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(&ws.escaped, at);
        let (CarriedLanes { throughput, pdf }, TrackLanes { slot, flags, .. }) = (ws.paths.carried(l, path), ws.paths.track(l, path));
        let camera = (flags & flag::CAMERA).ne(0);
        if transport.environment_covers {
            add(&mut ws.sums.alpha, slot, pdf, alive & camera);
        }
        let alive = if transport.shows_environment { alive } else { alive.and_not(camera) };
        let delta = (flags & flag::DELTA).ne(0);
        let VertexLanes { position, normal } = ws.paths.vertex(l, path);
        let from = [position, normal];
        let direction = ws.paths.cone(l, path).direction;
        let (light_cache, first) = (transport.light_cache.as_deref(), [camera, delta]);
        let unclamped = kernels::eval_escaped(l, tables, light_cache, from, direction, pdf, first, None) * throughput;
        let value = clamped(unclamped, transport.clamp(depth));
        let arrives = guides::see(transport, flags, slot, value, alive & value.is_lit(), ws);
        add_light(&mut ws.sums, code_of(flags, code::ENVIRONMENT), slot, value, arrives);
        if transport.passes.groups.wanted() && arrives.any() {
            // A limit holds for all of them together.
            let share = value.max_component() / unclamped.max_component().max(f32::MIN_POSITIVE);
            for light in tables.lights.infinite_lights() {
                let part = kernels::eval_escaped(l, tables, light_cache, from, direction, pdf, first, Some(light)) * throughput * share;
                add_of_lights(l, &transport.passes.groups, l.u(light), slot, part, arrives & part.is_lit(), &mut ws.sums.groups);
            }
        }
    }
}
