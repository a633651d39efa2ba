//! Intersection: nearest hits of all paths by packets or ray streams, told apart into light, surface and escaped.
//!
//! Light of shapes and infinite lights is added here, weighted by MIS (multiple importance sampling).

use crate::accumulate::add::add;
use crate::accumulate::deposit::{Contribution, Deposits, Source, code_of_found, to_film};
use crate::accumulate::expression_sums::with_state;
use crate::accumulate::guides::is_specular_path;
use crate::kernels::{self, LightHit};
use crate::stage::light::transmittance;
use crate::state::columns::gather3;
use crate::state::light_paths::{Escapes, LightStarts};
use crate::state::nearest::NearestHits;
use crate::state::paths::{CarriedLanes, Paths, TrackLanes};
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::{code, flag};
use gonio_accel::NONE;
use gonio_light::hit_weight;
use gonio_simd::{Lanes, M, PADDING, U, dispatch};

/// Finds what every path hits, and adds the light that shapes and the environment send.
pub(crate) fn intersect(
    tables: &Tables,
    transport: &Transport,
    depth: u32,
    paths: &mut Paths,
    nearest: &mut NearestHits,
    deposits: &mut Deposits,
) {
    find_first(tables, transport, depth == 0, paths, nearest);
    dispatch!(transport.execution, l => classify(l, tables, nearest));
    while !nearest.at_lights.is_empty() {
        dispatch!(transport.execution, l => add_shapes(l, tables, transport, paths, nearest, deposits));
        pass_through_lights(tables, transport, paths, nearest);
    }
    dispatch!(transport.execution, l => add_environment(l, tables, transport, paths, &mut nearest.escaped, deposits));
}

/// Finds what every light path hits: lights are passed, and send nothing.
pub(crate) fn find_surfaces(tables: &Tables, transport: &Transport, paths: &mut Paths, nearest: &mut NearestHits) {
    tables.bvh.first_hit_in_tree(transport.execution, &paths.rays.batch(0..paths.count), false, &mut nearest.hits);
    dispatch!(transport.execution, l => classify(l, tables, nearest));
    // Many lights stand in the tree.
    while !nearest.at_lights.is_empty() {
        pass_through_lights(tables, transport, paths, nearest);
    }
}

/// Notes the flux of light paths that left the scene.
#[inline(always)]
pub(crate) fn escape<L: Lanes>(l: L, paths: &Paths, escaped: &mut Vec<u32>, starts: &LightStarts, escapes: &mut Escapes) {
    let count = escaped.len();
    escaped.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(escaped, at);
        let TrackLanes { slot, flags, .. } = paths.track(l, path);
        let flux = to_film(starts.carried(l, slot, paths.carried(l, path).throughput));
        let ray = [gather3(l, &paths.rays.origin, path), paths.cone(l, path).direction];
        escapes.append(ray, flux, flags >> flag::BOUNCE_SHIFT, alive);
    }
    escaped.truncate(count);
}

/// Finds what every path hits; `coherent` ones in packets.
pub(crate) fn find_first(tables: &Tables, transport: &Transport, coherent: bool, paths: &Paths, nearest: &mut NearestHits) {
    tables.bvh.first_hit(transport.execution, &paths.rays.batch(0..paths.count), coherent, &mut nearest.hits);
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
fn classify<L: Lanes>(l: L, tables: &Tables, nearest: &mut NearestHits) {
    nearest.escaped.clear();
    nearest.at_lights.clear();
    let instances = &nearest.hits.instance;
    for at in (0..instances.len()).step_by(L::COUNT) {
        let instance = l.load_integers_to_end(instances, at);
        let others = !instance.lt(tables.first_light_instance) & l.first(instances.len() - at);
        if others.any() {
            let (path, escaped) = (l.iota() + at as u32, instance.eq(NONE));
            push(path, others & escaped, &mut nearest.escaped);
            push(path, others.and_not(escaped), &mut nearest.at_lights);
        }
    }
}

/// Adds the emission of light shapes that paths hit, weighted by MIS against next event estimation.
#[inline(always)]
fn add_shapes<L: Lanes>(l: L, tables: &Tables, transport: &Transport, paths: &Paths, nearest: &mut NearestHits, deposits: &mut Deposits) {
    let NearestHits { hits, at_lights, .. } = nearest;
    let count = at_lights.len();
    at_lights.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(at_lights, at);
        let instance = l.gather_integers(&hits.instance, path);
        let light = l.gather_integers(&tables.instance_light, instance - tables.first_light_instance);
        let direction = paths.cone(l, path).direction;
        let from = paths.previous(l, path);
        let point = direction.mul_add(l.gather(&hits.t, path), gather3(l, &paths.rays.origin, path));
        let hit = LightHit { light, from, direction, point };
        let (radiance, pdf) = kernels::eval_light(l, tables, transport.light_cache.as_deref(), &hit, alive);
        let (carried, TrackLanes { slot, flags, .. }) = (paths.carried(l, path), paths.track(l, path));
        let mut weight = hit_weight(carried.pdf, pdf, (flags & flag::DELTA).eq(0));
        if tables.lights.has_factors() {
            let factor = tables.lights.scattered_factor(l, light, (flags >> flag::LAST_SHIFT) & 3);
            weight = (flags & flag::CAMERA).ne(0).select(weight, weight * factor);
        }
        let radiance = if tables.any_absorbing {
            radiance * transmittance::transmittance(l, paths, path, l.gather(&hits.t, path) - paths.rays.passed.distance(l, path))
        } else {
            radiance
        };
        let value = transport.limits.clamped(radiance * carried.throughput * weight, flags >> flag::BOUNCE_SHIFT);
        let code = with_state(transport.passes.expressions.as_deref(), code_of_found(flags, code::EMISSION), flags);
        let specular = is_specular_path(flags, slot);
        let brought = transport.is_brought(flags, light, alive);
        let light = Contribution { slot, value, code, shares: None, specular, source: Source::Light(light) };
        deposits.deposit(transport, &light, (alive & value.is_lit()).and_not(brought));
    }
    at_lights.truncate(count);
}

/// Takes paths on behind the shapes of lights, which block nothing. With loose lights the hit behind was found before; else it is traced.
fn pass_through_lights(tables: &Tables, transport: &Transport, paths: &mut Paths, nearest: &mut NearestHits) {
    let NearestHits { hits, escaped, at_lights, behind_rays, behind } = nearest;
    for path in at_lights.iter() {
        let i = *path as usize;
        // Far enough that the same shape is not met again, near enough that nothing behind it is lost.
        paths.rays.t_min[i] = (hits.t[i] * (1.0 + 1e-6)).next_up();
    }
    behind_rays.select(&paths.rays, at_lights);
    let rays = behind_rays.batch(0..at_lights.len());
    if tables.bvh.has_loose_lights() {
        tables.bvh.first_hit_before(transport.execution, &rays, &hits.covered, behind);
    } else {
        tables.bvh.first_hit(transport.execution, &rays, false, behind);
    }
    std::mem::swap(&mut hits.covered, &mut behind.covered);
    for (from, to) in at_lights.iter().enumerate() {
        let to = *to as usize;
        hits.t[to] = behind.t[from];
        hits.u[to] = behind.u[from];
        hits.v[to] = behind.v[from];
        hits.primitive[to] = behind.primitive[from];
        hits.instance[to] = behind.instance[from];
    }
    escaped.extend(at_lights.iter().filter(|i| hits.instance[**i as usize] == NONE));
    at_lights.retain(|i| {
        let instance = hits.instance[*i as usize];
        instance != NONE && instance >= tables.first_light_instance
    });
}

/// Infinite lights whose caustics light paths bring.
fn brought_infinite<'a>(tables: &'a Tables, transport: &'a Transport) -> impl Iterator<Item = u32> + 'a {
    let brought = transport.light_paths.as_deref().unwrap_or_default();
    tables.lights.infinite_lights().filter(|number| brought.get(*number as usize).is_some_and(|brought| *brought != 0))
}

/// Adds the light of infinite lights to paths that escaped, weighted by MIS against next event estimation.
#[inline(always)]
fn add_environment<L: Lanes>(l: L, tables: &Tables, transport: &Transport, paths: &Paths, escaped: &mut Vec<u32>, deposits: &mut Deposits) {
    let count = escaped.len();
    escaped.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(escaped, at);
        let (CarriedLanes { throughput, pdf }, TrackLanes { slot, flags, .. }) = (paths.carried(l, path), paths.track(l, path));
        let camera = (flags & flag::CAMERA).ne(0);
        if transport.environment_covers {
            // The pdf of camera rays is their share of the sample.
            add(&mut deposits.sums.alpha, slot, pdf, alive & camera);
        }
        let clear = if transport.limits.clear_roughness < 0.0 { l.m(false) } else { alive & (flags & flag::CLEAR).ne(0) };
        if clear.any() {
            // What glass lets pass of nothing does not cover what is behind.
            add(&mut deposits.sums.alpha, slot, -throughput.mean() * (1.0 / transport.squared_index), clear);
        }
        let alive = if transport.shows_environment { alive } else { alive.and_not(camera | clear) };
        let (delta, kind) = ((flags & flag::DELTA).ne(0), (flags >> flag::LAST_SHIFT) & 3);
        let from = paths.previous(l, path);
        let direction = paths.cone(l, path).direction;
        let (light_cache, camera_and_delta) = (transport.light_cache.as_deref(), [camera, delta]);
        let all = kernels::eval_escaped(l, tables, light_cache, from, direction, pdf, camera_and_delta, None, kind);
        let mut sent = all;
        for number in brought_infinite(tables, transport) {
            let brought = transport.is_brought(flags, l.u(number), alive);
            if brought.any() {
                let part = kernels::eval_escaped(l, tables, light_cache, from, direction, pdf, camera_and_delta, Some(number), kind);
                sent = brought.select((sent - part).left_of(all), sent);
            }
        }
        let throughput =
            if tables.any_volume { throughput * transmittance::transmittance(l, paths, path, l.f(f32::MAX)) } else { throughput };
        let unclamped = sent * throughput;
        let value = transport.limits.clamped(unclamped, flags >> flag::BOUNCE_SHIFT);
        let expressions = transport.passes.expressions.as_deref();
        let code = with_state(expressions, code_of_found(flags, code::ENVIRONMENT), flags);
        let specular = is_specular_path(flags, slot);
        let light = Contribution { slot, value, code, shares: None, specular, source: Source::Several };
        let counted = deposits.deposit(transport, &light, alive & value.is_lit());
        let told_apart = expressions.filter(|expressions| expressions.infinite.is_none());
        if (transport.passes.groups.wanted() || told_apart.is_some()) && counted.any() {
            // A limit holds for all of them together.
            let share = value.abs().max_component() / unclamped.abs().max_component().max(f32::MIN_POSITIVE);
            for number in tables.lights.infinite_lights() {
                let value = kernels::eval_escaped(l, tables, light_cache, from, direction, pdf, camera_and_delta, Some(number), kind)
                    * throughput
                    * share;
                let part = Contribution { value, source: Source::Light(l.u(number)), ..light };
                let brought = transport.is_brought(flags, l.u(number), counted);
                let lit = (counted & value.is_lit()).and_not(brought);
                deposits.deposit_to_group(&transport.passes.groups, &part, lit);
                if let Some(expressions) = told_apart {
                    deposits.deposit_to_expressions(expressions, &part, lit);
                }
            }
        }
    }
    escaped.truncate(count);
}
