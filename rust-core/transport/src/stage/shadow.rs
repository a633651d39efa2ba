//! Shadow rays of next event estimation (NEE): any-hit tracing, transmittance of cut-outs, and adding what arrives.
//!
//! In goes the queue [`ShadowRays`], out go contributions to the sums. A ray passes transparent surfaces up to the first opaque one.

use crate::accumulate::add::add_sampled;
use crate::accumulate::arrivals::note_arrivals;
use crate::accumulate::light_groups::add_of_lights;
use crate::graph::CHUNK;
use crate::kernels;
use crate::stage::catcher;
use crate::stage::surface::{ChunkRays, ChunkSource};
use crate::state::columns::load3;
use crate::state::shadow_order::ShadowOrder;
use crate::state::shadow_rays::{SHADOW_ROOM, ShadowRays};
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::material::{Shading, parameter_values, threshold};
use crate::tables::transport::Transport;
use gonio_accel::{RayBatch, TransparentHit};
use gonio_bsdf::parameter::OPACITY;
use gonio_simd::{Frame, Lanes, PADDING, Rgb, dispatch};

/// Traces the queue if the shadow rays of some more hits would not fit into it.
pub(crate) fn make_room(tables: &Tables, transport: &Transport, coherent: bool, hits: usize, ws: &mut Workspace) {
    if ws.shadows.count + hits * transport.rays_per_hit() > SHADOW_ROOM - PADDING {
        trace_shadows(tables, transport, coherent, ws);
    }
}

/// Traces the queued shadow rays and adds the contributions of those that arrive.
pub(crate) fn trace_shadows(tables: &Tables, transport: &Transport, coherent: bool, ws: &mut Workspace) {
    let n = ws.shadows.count;
    if n == 0 {
        return;
    }
    ws.statistics.shadow_rays += n as u64;
    ws.blocked.clear();
    ws.blocked.resize(n + gonio_simd::PADDING, 1);
    ws.passed.clear();
    catcher::set_shadow_masks(tables, &mut ws.shadows);
    let rays = rays_of(&ws.shadows);
    let blocked = &mut ws.blocked[..n];
    let packets = coherent && tables.bvh.has_shadow_packets(transport.execution);
    if tables.any_transparent {
        tables.bvh.any_hit_transparent(transport.execution, &rays, blocked, &mut ws.passed);
    } else if packets && ShadowOrder::pays(&tables.lights) {
        ws.shadow_order.occluded(&tables.bvh, &tables.lights, transport.execution, &ws.shadows, blocked);
    } else {
        tables.bvh.occluded(transport.execution, &rays, packets, blocked);
    }
    if !ws.passed.is_empty() {
        dim_by_surfaces(tables, transport, ws);
    }
    dispatch!(transport.execution, l => add_arrived(l, transport, ws));
    note_arrivals(ws);
    ws.shadows.count = 0;
}

fn rays_of(shadows: &ShadowRays) -> RayBatch<'_> {
    let n = shadows.count;
    RayBatch {
        origin: [&shadows.origin[0][..n], &shadows.origin[1][..n], &shadows.origin[2][..n]],
        direction: [&shadows.direction[0][..n], &shadows.direction[1][..n], &shadows.direction[2][..n]],
        t_min: &shadows.t_min[..n],
        t_max: &shadows.t_max[..n],
        mask: &shadows.mask[..n],
    }
}

#[inline(always)]
fn add_arrived<L: Lanes>(l: L, transport: &Transport, ws: &mut Workspace) {
    for at in (0..ws.shadows.count).step_by(L::COUNT) {
        let mut bits = 0;
        for lane in 0..L::COUNT {
            bits |= u64::from(ws.blocked[at + lane] == 0) << lane;
        }
        let arrived = gonio_simd::M(l.mask_from_bits(bits)) & l.first(ws.shadows.count - at);
        let rays = &ws.shadows;
        let value = load3(l, &rays.contribution, at).into();
        let (slot, code) = (l.load_integers(&rays.slot, at), l.load_integers(&rays.code, at));
        let [diffuse, glossy] = &rays.shares;
        let shares = if ws.sums.lights.wanted() { Some([load3(l, diffuse, at).into(), load3(l, glossy, at).into()]) } else { None };
        add_sampled(&mut ws.sums, code, slot, value, shares, arrived);
        if transport.passes.groups.wanted() {
            let light = l.load_integers(&ws.shadows.light, at);
            add_of_lights(l, &transport.passes.groups, light, slot, value, arrived, &mut ws.sums.groups);
        }
    }
}

/// Multiplies contributions by the transmittance of the surfaces their rays passed, material by material.
fn dim_by_surfaces(tables: &Tables, transport: &Transport, ws: &mut Workspace) {
    let mut passed = std::mem::take(&mut ws.passed);
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
            dispatch!(transport.execution, l => dim_chunk(l, tables, material, chunk, ws));
        }
    }
    ws.passed = passed;
}

#[inline(always)]
fn dim_chunk<L: Lanes>(l: L, tables: &Tables, material: u32, hits: &[TransparentHit], ws: &mut Workspace) {
    let mut order = [0; CHUNK];
    for (i, place) in order[..hits.len()].iter_mut().enumerate() {
        *place = i as u32;
    }
    let mut factors = [[0.0; CHUNK]; 3];
    match tables.materials.shading(material) {
        Shading::Surface(surface) => add_transmittance(l, tables, surface as usize, hits, &order, None, &mut factors, ws),
        Shading::Mix(mix) => {
            let mix = &tables.materials.mixes[mix as usize];
            let source = ChunkSource { order: &order, count: hits.len(), rays: ChunkRays::Directions(&ws.shadows.direction) };
            kernels::run_program(l, tables, &mix.program, hits, &source, &mut ws.surface, &mut ws.scratch, &mut ws.outputs);
            let mut weights = std::mem::take(&mut ws.weights);
            weights.clear();
            (0..mix.count * 3).for_each(|column| weights.extend_from_slice(ws.outputs.column(column)));
            for closure in 0..mix.count {
                let own = [0, 1, 2].map(|c| &weights[(closure * 3 + c) * CHUNK..(closure * 3 + c + 1) * CHUNK]);
                add_transmittance(l, tables, mix.first as usize + closure, hits, &order, Some(own), &mut factors, ws);
            }
            ws.weights = weights;
        }
    }
    for (i, hit) in hits.iter().enumerate() {
        for (channel, factor) in ws.shadows.contribution.iter_mut().zip(&factors) {
            channel[hit.ray as usize] *= factor[i];
        }
    }
}

/// Adds what a closure lets pass straight, times its weights if it is one of several.
#[expect(clippy::too_many_arguments, reason = "hits, weights and sums")]
#[inline(always)]
fn add_transmittance<L: Lanes>(
    l: L,
    tables: &Tables,
    surface: usize,
    hits: &[TransparentHit],
    order: &[u32],
    weights: Option<[&[f32]; 3]>,
    sums: &mut [[f32; CHUNK]; 3],
    ws: &mut Workspace,
) {
    let material = &tables.materials.surfaces[surface];
    if !material.transparent {
        return;
    }
    let source = ChunkSource { order, count: hits.len(), rays: ChunkRays::Directions(&ws.shadows.direction) };
    kernels::run_program(l, tables, &material.program, hits, &source, &mut ws.surface, &mut ws.scratch, &mut ws.outputs);
    let values = parameter_values(material, &ws.outputs);
    for at in (0..hits.len()).step_by(L::COUNT) {
        let frame = Frame::from_normal(load3(l, &ws.surface.shading_normal, at));
        let wo = frame.to_local(load3(l, &ws.surface.wo, at));
        let entering = l.load(&ws.surface.side, at).gt(0.0);
        let mut factor = if material.opacity_threshold > 0.0 {
            Rgb::grey(1.0 - threshold(values.get(l, OPACITY, at), material.opacity_threshold))
        } else {
            kernels::transmittance(l, &material.surface, &values, at, wo, entering)
        };
        if let Some([r, g, b]) = weights {
            factor = factor * Rgb::new(l.load(r, at), l.load(g, at), l.load(b, at)).max(0.0);
        }
        let [r, g, b] = sums;
        (l.load(r, at) + factor.r).store(r, at);
        (l.load(g, at) + factor.g).store(g, at);
        (l.load(b, at) + factor.b).store(b, at);
    }
}
