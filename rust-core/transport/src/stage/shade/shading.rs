//! Shading: a chunk of hits of one material, whose surface points and parameters are ready.
//!
//! A register of hits at a time: absorption, BSDF lobes, emission with MIS (multiple importance sampling), AOVs. The [`Integrator`] does the rest:
//! cut-outs, next event estimation (NEE), and the rays that go on. Out come contributions, shadow rays, the next rays, and subsurface walks.

use crate::accumulate::deposit::{Contribution, Deposits, Source, code_of_found};
use crate::accumulate::expression_sums::with_state;
use crate::accumulate::guides::{add_guides, is_specular_path};
use crate::geometry::NONE;
use crate::kernels::{self, LightHit};
use crate::stage::shade::catcher;
use crate::stage::shade::first_surface::{add_first_surface, without_holdouts};
use crate::stage::shade::integrator::Integrator;
use crate::stage::shade::media::absorb;
use crate::state::chunk::ChunkContext;
use crate::state::columns::load3;
use crate::state::mix_weights::ClosureWeights;
use crate::state::queue::Queues;
use crate::state::queue::measure_points::{MeasureLanes, MeasurePoints};
use crate::state::vertex::{Interaction, Vertex};
use crate::tables::material::{SurfaceMaterial, parameter_values};
use crate::tables::transport::PathFilter;
use crate::words::{code, event, flag};
use gonio_bsdf::{
    Hits, Lobes, WAY_NUMBERS,
    normals::{Normals, is_raised},
};
use gonio_camera::sampler::dimension;
use gonio_light::hit_weight;
use gonio_simd::{F, Frame, Lanes, M, Spectrum, Vec3, Wavelengths};

/// Shades a chunk, whose surface columns and parameters are ready.
#[inline(always)]
pub(crate) fn shade_chunk<L: Lanes, I: Integrator>(
    integrator: &I,
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, transport, count, columns, .. } = *chunk;
    let values = parameter_values(material, columns.outputs());
    let mut lobes = Lobes::empty(l);
    queues.light_samples.made = false;
    for at in (0..count).step_by(L::COUNT) {
        let mut point = load_point(chunk, material, at);
        if tables.any_absorbing {
            absorb(chunk, material, &values, &mut point, at);
        }
        let (wo, entering) = (point.local_wo, l.load(&columns.surface.side, at).gt(0.0));
        let normals = normals(chunk, material, &point, at);
        let numbers = way_numbers(chunk, material, &point);
        let carried = carried(material, point.core.throughput);
        let (normals, numbers) = (normals.as_ref(), numbers.as_ref());
        let hits = Hits { values: &values, at, wo, entering, normals, walks: I::WALKS, carried, numbers };
        material.surface.resolve(l, &hits, &mut lobes);
        if transport.limits.caustics != [true; 2] {
            let [reflecting, refracting] = transport.limits.caustics;
            lobes.without_facets(l, [!reflecting, !refracting], scattered_diffusely(&point));
        }
        integrator.shade(chunk, material, &mut point, &lobes, at, queues, deposits);
    }
}

#[inline(always)]
fn load_point<L: Lanes>(chunk: &ChunkContext<'_, L>, material: &SurfaceMaterial, at: usize) -> Vertex<L> {
    let ChunkContext { l, paths, .. } = *chunk;
    let surface = &chunk.columns.surface;
    let path = l.load_integers(chunk.order, at);
    let shading = load3(l, &surface.shading_normal, at);
    let frame =
        if material.anisotropic { Frame::from_tangent(shading, load3(l, &surface.tangent, at)) } else { Frame::from_normal(shading) };
    let wo = load3(l, &surface.wo, at);
    let instance = l.load_integers(&surface.instance, at);
    let place = Interaction {
        position: load3(l, &surface.position, at),
        error: l.load(&surface.error, at),
        geometric: load3(l, &surface.geometric_normal, at),
        frame,
        receiver: chunk.tables.links.receiver(l, instance),
    };
    let (mut core, pdf) = paths.core(l, path);
    core.flags = core.flags & !flag::COVERED;
    core.width = l.load(&surface.cone, at);
    let mut point = Vertex::new(place, [wo, frame.to_local(wo)], core, [path, instance], at, l.first(chunk.count - at));
    (point.pdf, point.share) = (pdf, pdf);
    point
}

/// Where the path came from a surface that scattered it diffusely.
#[inline(always)]
fn scattered_diffusely<L: Lanes>(point: &Vertex<L>) -> M<L> {
    let last = (point.core.flags >> flag::LAST_SHIFT) & 3;
    point.alive & last.eq(event::DIFFUSE) & point.bounces.ne(0)
}

/// What paths carry, where the material disperses.
#[inline(always)]
pub(crate) fn carried<L: Lanes>(material: &SurfaceMaterial, light: Spectrum<L>) -> Option<Spectrum<L>> {
    if material.surface.lobes.disperses { Some(light) } else { None }
}

/// What fibres draw their ways inside by, where the material has such.
#[inline(always)]
pub(crate) fn way_numbers<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
) -> Option<[F<L>; WAY_NUMBERS]> {
    if !material.surface.lobes.drawn {
        return None;
    }
    let (l, context) = (chunk.l, &chunk.sample);
    let (index, first) = (context.index(l, point.core.slot), context.dimension(dimension::FIBRE));
    let [enters, mirrors, leaves] = [0, 1, 2].map(
        #[inline(always)]
        |pair| context.sampler.pair(l, index, first + pair),
    );
    let across = context.sampler.third(l, index, first);
    Some([enters[0], enters[1], mirrors[0], mirrors[1], leaves[0], leaves[1], across])
}

/// The normals beside the shading normal, where the material or the way that the view meets them asks for any.
#[inline(always)]
pub(crate) fn normals<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
    at: usize,
) -> Option<Normals<L>> {
    let (l, surface, program) = (chunk.l, &chunk.columns.surface, &material.program);
    let frame = &point.at.frame;
    let geometric = frame.to_local(point.at.geometric);
    let mapped = program.normal.is_some();
    let asked = (mapped && program.free_normal) || program.coat_normal.is_some();
    // Maps that are not free keep mirror directions above the surface already.
    if !asked && (mapped || !(point.alive & is_raised(geometric, point.local_wo)).any()) {
        return None;
    }
    let smooth = if mapped { frame.to_local(load3(l, &surface.smooth_normal, at)) } else { Vec3::splat(l, [0.0, 0.0, 1.0]) };
    let coat = if program.coat_normal.is_some() { Some(frame.to_local(load3(l, &surface.coat_normal, at))) } else { None };
    Some(Normals { geometric, smooth, coat })
}

/// Records the denoisers' guides and measured points; returns where lights can be sampled (not purely specular), and which paths go on.
#[inline(always)]
pub(crate) fn guide_and_measure<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &mut Vertex<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    points: &mut MeasurePoints,
    deposits: &mut Deposits,
) -> [M<L>; 2] {
    let transport = chunk.transport;
    let [non_specular, all_delta] = lobes.specularity(chunk.l);
    point.all_delta = all_delta;
    add_guides(chunk, point, lobes, present, &mut deposits.sums);
    // Beyond the last bounce a path still adds emission: the BSDF half of MIS, whose NEE half was sampled before.
    let going_on = present & point.bounces.lt(transport.limits.max_bounces + 1) & transport.limits.allow(point.core.counts, point.bounces);
    // Nothing comes to where another surface lies.
    let going_on = going_on.and_not(point.at.error.lt(0.0));
    if transport.passes.illuminance {
        let measured = MeasureLanes {
            position: point.at.position,
            error: point.at.error,
            geometric_normal: point.at.geometric,
            shading_normal: point.at.frame.z,
            receiver: point.at.receiver,
            core: point.core,
        };
        points.append(&measured, going_on.and_not(all_delta) & is_specular_path(point.core.flags, point.core.slot));
    }
    [non_specular, going_on]
}

/// Adds what a closure of a mix emits that does nothing else, times its weights at the hits; their paths go on with any closure.
#[inline(always)]
pub(crate) fn add_emission_apart<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    weights: ClosureWeights<'_>,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, count, columns, .. } = *chunk;
    let values = parameter_values(material, columns.outputs());
    for at in (0..count).step_by(L::COUNT) {
        let mut point = load_point(chunk, material, at);
        if tables.any_absorbing {
            absorb(chunk, material, &values, &mut point, at);
        }
        let present =
            if tables.geometry.set_holdout.is_empty() { point.alive } else { without_holdouts(chunk, material, &point, point.alive, None) };
        let weight = weights.load(l, at);
        add_emission(chunk, &point, material.surface.own_emission(l, &values, at) * weight, present, at, deposits);
    }
}

/// Adds emission, but for what was added apart, and first-surface AOVs; returns the lanes that are there, holdouts left out.
#[inline(always)]
pub(crate) fn add_seen<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    point: &mut Vertex<L>,
    lobes: &Lobes<'_, L>,
    (present, apart): (M<L>, bool),
    at: usize,
    deposits: &mut Deposits,
) -> M<L> {
    let geometry = &chunk.tables.geometry;
    let pierced = material.holdout || !geometry.set_holdout.is_empty();
    let present = if pierced { without_holdouts(chunk, material, point, present, Some(deposits)) } else { present };
    if material.surface.lobes.emission && !(apart && material.emits_apart) {
        add_emission(chunk, point, lobes.emission(), present, at, deposits);
    }
    // What is seen through a transparent closure comes first.
    let seen_through = material.surface.lobes.straight || material.surface.lobes.portal;
    if !seen_through && chunk.transport.path_filter != PathFilter::SpecularOnly {
        add_first_surface(chunk, material, point, lobes, present, at, deposits);
        if !geometry.set_catcher.is_empty() {
            catcher::add_behind(chunk, point, present, &mut deposits.sums);
        }
    }
    present
}

/// Adds emission, weighted by MIS where the triangle is a light that next event estimation could have sampled.
#[inline(always)]
fn add_emission<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    emission: Spectrum<L>,
    present: M<L>,
    at: usize,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, transport, .. } = *chunk;
    let mut value = emission * point.core.throughput;
    if !tables.emission_in_media.is_empty() {
        value = value * l.gather(&tables.emission_in_media, point.instance);
    }
    let mut present = present;
    if !tables.links.emitters.is_empty() {
        let receiver = chunk.paths.previous(l, point.path).receiver;
        present &= tables.lights.sees_set(l, receiver, l.gather_integers(&tables.links.emitters, point.instance));
    }
    if !tables.triangle_lights.is_empty() {
        let first = l.gather_integers(&tables.triangle_lights, point.instance);
        let sampled = present & first.ne(NONE) & (point.core.flags & flag::DELTA).eq(0);
        if sampled.any() {
            let light = (first + l.load_integers(&chunk.columns.surface.primitive, at)).keep_if(sampled);
            let from = chunk.paths.previous(l, point.path);
            let hit = LightHit { light, from, direction: -point.wo, point: point.at.position };
            let (_, pdf) = kernels::eval_light(l, tables, transport.light_cache.as_deref(), &hit, sampled, Wavelengths::rgb(l));
            value = value * hit_weight(point.pdf, pdf, sampled);
        }
        if transport.light_paths.is_some() {
            let lights = present & first.ne(NONE);
            let light = (first + l.load_integers(&chunk.columns.surface.primitive, at)).keep_if(lights);
            present = present.and_not(transport.is_left_to_light_paths(point.core.flags, light, lights));
        }
    }
    let value = transport.limits.clamped(value, point.bounces);
    let expressions = transport.passes.expressions.as_deref();
    let source = if transport.passes.groups.wanted() || expressions.is_some() {
        Source::Set(tables.geometry.set_lanes(l, point.instance.keep_if(present)))
    } else {
        Source::Several
    };
    let light = Contribution {
        slot: point.core.slot,
        value,
        code: with_state(&transport.passes, code_of_found(point.core.flags, code::EMISSION), point.core.flags),
        shares: None,
        specular: is_specular_path(point.core.flags, point.core.slot),
        source,
    };
    deposits.deposit(transport, &light, present & value.is_lit());
}
