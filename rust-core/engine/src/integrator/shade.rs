//! The fourth stage: a chunk of hits of one material emits, is lit, and scatters.

use super::{
    accumulate::{FirstSurface, clamped},
    kernels::{self, LightHit},
    light_sums::code,
    material::{SurfaceMaterial, Tables},
    path::{Mist, SampleContext, Transport},
    scatter::{add_light, add_rgb, add_shares, code_of, code_of_sampled},
    state::{MeasurePoints, PathLanes, ShadowLanes, Workspace, append3, event, flag, gather3, load3},
    subsurface::WalkLanes,
};
use crate::{
    bsdf::{
        Lobes, ParameterValues,
        normals::Normals,
        parameter::COUNT,
        subsurface::{self, Medium},
    },
    geometry::{NONE, spawn},
    graph::{OutputColumns, Program},
    light::power_heuristic,
    sampler::dimension,
};
use gonio_simd::{F, Frame, Lanes, M, Rgb, U, Vec3};

/// Roughness widens a path's cone by this much, radians: blurred reflections need no sharp textures.
const CONE_PER_ROUGHNESS: f32 = 0.3;
/// Surfaces after which Russian roulette may end a path.
const ROULETTE_FROM: u32 = 3;

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
struct Point<L: Lanes> {
    alive: M<L>,
    path: U<L>,
    position: Vec3<L>,
    error: F<L>,
    geometric: Vec3<L>,
    frame: Frame<L>,
    wo: Vec3<L>,
    throughput: Rgb<L>,
    flags: U<L>,
    counts: U<L>,
    slot: U<L>,
    instance: U<L>,
    width: F<L>,
    spread: F<L>,
    bounces: U<L>,
    /// Absorption a metre of what the path is in, and of what is behind the surface.
    medium: Rgb<L>,
    behind: Rgb<L>,
    /// Where all lobes are mirrors or clear glass.
    only_delta: M<L>,
}

/// What all hits of a chunk share.
#[derive(Clone, Copy, Debug)]
struct Stage<'a, L> {
    l: L,
    tables: &'a Tables,
    transport: &'a Transport,
    context: &'a SampleContext,
    material: &'a SurfaceMaterial,
}

/// Shades the chunk `order[first..first + count]`, whose surface columns and parameters are ready.
#[expect(clippy::too_many_arguments, reason = "the whole state of a stage comes in here")]
#[inline(always)]
pub(super) fn shade_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    transport: &Transport,
    context: &SampleContext,
    material: &SurfaceMaterial,
    first: usize,
    count: usize,
    ws: &mut Workspace,
) {
    let stage = Stage { l, tables, transport, context, material };
    let outputs = std::mem::take(&mut ws.outputs);
    let values = parameter_values(material, &outputs);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        ws.statistics.lanes += L::COUNT as u64;
        ws.statistics.lanes_alive += alive.count() as u64;
        let mut point = load_point(l, material, first, at, alive, ws);
        if tables.any_absorbing {
            absorb(l, material, &values, &mut point, at, ws);
        }
        let wo = point.frame.to_local(point.wo);
        let entering = l.load(&ws.surface.side, at).gt(0.0);
        let normals = normals(l, material, &point, at, ws);
        let lobes = kernels::resolve(l, &material.surface, &values, at, wo, entering, normals.as_ref());
        shade_lanes(&stage, &mut point, wo, &lobes, at, ws);
    }
    ws.outputs = outputs;
}

#[inline(always)]
fn load_point<L: Lanes>(l: L, material: &SurfaceMaterial, first: usize, at: usize, alive: M<L>, ws: &Workspace) -> Point<L> {
    let path = l.load_integers(&ws.order, first + at);
    let shading = load3(l, &ws.surface.shading_normal, at);
    let frame =
        if material.anisotropic { Frame::from_tangent(shading, load3(l, &ws.surface.tangent, at)) } else { Frame::from_normal(shading) };
    let throughput = gather3(l, &ws.paths.throughput, path);
    let flags = l.gather_integers(&ws.paths.flags, path);
    let spread = l.gather(&ws.paths.spread, path);
    Point {
        alive,
        path,
        position: load3(l, &ws.surface.position, at),
        error: l.load(&ws.surface.error, at),
        geometric: load3(l, &ws.surface.geometric_normal, at),
        frame,
        wo: load3(l, &ws.surface.wo, at),
        throughput: Rgb::new(throughput.x, throughput.y, throughput.z),
        flags,
        counts: l.gather_integers(&ws.paths.counts, path),
        slot: l.gather_integers(&ws.paths.slot, path),
        instance: l.load_integers(&ws.surface.instance, at),
        width: l.gather(&ws.hits.t, path).mul_add(spread, l.gather(&ws.paths.width, path)),
        spread,
        bounces: flags >> flag::BOUNCE_SHIFT,
        medium: Rgb::zero(l),
        behind: Rgb::zero(l),
        only_delta: l.m(false),
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
    let local = |columns: &[gonio_simd::Column; 3]| point.frame.to_local(load3(l, columns, at));
    Some(Normals {
        geometric: point.frame.to_local(point.geometric),
        smooth: if program.normal.is_some() { local(&ws.surface.smooth_normal) } else { local(&ws.surface.shading_normal) },
        coat: program.coat_normal.map(|_| local(&ws.surface.coat_normal)),
    })
}

/// Dims the path by what it has come through (Beer and Lambert), and looks up what is behind the surface.
#[inline(always)]
fn absorb<L: Lanes>(l: L, material: &SurfaceMaterial, values: &ParameterValues<'_>, point: &mut Point<L>, at: usize, ws: &Workspace) {
    let sigma = gather3(l, &ws.paths.medium, point.path);
    point.medium = Rgb::new(sigma.x, sigma.y, sigma.z);
    let distance = l.gather(&ws.hits.t, point.path);
    let passed = |sigma: F<L>| (-(sigma * distance)).exp();
    point.throughput = point.throughput * Rgb::new(passed(sigma.x), passed(sigma.y), passed(sigma.z));
    // Leaving a solid leads to the open.
    let inside = material.surface.absorption(l, values, at);
    point.behind = inside.keep_if(l.load(&ws.surface.side, at).gt(0.0));
}

#[inline(always)]
fn shade_lanes<L: Lanes>(stage: &Stage<'_, L>, point: &mut Point<L>, wo: Vec3<L>, lobes: &Lobes<L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, transport, context, material } = *stage;
    let pixel = point.slot & (super::state::BATCH as u32 - 1);
    let index = context.sampler.index(l, pixel, context.sample);
    let base = dimension::FIRST_BOUNCE + context.depth * dimension::BOUNCE;
    let [u_lobe, u_opacity] = context.sampler.pair(l, index, base + dimension::LOBE);
    let present = if material.surface.lobes.cut_out {
        let seen_through = point.alive & u_opacity.ge(threshold(lobes.opacity(), material.opacity_threshold));
        pass_straight(l, point, seen_through & straight_left(point.counts, transport), ws);
        point.alive.and_not(seen_through)
    } else {
        point.alive
    };
    let present =
        if material.holdout || !tables.geometry.set_holdout.is_empty() { covered(stage, point, present, at, ws) } else { present };
    if material.surface.lobes.emission {
        add_emission(stage, point, lobes.emission(), present, at, ws);
    }
    record_first(stage, point, lobes, present, at, ws);
    let [smooth, only_delta] = lobes.smoothness(l);
    point.only_delta = only_delta;
    // Beyond the last bounce a path still sees what emits, as the other half of the light sampling before.
    let going_on = present & point.bounces.lt(transport.max_bounces + 1) & within(point.counts, transport.kind_bounces);
    if transport.measure {
        let measured = going_on.and_not(only_delta) & (point.flags & flag::MEASURED).eq(0) & point.slot.lt(super::state::BATCH as u32);
        append_measure(point, measured, &mut ws.measure);
    }
    let [u_choice, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    if smooth.any() && !tables.lights.is_empty() {
        let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
        light(stage, point, wo, lobes, [u_choice, u, v], going_on, ws);
    }
    let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
    scatter(stage, point, wo, lobes, [u_lobe, u, v, u_roulette], going_on, ws);
}

/// Leaves out what the camera sees of holdouts: paths end there without light or coverage.
#[inline(always)]
fn covered<L: Lanes>(stage: &Stage<'_, L>, point: &Point<L>, present: M<L>, at: usize, ws: &Workspace) -> M<L> {
    let Stage { l, tables, material, .. } = *stage;
    let camera = (point.flags & flag::CAMERA).ne(0);
    let hole = if material.holdout {
        l.m(true)
    } else {
        let set = l.gather_integers(&tables.geometry.instance_set, l.load_integers(&ws.surface.instance, at));
        l.gather_integers(&tables.geometry.set_holdout, set).ne(0)
    };
    present.and_not(hole & camera)
}

/// Whether all counts of scatterings are within their limits.
#[inline(always)]
fn within<L: Lanes>(counts: U<L>, limits: [u32; 4]) -> M<L> {
    let at = |kind: u32| (counts >> (kind * 8)) & 255;
    at(0).lt(limits[0] + 1) & at(1).lt(limits[1] + 1) & at(2).lt(limits[2] + 1)
}

/// Opacity after the cut-out threshold.
#[inline(always)]
pub(super) fn threshold<L: Lanes>(opacity: F<L>, threshold: f32) -> F<L> {
    let l = opacity.lanes();
    if threshold > 0.0 { opacity.ge(threshold).select(l.f(1.0), l.f(0.0)) } else { opacity }
}

/// Whether a path may go straight through one more surface.
#[inline(always)]
fn straight_left<L: Lanes>(counts: U<L>, transport: &Transport) -> M<L> {
    (counts >> 24).lt(transport.kind_bounces[3])
}

/// Sends paths on that go through a surface which is not there: nothing about them changes but where they start.
#[inline(always)]
fn pass_straight<L: Lanes>(l: L, point: &Point<L>, chosen: M<L>, ws: &mut Workspace) {
    if !chosen.any() {
        return;
    }
    let direction = -point.wo;
    let state = PathLanes {
        origin: spawn(point.position, point.geometric, point.error, direction),
        direction,
        t_min: l.f(0.0),
        t_max: l.f(f32::MAX),
        vertex: gather3(l, &ws.paths.vertex, point.path),
        normal: gather3(l, &ws.paths.normal, point.path),
        throughput: point.throughput,
        pdf: l.gather(&ws.paths.pdf, point.path),
        width: point.width,
        spread: point.spread,
        slot: point.slot,
        flags: point.flags,
        counts: point.counts + (1 << 24),
        medium: point.medium,
    };
    ws.next.append(&state, chosen);
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
            let (from, normal) = (gather3(l, &ws.paths.vertex, point.path), gather3(l, &ws.paths.normal, point.path));
            let hit = LightHit { light, from, normal, direction: -point.wo, point: point.position };
            let (_, pdf) = kernels::eval_light(l, tables, &hit, sampled);
            let weight = sampled.select(power_heuristic(l.gather(&ws.paths.pdf, point.path), pdf), l.f(1.0));
            value = value * weight;
        }
    }
    let value = clamped(value, transport.clamp(context.depth));
    add_light(&mut ws.first_hit, code_of(point.flags, code::EMISSION), point.slot, value, present & value.is_lit());
}

/// Keeps what camera rays met first.
#[inline(always)]
fn record_first<L: Lanes>(stage: &Stage<'_, L>, point: &Point<L>, lobes: &Lobes<L>, present: M<L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, transport, material, .. } = *stage;
    let seen = present & (point.flags & flag::CAMERA).ne(0);
    if !seen.any() {
        return;
    }
    let eye = Vec3::splat(l, transport.eye);
    let set = l.gather_integers(&tables.geometry.instance_set, l.load_integers(&ws.surface.instance, at));
    let surface = FirstSurface {
        slot: point.slot,
        depth: (point.position - eye).dot(Vec3::splat(l, transport.forward)),
        normal: point.frame.z,
        position: point.position,
        albedo: lobes.albedo(),
        prim_id: set,
        object_index: l.gather_integers(&tables.geometry.set_pass_index, set),
        material_index: l.u(material.pass_index),
        clearness: clearness(transport, point.position - eye),
        uv: if transport.passes.uv { Some(texture_coordinates(l, tables, material, at, ws)) } else { None },
        kinds: lobes.albedo_kinds(),
    };
    ws.first_hit.record(l, &surface, seen);
}

/// What the mist leaves of a point this far from the camera.
#[inline(always)]
fn clearness<L: Lanes>(transport: &Transport, from_eye: Vec3<L>) -> F<L> {
    let Mist { start, depth, falloff } = transport.passes.mist;
    let inside = ((from_eye.length() - start) * (1.0 / depth.max(1e-6))).saturate();
    1.0 - inside.max(1e-9).pow(inside.lanes().f(falloff))
}

/// The texture coordinates that the material's images follow.
#[inline(always)]
fn texture_coordinates<L: Lanes>(l: L, tables: &Tables, material: &SurfaceMaterial, at: usize, ws: &Workspace) -> [F<L>; 2] {
    let Some(column) = material.program.uv else { return [l.f(0.0); 2] };
    let barycentric = [l.load(&ws.surface.barycentric[0], at), l.load(&ws.surface.barycentric[1], at)];
    let (instance, primitive) = (l.load_integers(&ws.surface.instance, at), l.load_integers(&ws.surface.primitive, at));
    let hit = tables.geometry.hit_lanes(l, instance, primitive, barycentric[0], barycentric[1]);
    let ([u, v, ..], _) = tables.geometry.primvar(l, &hit, column);
    [u, v]
}

#[inline(always)]
fn append_measure<L: Lanes>(point: &Point<L>, chosen: M<L>, out: &mut MeasurePoints) {
    if !chosen.any() {
        return;
    }
    let n = out.count;
    append3(point.position, chosen, &mut out.position, n);
    point.error.append(chosen, &mut out.error, n);
    append3(point.geometric, chosen, &mut out.geometric_normal, n);
    append3(point.frame.z, chosen, &mut out.shading_normal, n);
    let weight = point.throughput;
    append3(Vec3::new(weight.r, weight.g, weight.b), chosen, &mut out.throughput, n);
    point.width.append(chosen, &mut out.width, n);
    point.slot.append(chosen, &mut out.slot, n);
    out.count += chosen.count();
}

/// Samples one light and queues the shadow ray to it.
#[inline(always)]
fn light<L: Lanes>(stage: &Stage<'_, L>, point: &Point<L>, wo: Vec3<L>, lobes: &Lobes<L>, u: [F<L>; 3], present: M<L>, ws: &mut Workspace) {
    let Stage { l, tables, transport, context, .. } = *stage;
    let sample = kernels::sample_light(l, tables, point.position, point.frame.z, u[0], [u[1], u[2]]);
    let usable = present & sample.pdf.gt(0.0) & sample.radiance.is_lit();
    if !usable.any() {
        return;
    }
    let (value, pdf) = kernels::eval(l, lobes, wo, point.frame.to_local(sample.wi));
    let weight = sample.delta.select(l.f(1.0), power_heuristic(sample.pdf, pdf));
    let contribution = clamped(value * sample.radiance * point.throughput * (weight / sample.pdf), transport.clamp(context.depth));
    let lit = usable & contribution.is_lit() & contribution.max_component().is_finite();
    let free = lit.and_not(sample.casts_shadow);
    let code = code_of_sampled(point.flags);
    let shares = if ws.first_hit.lights.wanted() { Some(shares(l, lobes, wo, point.frame.to_local(sample.wi), value)) } else { None };
    if let Some([diffuse, glossy]) = shares {
        let at_first = code.eq(code::SHARED);
        let parts = [contribution * diffuse, contribution * glossy];
        add_shares(&mut ws.first_hit, point.slot, contribution, parts, free & at_first);
        add_light(&mut ws.first_hit, code, point.slot, contribution, free.and_not(at_first));
        add_rgb(&mut ws.first_hit.radiance, point.slot, contribution, free & at_first);
    } else {
        add_rgb(&mut ws.first_hit.radiance, point.slot, contribution, free);
    }
    let origin = spawn(point.position, point.geometric, point.error, sample.wi);
    // Lights that are meshes must not shadow themselves.
    let t_max = (sample.distance * (1.0 - 1e-4)).min(f32::MAX);
    let ray = ShadowLanes { origin, direction: sample.wi, t_max, contribution, slot: point.slot, code, shares };
    ws.shadows.append(&ray, lit & sample.casts_shadow);
}

/// The diffuse and the glossy share of what all lobes scatter.
#[inline(always)]
fn shares<L: Lanes>(l: L, lobes: &Lobes<L>, wo: Vec3<L>, wi: Vec3<L>, all: Rgb<L>) -> [Rgb<L>; 2] {
    let mut parts = kernels::eval_kinds(l, lobes, wo, wi);
    for part in &mut parts {
        let share = |part: F<L>, all: F<L>| (part / all.max(1e-30)).saturate();
        *part = Rgb::new(share(part.r, all.r), share(part.g, all.g), share(part.b, all.b));
    }
    parts
}

/// Starts walks under the surface.
#[inline(always)]
fn enter<L: Lanes>(point: &Point<L>, wi: Vec3<L>, throughput: Rgb<L>, medium: &Medium<L>, chosen: M<L>, ws: &mut Workspace) {
    if !chosen.any() {
        return;
    }
    let walk = WalkLanes {
        origin: point.position,
        direction: wi,
        t_min: point.error / point.geometric.dot(wi).abs().max(0.05),
        throughput,
        medium: *medium,
        instance: point.instance,
        slot: point.slot,
        flags: point.flags,
        counts: point.counts,
        width: point.width,
    };
    ws.walks.append(&walk, chosen);
}

/// Where walks come out.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExitPoint<L: Lanes> {
    pub(super) alive: M<L>,
    pub(super) position: Vec3<L>,
    pub(super) error: F<L>,
    pub(super) geometric: Vec3<L>,
    pub(super) shading: Vec3<L>,
    pub(super) throughput: Rgb<L>,
    pub(super) slot: U<L>,
    pub(super) flags: U<L>,
    pub(super) counts: U<L>,
    pub(super) width: F<L>,
}

/// Lights and scatters what comes out from under a surface, as a white Lambertian surface does; `base` is the first dimension of its numbers.
#[inline(always)]
pub(super) fn leave<L: Lanes>(
    l: L,
    tables: &Tables,
    transport: &Transport,
    context: &SampleContext,
    exit: &ExitPoint<L>,
    base: u32,
    ws: &mut Workspace,
) {
    let stage = Stage { l, tables, transport, context, material: &tables.materials.surfaces[0] };
    let point = Point {
        alive: exit.alive,
        path: l.u(0),
        position: exit.position,
        error: exit.error,
        geometric: exit.geometric,
        frame: Frame::from_normal(exit.shading),
        wo: exit.shading,
        throughput: exit.throughput,
        flags: exit.flags,
        counts: exit.counts,
        slot: exit.slot,
        instance: l.u(0),
        width: exit.width,
        spread: l.f(CONE_PER_ROUGHNESS),
        bounces: exit.flags >> flag::BOUNCE_SHIFT,
        medium: Rgb::zero(l),
        behind: Rgb::zero(l),
        only_delta: l.m(false),
    };
    let lobes = subsurface::exit(l);
    let wo = Vec3::splat(l, [0.0, 0.0, 1.0]);
    let index = context.sampler.index(l, exit.slot & (super::state::BATCH as u32 - 1), context.sample);
    let [u_choice, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    if !tables.lights.is_empty() {
        let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
        light(&stage, &point, wo, &lobes, [u_choice, u, v], exit.alive, ws);
    }
    let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
    scatter(&stage, &point, wo, &lobes, [l.f(0.5), u, v, u_roulette], exit.alive, ws);
}

/// Samples the next direction and appends the paths that go on.
#[inline(always)]
fn scatter<L: Lanes>(
    stage: &Stage<'_, L>,
    point: &Point<L>,
    wo: Vec3<L>,
    lobes: &Lobes<L>,
    u: [F<L>; 4],
    going_on: M<L>,
    ws: &mut Workspace,
) {
    if !going_on.any() {
        return;
    }
    let l = stage.l;
    let sample = kernels::sample(l, lobes, wo, [u[0], u[1], u[2]]);
    let wi = point.frame.to_world(sample.wi).normalize();
    // A direction on the other side of the triangle than of the shading normal would leak light.
    let across = point.geometric.dot(wi).lt(0.0);
    let consistent = (sample.transmitted & across) | (!sample.transmitted).and_not(across);
    let throughput = point.throughput * sample.value * sample.pdf.recip();
    let passes = sample.straight & straight_left(point.counts, stage.transport);
    let mut alive = (going_on & consistent).and_not(sample.straight.and_not(passes))
        & sample.pdf.gt(0.0)
        & throughput.is_lit()
        & throughput.max_component().is_finite();
    if let Some(medium) = lobes.medium() {
        let entered = alive & sample.entered;
        alive = alive.and_not(sample.entered);
        enter(point, wi, throughput, medium, entered, ws);
    }
    let mut throughput = throughput;
    if stage.context.depth >= ROULETTE_FROM {
        let survival = throughput.max_component().clamp(0.05, 1.0);
        alive &= u[3].lt(survival);
        throughput = throughput * survival.recip();
    }
    if !alive.any() {
        return;
    }
    let delta = sample.delta.select(l.u(flag::DELTA), l.u(0));
    let measured = (point.flags & flag::MEASURED) | point.only_delta.select(l.u(0), l.u(flag::MEASURED));
    let kind = sample.diffuse.select(l.u(event::DIFFUSE), sample.transmitted.select(l.u(event::TRANSMISSION), l.u(event::GLOSSY)));
    let first = point.bounces.eq(0).select(kind << flag::FIRST_SHIFT, point.flags & (3 << flag::FIRST_SHIFT));
    let scattered = delta | measured | (kind << flag::LAST_SHIFT) | first | ((point.bounces + 1) << flag::BOUNCE_SHIFT);
    let counted = sample.diffuse.select(l.u(1), sample.transmitted.select(l.u(1 << 16), l.u(1 << 8)));
    // What goes straight through a thin wall is still on its way from the vertex before, so that lights seen through it keep their weights.
    let straight = sample.straight;
    let before = |columns: &[gonio_simd::Column; 3]| gather3(l, columns, point.path);
    let state = PathLanes {
        origin: spawn(point.position, point.geometric, point.error, wi),
        direction: wi,
        t_min: l.f(0.0),
        t_max: l.f(f32::MAX),
        vertex: straight.select(before(&ws.paths.vertex), point.position),
        normal: straight.select(before(&ws.paths.normal), point.frame.z),
        throughput,
        pdf: straight.select(l.gather(&ws.paths.pdf, point.path), sample.pdf),
        width: point.width,
        spread: point.spread + sample.roughness * CONE_PER_ROUGHNESS,
        slot: point.slot,
        flags: straight.select(point.flags, scattered),
        counts: point.counts + straight.select(l.u(1 << 24), counted),
        medium: sample.transmitted.and_not(straight).select(point.behind, point.medium),
    };
    ws.next.append(&state, alive);
}
