//! Illuminance: measured points are lit (NEE with MIS) and scatter like white Lambertian surfaces, π times over.
//!
//! Irradiance E = ∫ L cosθ dω equals π times the radiance that a white Lambertian surface sends out, so the same estimators serve.

use crate::accumulate::add::add_rgb;
use crate::accumulate::arrivals::note_lost;
use crate::geometry::{offset_ray_origin, shadow_ray_to};
use crate::kernels;
use crate::stage::shadow::make_room;
use crate::state::columns::load3;
use crate::state::flag;
use crate::state::paths::PathLanes;
use crate::state::sample::SampleContext;
use crate::state::shadow_rays::ShadowLanes;
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_camera::sampler::BATCH;
use gonio_camera::sampler::dimension;
use gonio_light::{FixedLightSample, LightSample, power_heuristic};
use gonio_simd::{F, Frame, Lanes, M, Rgb, U, Vec3, dispatch};
use std::{
    f32::consts::{FRAC_1_PI, PI},
    ops::Range,
};

/// One register of measured points.
#[derive(Clone, Copy, Debug)]
struct Point<L: Lanes> {
    alive: M<L>,
    position: Vec3<L>,
    error: F<L>,
    geometric: Vec3<L>,
    frame: Frame<L>,
    throughput: Rgb<L>,
    width: F<L>,
    slot: U<L>,
}

/// Lights the measured points and starts a path from each, where light from surface to surface is looked for.
pub(crate) fn measure(tables: &Tables, transport: &Transport, context: &SampleContext<'_>, ws: &mut Workspace) {
    let (count, together) = (ws.measure.count, transport.hits_together());
    for first in (0..count).step_by(together) {
        let chunk = first..(first + together).min(count);
        make_room(tables, transport, context.depth == 0, chunk.len(), ws);
        match &transport.fixed_samples {
            Some(samples) => dispatch!(transport.execution, l => light_by_fixed_samples(l, tables, samples, chunk, ws)),
            None => dispatch!(transport.execution, l => sample(l, tables, transport, context, chunk, ws)),
        }
    }
    ws.measure.count = 0;
}

/// Lights some points by the same fixed samples each.
#[inline(always)]
fn light_by_fixed_samples<L: Lanes>(l: L, tables: &Tables, samples: &[FixedLightSample], chunk: Range<usize>, ws: &mut Workspace) {
    for at in chunk.clone().step_by(L::COUNT) {
        let point = load_point(l, at, l.first(chunk.end - at), ws);
        for fixed in samples {
            let reached = tables.lights.reaches(l, fixed, point.position, point.frame.z) & point.alive;
            if reached.any() {
                let sample = kernels::sample_fixed(l, tables, fixed, &point.position, &point.frame.z);
                light(l, &point, &sample, Some(fixed.share), ws);
            }
        }
    }
}

/// Lights some points by one light each and starts their paths.
#[inline(always)]
fn sample<L: Lanes>(l: L, tables: &Tables, transport: &Transport, context: &SampleContext<'_>, chunk: Range<usize>, ws: &mut Workspace) {
    for at in chunk.clone().step_by(L::COUNT) {
        let point = load_point(l, at, l.first(chunk.end - at), ws);
        let index = context.index(l, point.slot);
        let base = dimension::FIRST_BOUNCE + context.depth * dimension::BOUNCE + dimension::MEASURE;
        let [u_light, _] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
        if !tables.lights.is_empty() {
            let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
            let light_cache = transport.light_cache.as_deref();
            let sample = kernels::sample_li(l, tables, light_cache, &point.position, &point.frame.z, &[u_light, u, v]);
            light(l, &point, &sample, None, ws);
        }
        start(l, &point, context.sampler.pair(l, index, base + dimension::BSDF), ws);
    }
}

#[inline(always)]
fn load_point<L: Lanes>(l: L, at: usize, alive: M<L>, ws: &Workspace) -> Point<L> {
    let m = &ws.measure;
    Point {
        alive,
        position: load3(l, &m.position, at),
        error: l.load(&m.error, at),
        geometric: load3(l, &m.geometric_normal, at),
        frame: Frame::from_normal(load3(l, &m.shading_normal, at)),
        throughput: load3(l, &m.throughput, at).into(),
        width: l.load(&m.width, at),
        slot: l.load_integers(&m.slot, at) + BATCH as u32,
    }
}

/// Queues the shadow ray to a light sample. Its weight is its `share` in the mean of several fixed samples, or else its MIS weight.
#[inline(always)]
fn light<L: Lanes>(l: L, point: &Point<L>, sample: &LightSample<L>, share: Option<f32>, ws: &mut Workspace) {
    let cosine = point.frame.z.dot(sample.wi).max(0.0);
    let usable = point.alive & sample.pdf.gt(0.0) & cosine.gt(0.0) & sample.radiance.is_lit();
    if !usable.any() {
        note_lost(point.position, point.alive, ws);
        return;
    }
    let weight = match share {
        Some(share) => l.f(share),
        None => sample.delta.select(l.f(1.0), power_heuristic(sample.pdf, cosine * FRAC_1_PI)),
    };
    let contribution = sample.radiance * point.throughput * (cosine * weight / sample.pdf);
    let lit = usable & contribution.is_lit() & contribution.max_component().is_finite();
    note_lost(point.position, point.alive.and_not(lit), ws);
    add_rgb(&mut ws.sums.radiance, point.slot, contribution, lit.and_not(sample.casts_shadow));
    let segment = shadow_ray_to(point.position, point.geometric, point.error, sample.wi, sample.distance);
    let ray = ShadowLanes { segment, contribution, slot: point.slot, code: l.u(0), light: sample.light, shares: None };
    ws.shadows.append(&ray, lit & sample.casts_shadow);
}

#[inline(always)]
fn start<L: Lanes>(l: L, point: &Point<L>, u: [F<L>; 2], ws: &mut Workspace) {
    let local = super::generate::cosine_hemisphere(u);
    let direction = point.frame.to_world(local).normalize();
    // Light that reaches the shading normal's hemisphere from below the triangle cannot be there.
    let alive = point.alive & local.z.gt(0.0) & point.geometric.dot(direction).gt(0.0);
    let state = PathLanes {
        origin: offset_ray_origin(point.position, point.geometric, point.error, direction),
        direction,
        t_min: l.f(0.0),
        t_max: l.f(f32::MAX),
        vertex: point.position,
        normal: point.frame.z,
        throughput: point.throughput * PI,
        pdf: local.z * FRAC_1_PI,
        width: point.width,
        spread: l.f(0.3),
        slot: point.slot,
        flags: l.u(flag::NON_SPECULAR_SEEN | (1 << flag::BOUNCE_SHIFT)),
        counts: l.u(1),
        medium: Rgb::zero(l),
    };
    ws.next.append(&state, alive);
}
