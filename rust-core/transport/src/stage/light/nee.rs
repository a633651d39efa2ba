//! Next event estimation (NEE): a light sampled at each hit, its MIS weight (power heuristic), and the shadow ray to it.

use crate::accumulate::deposit::{Contribution, Deposits, code_of_sampled};
use crate::accumulate::expression_sums::with_sample;
use crate::kernels;
use crate::stage::light::terminator::Lifted;
use crate::stage::shade::catcher;
use crate::stage::shade::guided::with_guiding;
use crate::state::chunk::ChunkContext;
use crate::state::queue::shadow_rays::{Along, ShadowLanes, ShadowRays};
use crate::state::rays::RayLanes;
use crate::state::vertex::{Interaction, Vertex};
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_bsdf::Lobes;
use gonio_light::{LightSample, LightSampleContext, SampleWeight};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// Samples one light and queues the shadow ray to it.
#[inline(always)]
pub(crate) fn sample_light<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    u: [F<L>; 3],
    present: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, transport, .. } = *chunk;
    let from = LightSampleContext { normal: point.at.lit_normal(lobes), ..point.at.light_context() };
    let sample = kernels::sample_li(l, tables, transport.light_cache.as_deref(), &from, &u);
    queue_shadow_ray(chunk, point, lobes, (&sample, SampleWeight::Mis), present, shadows, deposits);
}

/// Queues the shadow ray to a light sample, which counts by a weight. Where nothing can block the light, it is deposited at once.
#[inline(always)]
pub(crate) fn queue_shadow_ray<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    (sample, weight): (&LightSample<L>, SampleWeight),
    present: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, transport, .. } = *chunk;
    let usable = present & sample.pdf.gt(0.0) & sample.radiance.is_lit() & catcher::may_sample(l, tables, point.core.slot, sample.light);
    let usable = match &transport.light_paths {
        Some(left) if point.direct_left.any() => {
            usable.and_not(point.direct_left & l.gather_integers(left, sample.light.keep_if(usable)).ne(0))
        }
        _ => usable,
    };
    if !usable.any() {
        deposits.note_lost(&point.at, present);
        return;
    }
    let wi = point.at.frame.to_local(sample.wi);
    let leaks = leaks(l, point, lobes, [sample.wi, wi]);
    let lifted = Lifted::of(chunk, point, sample.wi, usable);
    let usable = usable.and_not(match &lifted {
        Some(lifted) => leaks.and_not(lifted.any) | lifted.astray,
        None => leaks,
    });
    let (f, pdf) = lobes.eval(l, point.local_wo, wi);
    let pdf = with_guiding(chunk, point, [sample.wi, wi], pdf);
    let f = if tables.lights.has_factors() { seen_part(chunk, lobes, [point.local_wo, wi], f, sample.light) } else { f };
    // Below the triangle BSDF sampling finds nothing, yet its share is left out: wide lights, which have no hard terminator to hide, stay as dark
    // there as the triangle makes them (as in Cycles).
    let weight = weight.of(sample, pdf);
    let radiance = tables.lights.light(chunk.sample.wavelengths(l, point.core.slot), sample.light, sample.radiance);
    let whole = f * radiance * point.core.throughput * (weight / sample.pdf);
    let (value, ceiling) = clamped(tables, transport, sample, whole, point.bounces + 1);
    let lit = usable & value.is_lit() & value.abs().max_component().is_finite();
    deposits.note_lost(&point.at, present.and_not(lit));
    let through = !wi.z.gt(0.0);
    let flags = transport.passes.behind(point.core.flags, point.instance, through);
    let code = with_sample(&transport.passes, code_of_sampled(flags), flags, through);
    let shares = if deposits.wants_shares(transport) { Some(shares(l, lobes, point.local_wo, wi, f)) } else { None };
    let light = Contribution::sampled(sample.light, point.core.slot, value, code, shares);
    let along = point.along(tables, transport, sample.wi, ceiling);
    // One call each: rays of both in one place would be copied through memory.
    match &lifted {
        None => send(transport, (&point.at, point.at.spawn_ray_to(sample)), (sample, along), &light, lit, shadows, deposits),
        Some(lifted) => {
            let ray = lifted.spawn_ray_to(&point.at, sample);
            send(transport, (&point.at, ray), (sample, along), &light, lit, shadows, deposits);
        }
    }
}

/// The contribution of a light's sample within its limit, or all of it and the limit where that is yet to be applied.
#[inline(always)]
pub(crate) fn clamped<L: Lanes>(
    tables: &Tables,
    transport: &Transport,
    sample: &LightSample<L>,
    whole: Spectrum<L>,
    scattered: U<L>,
) -> (Spectrum<L>, Option<F<L>>) {
    let held = transport.limits.clamped(whole, scattered);
    match late_ceiling(tables, transport, scattered) {
        Some(ceiling) => (sample.casts_shadow.select(whole, held), Some(ceiling)),
        None => (held, None),
    }
}

/// What contributions may come to as they arrive, where they are held within their limits there.
#[inline(always)]
pub(crate) fn late_ceiling<L: Lanes>(tables: &Tables, transport: &Transport, scattered: U<L>) -> Option<F<L>> {
    clamps_late(tables, transport).then(
        #[inline(always)]
        || transport.limits.ceiling(scattered),
    )
}

/// Whether contributions are held within their limits as they arrive: what shadow rays pass dims them, and programs tell what meshes shine with.
pub(crate) fn clamps_late(tables: &Tables, transport: &Transport) -> bool {
    transport.limits.clamps_any() && (tables.lights.any_shaded() || tables.any_transparent || tables.any_absorbing)
}

/// Light from below the triangle that the shading normal takes for light from above: its shadow ray would start on the other side, and bring
/// light into what is closed. Sampled directions are held to the same.
#[inline(always)]
fn leaks<L: Lanes>(l: L, point: &Vertex<L>, lobes: &Lobes<'_, L>, [world, local]: [Vec3<L>; 2]) -> M<L> {
    // Fibres scatter about their tangent: no side is the wrong one.
    if lobes.has_fibre() { l.m(false) } else { point.at.geometric.dot(world).lt(0.0) & local.z.gt(0.0) }
}

/// What is scattered of a light, by its factors on the kinds of scattering.
#[inline(always)]
pub(crate) fn seen_part<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    lobes: &Lobes<'_, L>,
    [wo, wi]: [Vec3<L>; 2],
    all: Spectrum<L>,
    light: U<L>,
) -> Spectrum<L> {
    all * seen_share(chunk, shares(chunk.l, lobes, wo, wi, all), light)
}

/// The share that counts of light that surfaces scatter in these shares, the diffuse and the glossy one.
#[inline(always)]
pub(crate) fn seen_share<L: Lanes>(chunk: &ChunkContext<'_, L>, [diffuse, glossy]: [Spectrum<L>; 2], light: U<L>) -> Spectrum<L> {
    let (l, lights) = (chunk.l, &chunk.tables.lights);
    let mut seen = Spectrum::one(l);
    for (kind, share) in [diffuse, glossy, Spectrum::one(l) - diffuse - glossy].into_iter().enumerate() {
        seen = seen - share * (1.0 - lights.scattered_factor(l, light, l.u(kind as u32)));
    }
    seen.max(0.0)
}

/// Deposits the light of a sample at once where nothing can block it, else queues it with its shadow ray from there.
#[inline(always)]
pub(crate) fn send<L: Lanes>(
    transport: &Transport,
    (at, ray): (&Interaction<L>, RayLanes<L>),
    (sample, along): (&LightSample<L>, Along<L>),
    light: &Contribution<L>,
    lit: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let at_once = lit.and_not(sample.casts_shadow);
    deposits.deposit(transport, light, at_once);
    deposits.note_arrived(at, sample, light.value, at_once);
    let Contribution { slot, value: contribution, code, shares, .. } = *light;
    let receiver = if deposits.arrivals.is_some() { Some(at.receiver) } else { None };
    let ray = ShadowLanes { ray, contribution, slot, code, light: sample.light, shares, receiver, along };
    shadows.append(&ray, lit & sample.casts_shadow);
}

/// The diffuse and the glossy share of what all lobes scatter.
#[inline(always)]
pub(crate) fn shares<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>, all: Spectrum<L>) -> [Spectrum<L>; 2] {
    shares_of(kernels::eval_diffuse(l, lobes, wo, wi), all, wi.z.gt(0.0))
}

/// The same of what is scattered diffusely and in all; what facets send to the other side is transmitted.
#[inline(always)]
pub(crate) fn shares_of<L: Lanes>(diffuse: Spectrum<L>, all: Spectrum<L>, reflected: M<L>) -> [Spectrum<L>; 2] {
    let glossy = (all - diffuse).keep_if(reflected);
    [share(diffuse, all), share(glossy, all)]
}

/// A part over the whole, component by component.
#[inline(always)]
fn share<L: Lanes>(part: Spectrum<L>, all: Spectrum<L>) -> Spectrum<L> {
    (part / all.max(1e-30)).saturate()
}
