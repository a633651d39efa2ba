//! The fourth stage: a chunk of hits of one material emits, is lit, and scatters.

use super::{
    accumulate::clamped,
    bounce::{pass_straight, scatter, straight_left, within},
    catcher,
    columns::{gather3, load3},
    direct_light::{light, send},
    first_surface::{append_measure, covered, record_first},
    flag, guides,
    kernels::{self, LightHit},
    light_draws::{self, LightDraws},
    light_groups::add_of_surfaces,
    light_sums::code,
    material::{SurfaceMaterial, Tables},
    path::SampleContext,
    paths::{CarriedLanes, TrackLanes},
    scatter::{add_light, code_of},
    transport::{Sight, Transport},
    whitted,
    workspace::Workspace,
};
use crate::{
    geometry::NONE,
    graph::{OutputColumns, Program},
};
use gonio_bsdf::{Hits, Lobes, ParameterValues, normals::Normals, parameter::COUNT};
use gonio_camera::sampler::dimension;
use gonio_light::power_heuristic;
use gonio_simd::{F, Frame, Lanes, M, Rgb, U, Vec3};
use std::ops::Range;

/// Roughness widens a path's cone by this much, radians: blurred reflections need no sharp textures.
pub(super) const CONE_PER_ROUGHNESS: f32 = 0.3;

/// The parameters of a chunk: constants, and the columns a program computed.
pub(super) fn parameter_values<'a>(material: &'a SurfaceMaterial, outputs: &'a OutputColumns) -> ParameterValues<'a> {
    let mut values = ParameterValues::constant(&material.surface.constants);
    fill_columns(&material.program, outputs, &mut values.columns);
    values
}

fn fill_columns<'a>(program: &Program, outputs: &'a OutputColumns, columns: &mut [Option<&'a [f32]>; COUNT]) {
    let mut place = 0;
    for output in &program.outputs {
        for i in 0..output.width {
            columns[output.offset + i] = Some(outputs.column(place));
            place += 1;
        }
    }
}

/// One register of shading points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<L: Lanes> {
    pub(super) alive: M<L>,
    pub(super) path: U<L>,
    pub(super) position: Vec3<L>,
    pub(super) error: F<L>,
    pub(super) geometric: Vec3<L>,
    pub(super) frame: Frame<L>,
    pub(super) wo: Vec3<L>,
    pub(super) throughput: Rgb<L>,
    pub(super) flags: U<L>,
    pub(super) counts: U<L>,
    pub(super) slot: U<L>,
    pub(super) instance: U<L>,
    pub(super) width: F<L>,
    pub(super) spread: F<L>,
    pub(super) bounces: U<L>,
    /// Absorption a metre of what the path is in, and of what is behind the surface.
    pub(super) medium: Rgb<L>,
    pub(super) behind: Rgb<L>,
    /// Where all lobes are mirrors or clear glass.
    pub(super) only_delta: M<L>,
    /// Density of the path's direction per solid angle, but for camera rays.
    pub(super) pdf: F<L>,
    /// How much of a camera ray's sample is here; of other rays, nothing of meaning.
    pub(super) share: F<L>,
}

/// What all hits of a chunk share.
#[derive(Clone, Debug)]
pub(super) struct Stage<'a, L> {
    pub(super) l: L,
    pub(super) tables: &'a Tables,
    pub(super) transport: &'a Transport,
    pub(super) context: &'a SampleContext<'a>,
    /// What computed the chunk's shader passes, where any are wanted.
    pub(super) shader: Option<&'a Program>,
    /// Where the chunk is in the order of the paths.
    pub(super) hits: Range<usize>,
}

/// Shades a chunk, whose surface columns and parameters are ready.
#[inline(always)]
pub(super) fn shade_chunk<L: Lanes>(stage: &Stage<'_, L>, material: &SurfaceMaterial, ws: &mut Workspace) {
    let Stage { l, tables, transport, ref hits, .. } = *stage;
    let (first, count) = (hits.start, hits.len());
    let outputs = std::mem::take(&mut ws.outputs);
    let values = parameter_values(material, &outputs);
    let mut lobes = Lobes::empty(l);
    ws.light_draws.made = false;
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
fn load_point<L: Lanes>(l: L, material: &SurfaceMaterial, first: usize, at: usize, alive: M<L>, ws: &Workspace) -> Point<L> {
    let path = l.load_integers(&ws.order, first + at);
    let shading = load3(l, &ws.surface.shading_normal, at);
    let frame =
        if material.anisotropic { Frame::from_tangent(shading, load3(l, &ws.surface.tangent, at)) } else { Frame::from_normal(shading) };
    let CarriedLanes { throughput, pdf } = ws.paths.carried(l, path);
    let TrackLanes { slot, flags, counts, spread } = ws.paths.track(l, path);
    Point {
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
        only_delta: l.m(false),
        pdf,
        share: pdf,
    }
}

/// The normals beside the shading normal, where the material has any.
#[inline(always)]
fn normals<L: Lanes>(l: L, material: &SurfaceMaterial, point: &Point<L>, at: usize, ws: &Workspace) -> Option<Normals<L>> {
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
fn absorb<L: Lanes>(l: L, material: &SurfaceMaterial, values: &ParameterValues<'_>, point: &mut Point<L>, at: usize, ws: &Workspace) {
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
    point: &mut Point<L>,
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
        if LightDraws::pays::<L>(&tables.lights, stage.hits.len()) {
            let sample = light_draws::sample(stage, at, ws);
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

/// Tells mirrors from other surfaces, which guide denoisers and are measured; gives where lights can be sampled, and which paths go on.
#[inline(always)]
pub(super) fn meet<L: Lanes>(
    stage: &Stage<'_, L>,
    point: &mut Point<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    ws: &mut Workspace,
) -> [M<L>; 2] {
    let transport = stage.transport;
    let [smooth, only_delta] = lobes.smoothness(stage.l);
    point.only_delta = only_delta;
    guides::record(stage, point, lobes, present, ws);
    // Beyond the last bounce a path still sees what emits, as the other half of the light sampling before.
    let going_on = present & point.bounces.lt(transport.max_bounces + 1) & within(point.counts, transport.kind_bounces);
    if transport.measure {
        let measured = going_on.and_not(only_delta) & guides::is_sharp(point.flags, point.slot);
        append_measure(point, measured, &mut ws.measure);
    }
    [smooth, going_on]
}

/// Adds what the surface emits and keeps what the camera sees of it; gives what is there, holdouts left out.
#[inline(always)]
pub(super) fn show<L: Lanes>(
    stage: &Stage<'_, L>,
    material: &SurfaceMaterial,
    point: &mut Point<L>,
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
    if !material.surface.lobes.straight && stage.transport.sight != Sight::Sharp {
        record_first(stage, material, point, lobes, present, at, ws);
        if !tables.geometry.set_catcher.is_empty() {
            catcher::record(stage, point, present, ws);
        }
    }
    present
}

/// Opacity after the cut-out threshold.
#[inline(always)]
pub(super) fn threshold<L: Lanes>(opacity: F<L>, threshold: f32) -> F<L> {
    let l = opacity.lanes();
    if threshold > 0.0 { opacity.ge(threshold).select(l.f(1.0), l.f(0.0)) } else { opacity }
}

/// Adds what the surface emits, weighted where the triangle is a light that could have been sampled.
#[inline(always)]
fn add_emission<L: Lanes>(stage: &Stage<'_, L>, point: &Point<L>, emission: Rgb<L>, present: M<L>, at: usize, ws: &mut Workspace) {
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
    add_light(&mut ws.first_hit, code_of(point.flags, code::EMISSION), point.slot, value, arrives);
    add_of_surfaces(stage, at, point.slot, value, arrives, ws);
}
