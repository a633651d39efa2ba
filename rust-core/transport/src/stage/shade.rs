//! Shading: a chunk of hits of one material, whose surface points and parameters are ready.
//!
//! A register of hits at a time: absorption, BSDF lobes, cut-outs, emission with MIS (multiple importance sampling), AOVs, next event
//! estimation, BSDF sampling. Out come contributions, shadow rays, the next rays of paths, and subsurface random walks.

use crate::accumulate::add::{add_light, code_of};
use crate::accumulate::guides;
use crate::accumulate::light_groups::add_of_surfaces;
use crate::accumulate::light_sums::code;
use crate::accumulate::surface_aovs::clamped;
use crate::geometry::NONE;
use crate::kernels::{self, LightHit};
use crate::schedule::whitted;
use crate::stage::first_surface::{append_measure, covered, record_first};
use crate::stage::nee::{light, send};
use crate::stage::scatter::{pass_straight, scatter, straight_left, within};
use crate::stage::{catcher, light_queue};
use crate::state::columns::{gather3, load3};
use crate::state::flag;
use crate::state::light_samples::LightSampleQueue;
use crate::state::paths::{CarriedLanes, TrackLanes};
use crate::state::vertex::{Stage, Vertex};
use crate::state::workspace::Workspace;
use crate::tables::material::SurfaceMaterial;
use crate::tables::material::{parameter_values, threshold};
use crate::tables::transport::PathFilter;
use gonio_bsdf::{Hits, Lobes, ParameterValues, normals::Normals};
use gonio_camera::sampler::dimension;
use gonio_light::power_heuristic;
use gonio_simd::{Frame, Lanes, M, Rgb, Vec3};

/// Shades a chunk, whose surface columns and parameters are ready.
#[inline(always)]
pub(crate) fn shade_chunk<L: Lanes>(stage: &Stage<'_, L>, material: &SurfaceMaterial, ws: &mut Workspace) {
    let Stage { l, tables, transport, ref hits, .. } = *stage;
    let (first, count) = (hits.start, hits.len());
    let outputs = std::mem::take(&mut ws.outputs);
    let values = parameter_values(material, &outputs);
    let mut lobes = Lobes::empty(l);
    ws.light_queue.made = false;
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let mut point = load_point(l, material, first, at, alive, ws);
        if tables.any_absorbing {
            absorb(l, material, &values, &mut point, at, ws);
        }
        let wo = point.frame.to_local(point.wo);
        let entering = l.load(&ws.surface.side, at).gt(0.0);
        let normals = normals(l, material, &point, at, ws);
        let walks = transport.fixed_samples.is_none();
        material.surface.resolve(l, &Hits { values: &values, at, wo, entering, normals: normals.as_ref(), walks }, &mut lobes);
        match &transport.fixed_samples {
            Some(samples) => whitted::shade_lanes(stage, material, &mut point, wo, &lobes, samples, at, ws),
            None => shade_lanes(stage, material, &mut point, wo, &lobes, at, ws),
        }
    }
    ws.outputs = outputs;
}

#[inline(always)]
fn load_point<L: Lanes>(l: L, material: &SurfaceMaterial, first: usize, at: usize, alive: M<L>, ws: &Workspace) -> Vertex<L> {
    let path = l.load_integers(&ws.order, first + at);
    let shading = load3(l, &ws.surface.shading_normal, at);
    let frame =
        if material.anisotropic { Frame::from_tangent(shading, load3(l, &ws.surface.tangent, at)) } else { Frame::from_normal(shading) };
    let CarriedLanes { throughput, pdf } = ws.paths.carried(l, path);
    let TrackLanes { slot, flags, counts, spread } = ws.paths.track(l, path);
    Vertex {
        alive,
        path,
        position: load3(l, &ws.surface.position, at),
        error: l.load(&ws.surface.error, at),
        geometric: load3(l, &ws.surface.geometric_normal, at),
        frame,
        wo: load3(l, &ws.surface.wo, at),
        throughput,
        flags,
        counts,
        slot,
        instance: l.load_integers(&ws.surface.instance, at),
        width: l.load(&ws.surface.cone, at),
        spread,
        bounces: flags >> flag::BOUNCE_SHIFT,
        medium: Rgb::zero(l),
        behind: Rgb::zero(l),
        all_delta: l.m(false),
        pdf,
        share: pdf,
    }
}

/// The normals beside the shading normal, where the material has any.
#[inline(always)]
fn normals<L: Lanes>(l: L, material: &SurfaceMaterial, point: &Vertex<L>, at: usize, ws: &Workspace) -> Option<Normals<L>> {
    let program = &material.program;
    let bent = program.normal.is_some() && program.free_normal;
    if !bent && program.coat_normal.is_none() {
        return None;
    }
    let smooth = if program.normal.is_some() { &ws.surface.smooth_normal } else { &ws.surface.shading_normal };
    let coat = if program.coat_normal.is_some() { Some(point.frame.to_local(load3(l, &ws.surface.coat_normal, at))) } else { None };
    let (geometric, smooth) = (point.frame.to_local(point.geometric), point.frame.to_local(load3(l, smooth, at)));
    Some(Normals { geometric, smooth, coat })
}

/// Dims the path by what it has come through (Beer and Lambert), and looks up what is behind the surface.
#[inline(always)]
fn absorb<L: Lanes>(l: L, material: &SurfaceMaterial, values: &ParameterValues<'_>, point: &mut Vertex<L>, at: usize, ws: &Workspace) {
    let sigma = gather3(l, &ws.paths.medium, point.path);
    point.medium = sigma.into();
    let distance = l.gather(&ws.hits.t, point.path);
    let depth = -sigma * distance;
    point.throughput = point.throughput * Rgb::new(depth.x.exp(), depth.y.exp(), depth.z.exp());
    // Leaving a solid leads to the open.
    let inside = material.surface.absorption(l, values, at);
    point.behind = inside.keep_if(l.load(&ws.surface.side, at).gt(0.0));
}

#[inline(always)]
fn shade_lanes<L: Lanes>(
    stage: &Stage<'_, L>,
    material: &SurfaceMaterial,
    point: &mut Vertex<L>,
    wo: Vec3<L>,
    lobes: &Lobes<'_, L>,
    at: usize,
    ws: &mut Workspace,
) {
    let Stage { l, tables, transport, context, .. } = *stage;
    let index = context.index(l, point.slot);
    let base = dimension::FIRST_BOUNCE + context.depth * dimension::BOUNCE;
    let [u_lobe, u_opacity] = context.sampler.pair(l, index, base + dimension::LOBE);
    let present = if material.surface.lobes.cut_out {
        let seen_through = point.alive & u_opacity.ge(threshold(lobes.opacity(), material.opacity_threshold));
        pass_straight(l, point, seen_through & straight_left(point.counts, transport), ws);
        point.alive.and_not(seen_through)
    } else {
        point.alive
    };
    let present = show(stage, material, point, lobes, present, at, ws);
    let [smooth, going_on] = meet(stage, point, lobes, present, ws);
    let [u_light, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    if (smooth & going_on).any() && !tables.lights.is_empty() {
        if LightSampleQueue::pays::<L>(&tables.lights, stage.hits.len()) {
            let sample = light_queue::sample(stage, at, ws);
            send(stage, point, wo, lobes, &sample, None, going_on, ws);
        } else {
            let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
            light(stage, point, wo, lobes, [u_light, u, v], going_on, ws);
        }
    }
    let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
    let ending = if material.transparent { present.and_not(going_on) } else { l.m(false) };
    scatter(stage, point, wo, lobes, [u_lobe, u, v, u_roulette], [going_on, ending], ws);
}

/// Records the denoisers' guides and measured points; returns where lights can be sampled (not purely specular), and which paths go on.
#[inline(always)]
pub(crate) fn meet<L: Lanes>(
    stage: &Stage<'_, L>,
    point: &mut Vertex<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    ws: &mut Workspace,
) -> [M<L>; 2] {
    let transport = stage.transport;
    let [smooth, all_delta] = lobes.smoothness(stage.l);
    point.all_delta = all_delta;
    guides::record(stage, point, lobes, present, ws);
    // Beyond the last bounce a path still adds emission: the BSDF half of MIS, whose NEE half was sampled before.
    let going_on = present & point.bounces.lt(transport.max_bounces + 1) & within(point.counts, transport.kind_bounces);
    if transport.measure {
        let measured = going_on.and_not(all_delta) & guides::is_specular_path(point.flags, point.slot);
        append_measure(point, measured, &mut ws.measure);
    }
    [smooth, going_on]
}

/// Adds emission and records first-surface AOVs; returns the lanes that are there, holdouts left out.
#[inline(always)]
pub(crate) fn show<L: Lanes>(
    stage: &Stage<'_, L>,
    material: &SurfaceMaterial,
    point: &mut Vertex<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    at: usize,
    ws: &mut Workspace,
) -> M<L> {
    let tables = stage.tables;
    let present = if material.holdout || !tables.geometry.set_holdout.is_empty() {
        covered(stage, material, point, present, at, ws)
    } else {
        present
    };
    if material.surface.lobes.emission {
        add_emission(stage, point, lobes.emission(), present, at, ws);
    }
    // What is seen through a transparent closure comes first.
    if !material.surface.lobes.straight && stage.transport.path_filter != PathFilter::SpecularOnly {
        record_first(stage, material, point, lobes, present, at, ws);
        if !tables.geometry.set_catcher.is_empty() {
            catcher::record(stage, point, present, ws);
        }
    }
    present
}

/// Adds emission, weighted by MIS where the triangle is a light that next event estimation could have sampled.
#[inline(always)]
fn add_emission<L: Lanes>(stage: &Stage<'_, L>, point: &Vertex<L>, emission: Rgb<L>, present: M<L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, transport, context, .. } = *stage;
    let mut value = emission * point.throughput;
    if !tables.triangle_lights.is_empty() {
        let first = l.gather_integers(&tables.triangle_lights, l.load_integers(&ws.surface.instance, at));
        let sampled = present & first.ne(NONE) & (point.flags & flag::DELTA).eq(0);
        if sampled.any() {
            let light = (first + l.load_integers(&ws.surface.primitive, at)).keep_if(sampled);
            let from = ws.paths.vertex(l, point.path);
            let hit = LightHit { light, from: from.position, normal: from.normal, direction: -point.wo, point: point.position };
            let (_, pdf) = kernels::eval_light(l, tables, transport.light_cache.as_deref(), &hit, sampled);
            let weight = sampled.select(power_heuristic(point.pdf, pdf), l.f(1.0));
            value = value * weight;
        }
    }
    let value = clamped(value, transport.clamp(context.depth));
    let arrives = guides::see(transport, point.flags, point.slot, value, present & value.is_lit(), ws);
    add_light(&mut ws.sums, code_of(point.flags, code::EMISSION), point.slot, value, arrives);
    add_of_surfaces(stage, at, point.slot, value, arrives, ws);
}
