//! Next event estimation (NEE): a light sampled at each hit, its MIS weight (power heuristic), and the shadow ray to it.

use crate::accumulate::add::{add_sampled, code_of_sampled};
use crate::accumulate::arrivals::note_lost;
use crate::accumulate::light_groups::add_of_lights;
use crate::accumulate::surface_aovs::clamped;
use crate::geometry::shadow_ray_to;
use crate::kernels;
use crate::stage::catcher;
use crate::state::shadow_rays::ShadowLanes;
use crate::state::vertex::{Stage, Vertex};
use crate::state::workspace::Workspace;
use gonio_bsdf::Lobes;
use gonio_light::{LightSample, power_heuristic};
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// Samples one light and queues the shadow ray to it.
#[inline(always)]
pub(crate) fn light<L: Lanes>(
    stage: &Stage<'_, L>,
    point: &Vertex<L>,
    wo: Vec3<L>,
    lobes: &Lobes<'_, L>,
    u: [F<L>; 3],
    present: M<L>,
    ws: &mut Workspace,
) {
    let Stage { l, tables, transport, .. } = *stage;
    let sample = kernels::sample_li(l, tables, transport.light_cache.as_deref(), &point.position, &point.frame.z, &u);
    send(stage, point, wo, lobes, &sample, None, present, ws);
}

/// Queues the shadow ray to a light sample. Its weight is its `share` in the mean of several fixed samples, or else its MIS weight.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a surface and a light")]
pub(crate) fn send<L: Lanes>(
    stage: &Stage<'_, L>,
    point: &Vertex<L>,
    wo: Vec3<L>,
    lobes: &Lobes<'_, L>,
    sample: &LightSample<L>,
    share: Option<f32>,
    present: M<L>,
    ws: &mut Workspace,
) {
    let Stage { l, tables, transport, context, .. } = *stage;
    let usable = present & sample.pdf.gt(0.0) & sample.radiance.is_lit() & catcher::knows(l, tables, point.slot, sample.light);
    if !usable.any() {
        note_lost(point.position, present, ws);
        return;
    }
    let wi = point.frame.to_local(sample.wi);
    let (value, pdf) = lobes.eval(l, wo, wi);
    let weight = match share {
        Some(share) => l.f(share),
        None => sample.delta.select(l.f(1.0), power_heuristic(sample.pdf, pdf)),
    };
    let contribution = clamped(value * sample.radiance * point.throughput * (weight / sample.pdf), transport.clamp(context.depth));
    let lit = usable & contribution.is_lit() & contribution.max_component().is_finite();
    note_lost(point.position, present.and_not(lit), ws);
    let free = lit.and_not(sample.casts_shadow);
    let code = code_of_sampled(point.flags);
    let shares = if ws.sums.lights.wanted() { Some(shares(l, lobes, wo, wi, value)) } else { None };
    add_sampled(&mut ws.sums, code, point.slot, contribution, shares, free);
    add_of_lights(l, &transport.passes.groups, sample.light, point.slot, contribution, free, &mut ws.sums.groups);
    let segment = shadow_ray_to(point.position, point.geometric, point.error, sample.wi, sample.distance);
    let ray = ShadowLanes { segment, contribution, slot: point.slot, code, light: sample.light, shares };
    ws.shadows.append(&ray, lit & sample.casts_shadow);
}

/// The diffuse and the glossy share of what all lobes scatter.
#[inline(always)]
fn shares<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>, all: Rgb<L>) -> [Rgb<L>; 2] {
    let diffuse = kernels::eval_diffuse(l, lobes, wo, wi);
    // What facets send to the other side is transmitted.
    let glossy = (all - diffuse).keep_if(wi.z.gt(0.0));
    [share(diffuse, all), share(glossy, all)]
}

/// A part over the whole, channel by channel.
#[inline(always)]
fn share<L: Lanes>(part: Rgb<L>, all: Rgb<L>) -> Rgb<L> {
    let [r, g, b] = [part.r / all.r.max(1e-30), part.g / all.g.max(1e-30), part.b / all.b.max(1e-30)];
    Rgb::new(r.saturate(), g.saturate(), b.saturate())
}
