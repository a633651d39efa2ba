//! Shadow rays of next event estimation (NEE): any-hit tracing, transmittance of cut-outs, and adding what arrives.
//!
//! In goes the queue [`ShadowRays`], out go contributions to the sums. A ray passes transparent surfaces up to the first opaque one.

use crate::accumulate::deposit::{Contribution, Deposits};
use crate::graph::CHUNK;
use crate::kernels;
use crate::stage::find::closures::{ClosureHits, MaterialHits, each_closure};
use crate::stage::light::linked_shadow;
use crate::stage::light::nee::clamps_late;
use crate::stage::light::openings::note_openings;
use crate::stage::light::textured_emission;
use crate::stage::shade::catcher;
use crate::state::chunk::ChunkColumns;
use crate::state::columns::load3;
use crate::state::queue::shadow_order::ShadowOrder;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::tables::Tables;
use crate::tables::material::{parameter_values, threshold};
use crate::tables::transport::{Limits, Transport};
use gonio_accel::TransparentHit;
use gonio_bsdf::parameter::OPACITY;
use gonio_simd::{Frame, Lanes, Spectrum, SpectrumColumns, dispatch};

/// Traces the queued shadow rays and adds the contributions of those that arrive.
pub(crate) fn trace_shadows(
    tables: &Tables,
    transport: &Transport,
    coherent: bool,
    shadows: &mut ShadowRays,
    trace: &mut ShadowTrace,
    chunk: &mut ChunkColumns,
    deposits: &mut Deposits,
) {
    if shadows.count == 0 {
        return;
    }
    trace.wavelengths.clone_from(&deposits.wavelengths);
    catcher::set_shadow_masks(tables, shadows);
    if !tables.links.shadows.is_empty() && linked_shadow::part(tables, shadows, &mut trace.linked) {
        trace.begin(shadows.count);
        linked_shadow::occlude(tables, transport, coherent, shadows, trace);
        dim_by_surfaces(tables, transport, trace, shadows, chunk);
    } else {
        occlude(tables, transport, coherent, shadows, trace, chunk);
    }
    textured_emission::multiply(tables, transport, trace, shadows, chunk);
    if clamps_late(tables, transport) {
        dispatch!(transport.execution, l => shadows.clamp(l));
    }
    if let Some(openings) = &transport.passes.openings {
        note_openings(openings, trace, shadows);
    }
    dispatch!(transport.execution, l => add_arrived(l, transport, shadows, &trace.blocked, deposits));
    deposits.note_arrivals(shadows, &trace.blocked);
    shadows.count = 0;
}

/// Finds which rays something opaque blocks (`trace.blocked`), and dims the contributions of the others by what they pass.
pub(crate) fn occlude(
    tables: &Tables,
    transport: &Transport,
    coherent: bool,
    shadows: &mut ShadowRays,
    trace: &mut ShadowTrace,
    chunk: &mut ChunkColumns,
) {
    let n = shadows.count;
    trace.begin(n);
    let (rays, blocked) = (shadows.rays.batch(0..n), &mut trace.blocked[..n]);
    let packets = coherent && tables.bvh.has_shadow_packets(transport.execution);
    if tables.any_transparent {
        tables.bvh.any_hit_transparent(transport.execution, &rays, blocked, &mut trace.passed);
    } else if packets && ShadowOrder::pays(&tables.lights) {
        trace.order.occluded(&tables.bvh, &tables.lights, transport.execution, shadows, blocked);
    } else {
        tables.bvh.occluded(transport.execution, &rays, packets, blocked);
    }
    dim_by_surfaces(tables, transport, trace, shadows, chunk);
}

#[inline(always)]
fn add_arrived<L: Lanes>(l: L, transport: &Transport, shadows: &ShadowRays, blocked: &[u8], deposits: &mut Deposits) {
    for at in (0..shadows.count).step_by(L::COUNT) {
        let mut bits = 0;
        for lane in 0..L::COUNT {
            bits |= u64::from(blocked[at + lane] == 0) << lane;
        }
        let arrived = gonio_simd::M(l.mask_from_bits(bits)) & l.first(shadows.count - at);
        let [diffuse, glossy] = &shadows.shares;
        let shares = if deposits.wants_shares(transport) { Some([diffuse.load(l, at), glossy.load(l, at)]) } else { None };
        let [light, slot, code] =
            [l.load_integers(&shadows.light, at), l.load_integers(&shadows.slot, at), l.load_integers(&shadows.code, at)];
        let light = Contribution::sampled(light, slot, shadows.contribution.load(l, at), code, shares);
        let counted = deposits.deposit(transport, &light, arrived);
        if deposits.sky.is_some() {
            deposits.note_sky(&light, load3(l, &shadows.rays.direction, at), counted);
        }
    }
}

/// Blocks rays that pass more surfaces than their paths may still go straight through.
fn block_deep(tables: &Tables, limits: &Limits, trace: &mut ShadowTrace, shadows: &ShadowRays) {
    let ShadowTrace { blocked, passed, crossed, .. } = trace;
    crossed.clear();
    crossed.resize(shadows.count, 0);
    for hit in &*passed {
        let counts = !tables.materials.bounds_alone(tables.geometry.material(hit.instance, hit.primitive));
        crossed[hit.ray as usize] += u32::from(counts);
    }
    for (ray, crossed) in crossed.iter().enumerate() {
        if *crossed > limits.straight_left(shadows.straight[ray]) {
            blocked[ray] = 1;
        }
    }
    passed.retain(|hit| blocked[hit.ray as usize] == 0);
}

/// Multiplies contributions by the transmittance of the surfaces their rays passed, material by material.
fn dim_by_surfaces(tables: &Tables, transport: &Transport, trace: &mut ShadowTrace, shadows: &mut ShadowRays, columns: &mut ChunkColumns) {
    trace.depth.clear();
    if tables.any_transparent && transport.limits.counts_straight() {
        block_deep(tables, &transport.limits, trace, shadows);
    }
    let mut passed = std::mem::take(&mut trace.passed);
    let material_of = |hit: &TransparentHit| tables.geometry.material(hit.instance, hit.primitive);
    // The distance settles the order, and numbers where it is the same, so that the product is the same however the tree was walked.
    let numbers = |hit: &TransparentHit| (hit.instance, hit.primitive);
    passed.sort_unstable_by(|a, b| {
        let order = (material_of(a), a.ray).cmp(&(material_of(b), b.ray));
        order.then(a.t.total_cmp(&b.t)).then_with(|| numbers(a).cmp(&numbers(b)))
    });
    for hits in passed.chunk_by(|a, b| material_of(a) == material_of(b)) {
        let material = material_of(&hits[0]);
        for chunk in hits.chunks(CHUNK) {
            dispatch!(transport.execution, l => dim_chunk(l, tables, material, chunk, trace, shadows, columns));
        }
    }
    trace.passed = passed;
    if tables.any_absorbing {
        dispatch!(transport.execution, l => attenuate(l, tables, shadows, trace));
    }
}

#[inline(always)]
fn dim_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    material: u32,
    hits: &[TransparentHit],
    trace: &mut ShadowTrace,
    shadows: &mut ShadowRays,
    columns: &mut ChunkColumns,
) {
    let ShadowTrace { weights, factors, wavelengths, .. } = trace;
    factors.clear();
    let wavelengths = wavelengths.as_deref().map(|wavelengths| (wavelengths, &*shadows.slot));
    let chunk = MaterialHits { material, hits, rays: &shadows.rays, wavelengths };
    each_closure(
        l,
        tables,
        chunk,
        |mix| &mix.program,
        (weights, columns),
        #[inline(always)]
        |closure| add_transmittance(l, tables, closure, factors),
    );
    for (i, hit) in hits.iter().enumerate() {
        shadows.contribution.multiply(hit.ray as usize, factors, i);
    }
    if let Some(row) = tables.materials.interior(material) {
        trace.depth.add(row, hits, &columns.surface.side);
    }
}

/// Dims what shadow rays carry by what they go through.
#[inline(always)]
fn attenuate<L: Lanes>(l: L, tables: &Tables, shadows: &mut ShadowRays, trace: &mut ShadowTrace) {
    trace.of_rays.fill(trace.wavelengths.as_deref(), shadows.slot[..shadows.count].iter().copied());
    let media = (&tables.materials.media, trace.of_rays.column());
    trace.depth.add_up(l, media, &shadows.media, &shadows.rays.t_max, shadows.count);
    for at in (0..shadows.count).step_by(L::COUNT) {
        let left = trace.depth.transmittance(l, at);
        shadows.contribution.store(shadows.contribution.load(l, at) * left, at);
    }
    if tables.materials.media.varies() {
        trace.track(l, tables, shadows);
    }
}

/// Adds what a closure lets pass straight, times its weights if it is one of several.
#[inline(always)]
pub(crate) fn add_transmittance<L: Lanes>(l: L, tables: &Tables, mut closure: ClosureHits<'_>, sums: &mut SpectrumColumns) {
    let material = &tables.materials.surfaces[closure.surface];
    if !material.lets_light_pass {
        return;
    }
    closure.run(l, tables, &material.program);
    let ClosureHits { weights, hits, columns, .. } = closure;
    let (surface, values) = (&columns.surface, parameter_values(material, columns.outputs()));
    for at in (0..hits.len()).step_by(L::COUNT) {
        let frame = Frame::from_normal(load3(l, &surface.shading_normal, at));
        let wo = frame.to_local(load3(l, &surface.wo, at));
        let entering = l.load(&surface.side, at).gt(0.0);
        let mut factor = if material.opacity_threshold > 0.0 {
            Spectrum::constant(1.0 - threshold(values.get(l, OPACITY, at), material.opacity_threshold))
        } else {
            kernels::transmittance(l, &material.surface, &values, at, wo, entering)
        };
        if let Some(weights) = weights {
            factor = factor * weights.load(l, at);
        }
        sums.store(sums.load(l, at) + factor, at);
    }
}
