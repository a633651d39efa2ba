//! Paths that media scatter: the phase function gives their directions.

use super::context::MediumContext;
use super::flight::Flight;
use super::way::Way;
use crate::accumulate::add::{add, add_rgb};
use crate::accumulate::deposit::Deposits;
use crate::accumulate::guides::is_specular_path;
use crate::stage::shade::scatter::survival;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::rays::RayLanes;
use crate::state::vertex::CONE_PER_ROUGHNESS;
use crate::tables::expressions::scattering;
use crate::tables::transport::{Passes, PathFilter};
use crate::words::{event, flag};
use gonio_camera::sampler::dimension;
use gonio_light::LightSampleContext;
use gonio_simd::{Lanes, M, U, Vec3};

/// What floats in a medium has no dark side.
#[inline(always)]
pub(super) fn light_context<L: Lanes>(position: Vec3<L>) -> LightSampleContext<L> {
    let l = position.x.lanes();
    LightSampleContext { position, normal: Vec3::splat(l, [0.0; 3]), receiver: l.u(0) }
}

/// The flags of paths that have been scattered in a medium.
#[inline(always)]
pub(super) fn flags<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>) -> U<L> {
    let (l, before) = (way.pdf.lanes(), way.core.flags);
    // Light paths bring nothing to what floats.
    let kept = before & (flag::FROM_LIGHT | flag::SEEN_DIRECTLY);
    let scattered = kept | flag::scattered(before, l.u(event::VOLUME));
    let state = match &context.transport.passes.expressions {
        Some(expressions) => expressions.step(before, l.u(scattering::VOLUME)),
        None => Passes::opening(before),
    };
    scattered | state | (flag::NON_SPECULAR_SEEN | flag::ROUGH)
}

/// What cameras see of places where light scatters, or tracking leaves nothing of it: coverage, and guides for denoisers.
#[inline(always)]
pub(super) fn add_seen<L: Lanes>(
    context: &MediumContext<'_>,
    (way, flight): (&Way<L>, &Flight<L>),
    [scattered, absorbed]: [M<L>; 2],
    deposits: &mut Deposits,
) {
    let (core, transport) = (&way.core, context.transport);
    // The pdf of camera rays is their share of the sample. Of those that met nothing, found light has told by how much they cover.
    let seen = (scattered | absorbed) & (core.flags & flag::CAMERA).ne(0);
    add(&mut deposits.sums.alpha, core.slot, way.pdf, seen & way.met);
    if let Some(distance) = transport.passes.deep {
        let depth = transport.deep_depth(distance, way.place(flight.distance.min(way.length)));
        deposits.sums.deep.add(core.slot, depth, way.pdf, seen, true);
    }
    if !transport.passes.guides || transport.path_filter == PathFilter::ExceptSpecular {
        return;
    }
    let albedo = way.phase.scattering / way.extinction.max(f32::MIN_POSITIVE) * core.throughput;
    let albedo = context.sample.to_film(core.slot, albedo * (1.0 / transport.squared_index));
    add_rgb(&mut deposits.sums.guides[0], core.slot, albedo, scattered & is_specular_path(core.flags, core.slot));
}

/// Sends scattered paths on, after Russian roulette.
#[inline(always)]
pub(super) fn go_on<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>, flight: &Flight<L>, chosen: M<L>, next: &mut Paths) {
    if !chosen.any() {
        return;
    }
    let l = way.pdf.lanes();
    let slot = way.core.slot;
    let [u_medium, u_roulette] = context.pair(l, slot, dimension::PHASE_CHOICE);
    let [u, v] = context.pair(l, slot, dimension::PHASE);
    let sample = way.phase.sample(&context.tables.materials.media, way.direction, [u_medium, u, v]);
    let throughput = way.core.throughput * flight.factor * sample.factor;
    let survival = survival(context.sample.depth, throughput * way.core.unguided, chosen);
    let alive = chosen & u_roulette.lt(survival) & throughput.is_lit() & throughput.max_component().is_finite();
    if !alive.any() {
        return;
    }
    let position = way.place(flight.distance);
    let core = PathCore {
        throughput: throughput * survival.recip(),
        flags: flags(context, way),
        width: way.core.spread.mul_add(flight.distance, way.core.width),
        spread: way.core.spread + CONE_PER_ROUGHNESS,
        ..way.core
    };
    let ray = RayLanes { origin: position, direction: sample.direction, t_min: l.f(0.0), t_max: l.f(f32::MAX) };
    next.append(&PathLanes::start(ray, core).leaving(light_context(position), sample.pdf), alive);
}
