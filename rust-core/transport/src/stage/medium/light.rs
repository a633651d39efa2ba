//! Next event estimation in media: a light is sampled for one place of each way; where media vary, for one of those where
//! tracking might scatter it.
//!
//! In even media the place is drawn by distance or towards a point of the light (equiangular sampling), by the balance heuristic over both, where the light reaches
//! the way. Kulla and Fajardo,
//! Importance Sampling Techniques for Path Tracing in Participating Media (2012).

use super::context::MediumContext;
use super::flight::Lit;
use super::scatter::{flags, light_context};
use super::way::Way;
use crate::accumulate::deposit::{Contribution, Deposits, code_of_found};
use crate::accumulate::expression_sums::with_state;
use crate::kernels;
use crate::stage::light::nee::{late_ceiling, send};
use crate::stage::shade::catcher;
use crate::state::queue::shadow_rays::{Along, ShadowRays};
use crate::state::vertex::Interaction;
use crate::words::event;
use gonio_camera::sampler::dimension;
use gonio_light::{LightAlong, LightSample, LightSampleContext, LightWay, power_heuristic};
use gonio_simd::{F, Frame, Lanes, M, Spectrum, U, Vec3};

/// Optical depths below this are drawn from evenly.
const THIN: f32 = 0.02;
/// Lights further away than this lie in a direction, not at a point.
const FAR: f32 = 1e9;
/// Part of the places that are drawn towards the light, where it lies at a point.
const EQUIANGULAR: f32 = 0.5;

/// The part of a way that the light reaches: metres from where that begins.
#[derive(Clone, Copy, Debug)]
struct Part<L: Lanes> {
    way: LightWay<L>,
    /// Probabilities of the components of light, and extinctions.
    channels: Spectrum<L>,
    extinction: Spectrum<L>,
}

impl<L: Lanes> Part<L> {
    /// The share of light that a component loses on it.
    #[inline(always)]
    fn lost(&self, extinction: F<L>) -> F<L> {
        1.0 - (-(extinction * self.way.length)).exp()
    }

    /// Draws a place by distance.
    #[inline(always)]
    fn draw(&self, u: [F<L>; 2]) -> F<L> {
        let length = self.way.length;
        let extinction = self.channels.choose(u[0], self.extinction);
        let thin = (extinction * length).lt(THIN);
        let thick = -(1.0 - u[1] * self.lost(extinction)).max(f32::MIN_POSITIVE).ln() / extinction.max(f32::MIN_POSITIVE);
        thin.select(u[1] * length, thick).min(length)
    }

    /// The density of that, a metre.
    #[inline(always)]
    fn density(&self, distance: F<L>) -> F<L> {
        let length = self.way.length;
        let density = self.extinction.map(
            #[inline(always)]
            |extinction| {
                let thin = (extinction * length).lt(THIN);
                let thick = extinction * (-(extinction * distance)).exp() / self.lost(extinction).max(f32::MIN_POSITIVE);
                thin.select(length.max(f32::MIN_POSITIVE).recip(), thick)
            },
        );
        self.channels.dot(density)
    }
}

/// A place of each way to be lit.
#[derive(Clone, Copy, Debug)]
struct Place<L: Lanes> {
    /// Metres from the way's beginning.
    distance: F<L>,
    /// A metre; 0 where no light arrives.
    pdf: F<L>,
    /// The light, and the probability with which it was selected.
    light: (U<L>, F<L>),
}

/// Selects a light for each way and a place where it is lit by it.
#[inline(always)]
fn place<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>) -> Place<L> {
    let (l, tables) = (way.pdf.lanes(), context.tables);
    let slot = way.core.slot;
    let [u_light, u_channel] = context.pair(l, slot, dimension::MEDIUM_LIGHT_CHOICE);
    let whole = LightWay { origin: way.place(l.f(0.0)), direction: way.direction, length: way.length, open: open(way) };
    let LightAlong { light, centre, reached: [from, to] } = kernels::sample_along(l, tables, &whole, u_light);
    let reached = to.gt(from);
    let part = LightWay { origin: whole.place(from), length: (to - from).max(0.0), ..whole };
    let by_distance = Part { way: part, channels: way.channels(), extinction: way.extinction };
    // The point of the light is looked for from where the way is nearest to its middle.
    let nearest = part.place((centre - part.origin).dot(part.direction).clamp(0.0, part.length));
    let point = kernels::sample_li_of(l, tables, light, &light_context(nearest), &context.pair(l, slot, dimension::MEDIUM_POINT));
    let found = point.pdf.gt(0.0);
    let near = centre.max_abs().lt(FAR) & (!found | point.distance.lt(FAR));
    let aim = found.select(nearest + point.wi * point.distance.min(FAR), centre);
    let by_angle = part.seen_from(aim, l.f(0.0));
    let [u_way, u] = context.pair(l, slot, dimension::MEDIUM_PLACE);
    let angular = near & u_way.lt(EQUIANGULAR);
    let distance = angular.select(by_angle.draw(u).clamp(0.0, part.length), by_distance.draw([u_channel, u]));
    let drawn = by_distance.density(distance);
    let pdf = near.select(by_angle.density(distance).lerp(drawn, 1.0 - EQUIANGULAR), drawn);
    Place { distance: from + distance, pdf: pdf.keep_if(reached), light }
}

/// Metres of each way that may show light from infinity: as far as one sees, and none of ways without end through what dims all components.
#[inline(always)]
fn open<L: Lanes>(way: &Way<L>) -> F<L> {
    let l = way.pdf.lanes();
    let seen = way.extinction.mean().max(f32::MIN_POSITIVE).recip();
    (way.met | way.extinction.min_component().le(0.0)).select(way.length.min(seen), l.f(0.0))
}

/// Samples a light for each chosen way through even media and queues the shadow ray to it.
#[inline(always)]
pub(super) fn sample_along<L: Lanes>(
    context: &MediumContext<'_>,
    way: &Way<L>,
    chosen: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let tables = context.tables;
    if !chosen.any() || tables.lights.is_empty() {
        return;
    }
    let l = way.pdf.lanes();
    let Place { distance, pdf, light } = place(context, way);
    let from = light_context(way.place(distance));
    let sample = kernels::sample_li_of(l, tables, light, &from, &context.pair(l, way.core.slot, dimension::MEDIUM_LIGHT));
    let usable = usable(context, way, &sample, chosen & pdf.gt(0.0));
    if usable.any() {
        let of_point = sample.pdf / light.1.max(f32::MIN_POSITIVE) * pmf(context, &from, light.0, usable);
        let left = way.transmittance(distance) * way.phase.scattering * pdf.max(f32::MIN_POSITIVE).recip();
        send_on(context, way, (&from, &sample, of_point), left, usable, shadows, deposits);
    }
}

/// Samples a light at a place of each chosen way, where anything scatters there, and queues the shadow ray to it.
#[inline(always)]
pub(super) fn sample_at<L: Lanes>(
    context: &MediumContext<'_>,
    way: &Way<L>,
    lit: &Lit<L>,
    chosen: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let MediumContext { tables, transport, .. } = *context;
    if !chosen.any() || tables.lights.is_empty() {
        return;
    }
    let (l, slot) = (way.pdf.lanes(), way.core.slot);
    let from = light_context(way.place(lit.distance));
    let [u_light, _] = context.pair(l, slot, dimension::MEDIUM_LIGHT_CHOICE);
    let [u, v] = context.pair(l, slot, dimension::MEDIUM_LIGHT);
    let sample = kernels::sample_li(l, tables, transport.light_cache.as_deref(), &from, &[u_light, u, v]);
    let usable = usable(context, way, &sample, chosen & lit.factor.is_lit());
    if usable.any() {
        send_on(context, &Way { phase: lit.phase, ..*way }, (&from, &sample, sample.pdf), lit.factor, usable, shadows, deposits);
    }
}

/// Those of samples that may bring light.
#[inline(always)]
fn usable<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>, sample: &LightSample<L>, chosen: M<L>) -> M<L> {
    let found = chosen & sample.pdf.gt(0.0) & sample.radiance.is_lit();
    found & catcher::may_sample(sample.pdf.lanes(), context.tables, way.core.slot, sample.light)
}

/// Queues shadow rays to samples of lights from places of ways; `left` is a factor on what the ways carry, the scattering with it, and the density of a
/// sample is that by which rays which find the light weigh theirs.
#[inline(always)]
fn send_on<L: Lanes>(
    context: &MediumContext<'_>,
    way: &Way<L>,
    (from, sample, of_point): (&LightSampleContext<L>, &LightSample<L>, F<L>),
    left: Spectrum<L>,
    usable: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let MediumContext { tables, transport, .. } = *context;
    let l = way.pdf.lanes();
    let (phase, pdf) = way.phase.eval(&tables.materials.media, way.direction, sample.wi);
    let weight = sample.delta.select(l.f(1.0), power_heuristic(of_point, pdf));
    let weight = weight * tables.lights.scattered_factor(l, sample.light, l.u(event::VOLUME));
    let radiance = tables.lights.light(context.sample.wavelengths(l, way.core.slot), sample.light, sample.radiance);
    let whole = radiance * way.core.throughput * left * phase * (weight / sample.pdf);
    // Held before it is dimmed on its way: so fog is as bright as Cycles' within limits, where surfaces hold what arrives. Only what programs tell of
    // meshes that shine waits for that.
    let held = transport.limits.clamped(whole, way.bounces() + 1);
    let value = if tables.lights.any_shaded() {
        (tables.lights.is_shaded(l, sample.light) & sample.casts_shadow).select(whole, held)
    } else {
        held
    };
    let ceiling = late_ceiling(tables, transport, way.bounces() + 1);
    let lit = usable & value.is_lit() & value.abs().max_component().is_finite();
    let flags = flags(context, way);
    let code = with_state(&transport.passes, code_of_found(flags, 0), flags);
    let shares = if deposits.wants_shares(transport) { Some([Spectrum::one(l), Spectrum::zero(l)]) } else { None };
    let light = Contribution::sampled(sample.light, way.core.slot, value, code, shares);
    let along = Along::new(tables, transport, way.core.media, way.core.counts, ceiling);
    let at = floating(from);
    send(transport, (&at, at.spawn_ray_to(sample)), (sample, along), &light, lit, shadows, deposits);
}

/// The probability with which a light is selected at a place, as the weights of rays that find it have it.
#[inline(always)]
fn pmf<L: Lanes>(context: &MediumContext<'_>, from: &LightSampleContext<L>, light: U<L>, chosen: M<L>) -> F<L> {
    kernels::light_pmf(from.position.x.lanes(), context.tables, context.transport.light_cache.as_deref(), from, light.keep_if(chosen))
}

/// A place in a medium, off which rays start as they are.
#[inline(always)]
fn floating<L: Lanes>(from: &LightSampleContext<L>) -> Interaction<L> {
    let l = from.position.x.lanes();
    let frame = Frame::from_normal(Vec3::splat(l, [0.0, 0.0, 1.0]));
    Interaction { position: from.position, error: l.f(0.0), geometric: from.normal, frame, receiver: from.receiver }
}
