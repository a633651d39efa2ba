//! BSDF sampling and Russian roulette: paths go on from a surface, straight through it, or start a random walk under it.

use crate::accumulate::expression_sums::scattering_of;
use crate::kernels;
use crate::stage::shade::straight::straight_on;
use crate::state::chunk::ChunkContext;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::queue::walks::{WalkLanes, Walks};
use crate::state::rays::RayLanes;
use crate::state::vertex::{CONE_PER_ROUGHNESS, Vertex};
use crate::tables::material::{SurfaceMaterial, threshold};
use crate::tables::transport::Passes;
use crate::words::{counts, event, flag};
use gonio_bsdf::{BsdfSample, Lobes, subsurface::WalkMedium};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// First depths of Russian roulette, for paths that leave diffusely and for any path: highlights and glass show more of what comes later.
const ROULETTE_FROM: [u32; 2] = [1, 5];
/// A path survives with this times the root of its throughput: measured on the scenes of `tests/peers/render`, the least variance times seconds.
const ROULETTE_SHARE: f32 = 1.25;

/// The lanes that meet the surface: by its opacity the others pass straight through, at random.
#[inline(always)]
pub(crate) fn without_cut_outs<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    u: F<L>,
    next: &mut Paths,
) -> M<L> {
    if !material.surface.lobes.has_gaps() {
        return point.alive;
    }
    let passed = point.alive & u.ge(threshold(lobes.opacity(), material.opacity_threshold));
    pass_straight(chunk, point, passed & chunk.allows_straight(point.core.counts), next);
    point.alive.and_not(passed)
}

/// Sends paths straight on through a cut-out: the count of ways straight through alone changes.
#[inline(always)]
fn pass_straight<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, chosen: M<L>, next: &mut Paths) {
    if !chosen.any() {
        return;
    }
    let before = chunk.paths.previous(chunk.l, point.path);
    let flags = chunk.transport.passes.behind(point.core.flags, point.instance, chosen);
    next.append(&point.straight_on(&straight_on(chunk, point), before, (flags, chunk.straight)), chosen);
}

/// Starts subsurface random walks.
#[inline(always)]
fn start_walks<L: Lanes>(point: &Vertex<L>, wi: Vec3<L>, throughput: Spectrum<L>, medium: &WalkMedium<L>, chosen: M<L>, walks: &mut Walks) {
    if !chosen.any() {
        return;
    }
    let t_min = point.at.error / point.at.geometric.dot(wi).abs().max(0.05);
    let walk = WalkLanes {
        ray: RayLanes { origin: point.at.position, direction: wi, t_min, t_max: t_min },
        core: PathCore { throughput, ..point.core },
        medium: *medium,
        path: point.path,
        instance: point.instance,
    };
    walks.append(&walk, chosen);
}

/// The probability with which a path goes on: Russian roulette.
#[inline(always)]
pub(crate) fn survival<L: Lanes>(depth: u32, throughput: Spectrum<L>, diffuse: M<L>) -> F<L> {
    let l = throughput.lanes();
    let [from_diffuse, from_any] = ROULETTE_FROM.map(|from| depth >= from);
    if !from_diffuse {
        return l.f(1.0);
    }
    let survival = (throughput.max_component().sqrt() * ROULETTE_SHARE).clamp(0.05, 1.0);
    if from_any { survival } else { diffuse.select(survival, l.f(1.0)) }
}

/// Flags of what light paths bring, and where the path started: kept by mirrors and smooth glass, else begun anew ([`flag::LEFT_TO_LIGHT_PATHS`]).
#[inline(always)]
fn left_to_light_paths<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, sample: &BsdfSample<L>) -> U<L> {
    let l = chunk.l;
    let first = point.bounces.eq(0) & (point.core.flags & flag::ROUGH).eq(0);
    let here = (point.core.flags & flag::WALKED).eq(0);
    let rough = l.u(flag::LEFT_TO_LIGHT_PATHS).keep_if((first | l.m(chunk.transport.photons.is_some())) & here);
    // Light paths that scatter so are on their way to what the camera sees.
    let ends = first | (point.core.flags & flag::FROM_LIGHT).ne(0);
    let directly = l.u(flag::SEEN_DIRECTLY).keep_if(ends & here.and_not(sample.delta));
    let kept = point.core.flags & (flag::FROM_LIGHT | flag::SEEN_DIRECTLY | flag::ROUGH);
    let direct = l.u(flag::DIRECT_LEFT).keep_if(point.direct_left.and_not(sample.delta));
    sample.delta.select(point.core.flags & flag::LEFT_TO_LIGHT_PATHS, rough | flag::ROUGH) | directly | direct | kept
}

/// The flag of paths that the camera sends through clear glass, where that is to be transparent.
#[inline(always)]
fn clear<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, sample: &BsdfSample<L>) -> U<L> {
    let (l, most) = (chunk.l, chunk.transport.limits.clear_roughness);
    if most < 0.0 {
        return l.u(0);
    }
    let seen = (point.core.flags & (flag::CAMERA | flag::CLEAR)).ne(0);
    let passed = sample.transmitted.and_not(sample.diffuse) & sample.roughness.le(most);
    l.u(flag::CLEAR).keep_if(seen & passed)
}

/// Samples the BSDF and appends the paths that go on, after Russian roulette. `ending` paths have no bounce left: only what goes straight
/// through goes on, as the NEE before counted on it.
#[inline(always)]
pub(crate) fn scatter<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    u: [F<L>; 4],
    [going_on, ending]: [M<L>; 2],
    next: &mut Paths,
    walks: &mut Walks,
) {
    if !(going_on | ending).any() {
        return;
    }
    let (sample, factor) = sampled(chunk, point, lobes, [u[0], u[1], u[2]]);
    send_on(chunk, point, lobes, (&sample, factor), u[3], [going_on, ending], next, walks);
}

/// Samples the BSDF, and what that makes of the throughput.
#[inline(always)]
pub(crate) fn sampled<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    u: [F<L>; 3],
) -> (BsdfSample<L>, Spectrum<L>) {
    let sample = kernels::sample(chunk.l, lobes, point.local_wo, u);
    let factor = sample.value * sample.pdf.recip();
    (sample, factor)
}

/// The flag of paths that have met what is not specular.
#[inline(always)]
fn seen_non_specular<L: Lanes>(l: L, point: &Vertex<L>) -> U<L> {
    (point.core.flags & flag::NON_SPECULAR_SEEN) | point.all_delta.select(l.u(0), l.u(flag::NON_SPECULAR_SEEN))
}

/// The flags of paths that have been scattered.
#[inline(always)]
fn flags<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, sample: &BsdfSample<L>, non_specular: U<L>) -> U<L> {
    let l = chunk.l;
    let delta = sample.delta.select(l.u(flag::DELTA), l.u(0));
    let kind = sample.diffuse.select(l.u(event::DIFFUSE), sample.transmitted.select(l.u(event::TRANSMISSION), l.u(event::GLOSSY)));
    let kept = left_to_light_paths(chunk, point, sample);
    let scattered = delta | non_specular | kept | clear(chunk, point, sample) | flag::scattered(point.core.flags, kind);
    let (passes, through) = (&chunk.transport.passes, !sample.wi.z.gt(0.0));
    match (&passes.expressions, &passes.openings) {
        (Some(expressions), _) => {
            let event = scattering_of(l, [sample.diffuse, sample.delta, through]);
            scattered | expressions.step(point.core.flags, event)
        }
        (None, Some(_)) => scattered | Passes::opening(passes.behind(point.core.flags, point.instance, through)),
        (None, None) => scattered,
    }
}

/// Appends the paths that go on in sampled directions, with `factor` on their throughput, and starts walks under the surface.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a vertex, a direction and where the path goes on")]
pub(crate) fn send_on<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    (sample, factor): (&BsdfSample<L>, Spectrum<L>),
    u_roulette: F<L>,
    [going_on, ending]: [M<L>; 2],
    next: &mut Paths,
    walks: &mut Walks,
) {
    let l = chunk.l;
    let wi = point.at.frame.to_world(sample.wi).normalize();
    // A direction on the other side of the triangle than of the shading normal would leak light.
    let across = point.at.geometric.dot(wi).lt(0.0);
    // What facets refract goes on where bent normals send it: lost, it would darken smooth edges.
    let mut consistent = (sample.transmitted & (across | !sample.diffuse)) | (!sample.transmitted).and_not(across);
    if lobes.has_fibre() {
        // Fibres scatter about their tangent: no side is the wrong one.
        consistent = l.m(true);
    }
    let throughput = point.core.throughput * factor;
    let passes = sample.straight & chunk.allows_straight(point.core.counts);
    let mut alive = ((going_on | (ending & sample.straight)) & consistent).and_not(sample.straight.and_not(passes))
        & sample.pdf.gt(0.0)
        & throughput.is_lit()
        & throughput.max_component().is_finite();
    if let Some(medium) = lobes.medium() {
        let entered = alive & sample.entered;
        alive = alive.and_not(sample.entered);
        start_walks(point, wi, throughput, medium, entered, walks);
    }
    let survival = survival(chunk.sample.depth, throughput * point.core.unguided, sample.diffuse);
    // What the camera sees straight ahead covers what is behind, however dark.
    let survival = (sample.straight & (point.core.flags & flag::CAMERA).ne(0)).select(l.f(1.0), survival);
    alive &= u_roulette.lt(survival);
    let throughput = throughput * survival.recip();
    if !alive.any() {
        return;
    }
    let non_specular = seen_non_specular(l, point);
    let scattered = flags(chunk, point, sample, non_specular);
    let counted = sample.diffuse.select(l.u(counts::DIFFUSE), sample.transmitted.select(l.u(counts::TRANSMISSION), l.u(counts::GLOSSY)));
    // What goes straight through a thin wall is still on its way from the vertex before, so that lights seen through it keep their weights.
    let straight = sample.straight;
    let (mut from, mut pdf) = (point.at.light_context(), sample.pdf);
    let (mut ray, mut width, mut passed) = (point.at.spawn_ray(wi), point.core.width, None);
    from.normal = point.at.lit_normal(lobes);
    if straight.any() {
        let before = chunk.paths.previous(l, point.path);
        from.position = straight.select(before.position, from.position);
        from.normal = straight.select(before.normal, from.normal);
        from.receiver = straight.select(before.receiver, from.receiver);
        pdf = straight.select(point.pdf, pdf);
        let on = straight_on(chunk, point);
        (ray, width, passed) = (ray.or(straight, &on.ray), straight.select(on.width, width), Some(on.passed.only(straight)));
    }
    let core = PathCore {
        throughput,
        width,
        spread: point.core.spread + sample.roughness * CONE_PER_ROUGHNESS,
        flags: straight.select(chunk.transport.passes.behind(point.core.flags, point.instance, straight) | non_specular, scattered),
        counts: point.core.counts + straight.select(l.u(chunk.straight), counted),
        media: point.media_towards(across, straight),
        ..point.core
    };
    next.append(&PathLanes::start(ray, core).leaving(from, pdf).having_passed(passed), alive);
}
