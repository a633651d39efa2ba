//! Illuminance: measured points are lit (NEE with MIS) and scatter like white Lambertian surfaces, π times over.
//!
//! Irradiance E = ∫ L cosθ dω equals π times the radiance that a white Lambertian surface sends out, so the same estimators serve.

use crate::accumulate::deposit::{Contribution, Deposits};
use crate::kernels;
use crate::stage::light::merge::{Found, irradiance};
use crate::stage::light::nee::send;
use crate::state::columns::load3;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::queue::measure_points::MeasurePoints;
use crate::state::queue::shadow_rays::{Along, ShadowRays};
use crate::state::sample::SampleContext;
use crate::state::vertex::{CONE_PER_ROUGHNESS, Interaction};
use crate::tables::Tables;
use crate::tables::transport::{FirstLight, Transport};
use crate::words::{code, counts, event, flag};
use gonio_camera::sampler::dimension;
use gonio_light::{FixedLightSample, LightSample, SampleWeight};
use gonio_simd::{F, Frame, Lanes, M, U, Vec3};
use std::{
    f32::consts::{FRAC_1_PI, PI},
    ops::Range,
};

/// What lighting a chunk of measured points reads.
#[derive(Clone, Debug)]
pub(crate) struct MeasureContext<'a, L> {
    pub(crate) l: L,
    pub(crate) tables: &'a Tables,
    pub(crate) transport: &'a Transport,
    pub(crate) sample: &'a SampleContext<'a>,
    pub(crate) points: &'a MeasurePoints,
    /// The points of the chunk.
    pub(crate) range: Range<usize>,
}

/// One register of measured points.
#[derive(Clone, Copy, Debug)]
struct MeasuredPoint<L: Lanes> {
    alive: M<L>,
    at: Interaction<L>,
    core: PathCore<L>,
}

/// Lights some points by the same fixed samples each.
#[inline(always)]
pub(crate) fn light_by_fixed_samples<L: Lanes>(
    chunk: &MeasureContext<'_, L>,
    samples: &[FixedLightSample],
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let MeasureContext { l, tables, ref range, .. } = *chunk;
    for place in range.clone().step_by(L::COUNT) {
        let point = load_point(l, place, l.first(range.end - place), chunk.points);
        for fixed in samples {
            let reached = tables.lights.reaches(l, fixed, &point.at.light_context()) & point.alive;
            if reached.any() {
                let sample = kernels::sample_fixed(l, tables, fixed, &point.at.light_context());
                queue_shadow_ray(chunk, &point, (&sample, SampleWeight::Fixed(fixed.share)), l.u(0), shadows, deposits);
            }
        }
    }
}

/// Lights some points from given directions, as a radiance of 1 does within a steradian about each. What arrives has the direction's number
/// beside its light pass.
#[inline(always)]
pub(crate) fn light_from_directions<L: Lanes>(
    chunk: &MeasureContext<'_, L>,
    directions: &[([f32; 3], u32)],
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let MeasureContext { l, ref range, .. } = *chunk;
    for place in range.clone().step_by(L::COUNT) {
        let point = load_point(l, place, l.first(range.end - place), chunk.points);
        for ([x, y, z], number) in directions {
            let sample = LightSample::from_direction(l, Vec3::new(l.f(*x), l.f(*y), l.f(*z)));
            queue_shadow_ray(chunk, &point, (&sample, SampleWeight::Fixed(1.0)), l.u(*number << code::NUMBER_SHIFT), shadows, deposits);
        }
    }
}

/// Lights some points by one light each and starts their paths.
#[inline(always)]
pub(crate) fn light_and_start<L: Lanes>(
    chunk: &MeasureContext<'_, L>,
    shadows: &mut ShadowRays,
    next: &mut Paths,
    deposits: &mut Deposits,
) {
    let MeasureContext { l, tables, transport, sample: context, ref range, .. } = *chunk;
    let mut found = Found::default();
    for place in range.clone().step_by(L::COUNT) {
        let point = load_point(l, place, l.first(range.end - place), chunk.points);
        let index = context.index(l, point.core.slot);
        let base = context.dimension(dimension::MEASURE);
        let [u_light, _] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
        if !tables.lights.is_empty() {
            let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
            let light_cache = transport.light_cache.as_deref();
            let sample = kernels::sample_li(l, tables, light_cache, &point.at.light_context(), &[u_light, u, v]);
            queue_shadow_ray(chunk, &point, (&sample, SampleWeight::Mis), l.u(0), shadows, deposits);
        }
        if let (Some(photons), true) = (&transport.photons, transport.first_light != FirstLight::Discs) {
            let irradiance = irradiance(
                context.wavelengths(l, point.core.slot),
                &photons.fine,
                [point.at.position, point.at.geometric],
                point.alive,
                &mut found,
            );
            let light = Contribution::sampled(l.u(0), point.core.slot, irradiance * point.core.throughput, l.u(0), None);
            deposits.deposit(transport, &light, point.alive & irradiance.is_lit());
        }
        let left = if transport.photons.is_some() { flag::LEFT_TO_LIGHT_PATHS } else { 0 };
        start(l, &point, context.sampler.pair(l, index, base + dimension::BSDF), left, next);
    }
}

#[inline(always)]
fn load_point<L: Lanes>(l: L, at: usize, alive: M<L>, points: &MeasurePoints) -> MeasuredPoint<L> {
    MeasuredPoint {
        alive,
        at: Interaction {
            position: load3(l, &points.position, at),
            error: l.load(&points.error, at),
            geometric: load3(l, &points.geometric_normal, at),
            frame: Frame::from_normal(load3(l, &points.shading_normal, at)),
            receiver: l.load_integers(&points.receiver, at),
        },
        core: points.core(l, at),
    }
}

/// Queues the shadow ray to a light sample, which counts by a weight for a light pass.
#[inline(always)]
fn queue_shadow_ray<L: Lanes>(
    chunk: &MeasureContext<'_, L>,
    point: &MeasuredPoint<L>,
    (sample, weight): (&LightSample<L>, SampleWeight),
    code: U<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let cosine = point.at.frame.z.dot(sample.wi).max(0.0);
    let usable = point.alive & sample.pdf.gt(0.0) & cosine.gt(0.0) & sample.radiance.is_lit();
    let usable = usable.and_not(chunk.tables.lights.scattered_factor(chunk.l, sample.light, chunk.l.u(event::DIFFUSE)).eq(0.0));
    if !usable.any() {
        deposits.note_lost(&point.at, point.alive);
        return;
    }
    let weight = weight.of(sample, cosine * FRAC_1_PI);
    let wavelengths = chunk.sample.wavelengths(chunk.l, point.core.slot);
    let radiance = chunk.tables.lights.light(wavelengths, sample.light, sample.radiance);
    let value = radiance * point.core.throughput * (cosine * weight / sample.pdf);
    let lit = usable & value.is_lit() & value.abs().max_component().is_finite();
    deposits.note_lost(&point.at, point.alive.and_not(lit));
    let light = Contribution::sampled(sample.light, point.core.slot, value, code, None);
    // What is measured is never clamped.
    let along = Along::new(chunk.tables, chunk.transport, point.core.media, chunk.l.u(0), Some(chunk.l.f(f32::MAX)));
    send(chunk.transport, (&point.at, point.at.spawn_ray_to(sample)), (sample, along), &light, lit, shadows, deposits);
}

#[inline(always)]
fn start<L: Lanes>(l: L, point: &MeasuredPoint<L>, u: [F<L>; 2], left: u32, next: &mut Paths) {
    let local = cosine_hemisphere(u);
    let direction = point.at.frame.to_world(local).normalize();
    // Light that reaches the shading normal's hemisphere from below the triangle cannot be there.
    let alive = point.alive & local.z.gt(0.0) & point.at.geometric.dot(direction).gt(0.0);
    let core = PathCore {
        throughput: point.core.throughput * PI,
        spread: l.f(CONE_PER_ROUGHNESS),
        flags: l.u(flag::NON_SPECULAR_SEEN | flag::ROUGH | left | (1 << flag::BOUNCE_SHIFT)),
        counts: l.u(counts::DIFFUSE),
        ..point.core
    };
    next.append(&PathLanes::start(point.at.spawn_ray(direction), core).leaving(point.at.light_context(), local.z * FRAC_1_PI), alive);
}

/// A direction of the cosine distribution about +z (Malley's method).
#[inline(always)]
fn cosine_hemisphere<L: Lanes>(u: [F<L>; 2]) -> Vec3<L> {
    let [x, y] = gonio_camera::concentric_disk(u);
    let z = (x.lanes().f(1.0) - x * x - y * y).safe_sqrt();
    Vec3::new(x, y, z)
}
