//! Emission for light sampling of meshes that glow by an image or a pattern: samples carry the mean, here they get what the point emits.

use crate::graph::CHUNK;
use crate::kernels;
use crate::stage::find::sort::for_materials;
use crate::stage::find::surface::{ChunkRays, ChunkSource};
use crate::state::chunk::ChunkColumns;
use crate::state::columns::load3;
use crate::state::glow::{GlowRoom, GlowScratch};
use crate::state::light_paths::LightStarts;
use crate::state::paths::Paths;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::state::rays::Rays;
use crate::tables::Tables;
use crate::tables::material::{Shading, threshold, values_by};
use crate::tables::transport::Transport;
use gonio_accel::TransparentHit;
use gonio_bsdf::parameter::{OPACITY, spectrum};
use gonio_simd::{Execution, Frame, Lanes, One, PADDING, Rgb, Spectrum, SpectrumColumns, dispatch};

/// Gives the shadow rays that arrive at such meshes what the points emit, within their limits.
pub(crate) fn shine(tables: &Tables, transport: &Transport, trace: &mut ShadowTrace, shadows: &mut ShadowRays, columns: &mut ChunkColumns) {
    if !tables.lights.any_shaded() {
        return;
    }
    let ShadowTrace { blocked, glow, .. } = trace;
    glow.begin(shadows.count);
    dispatch!(transport.execution, l => find_ends(l, tables, &shadows.rays, &shadows.light, blocked, glow));
    let mut ends = std::mem::take(&mut glow.ends);
    for_materials(tables, &mut ends, |material, chunk| {
        dispatch!(transport.execution, l => emitted_chunk(l, tables, material, chunk, &shadows.rays, glow, columns));
        for (i, end) in chunk.iter().enumerate() {
            shadows.contribution.multiply(end.ray as usize, &glow.emitted, i);
        }
    });
    if transport.limits.clamps_any() {
        ends.iter().for_each(|end| shadows.clamp(end.ray as usize));
    }
    glow.ends = ends;
}

/// Lists where rays that nothing blocks end on triangles that programs know, and the reciprocals of their means.
#[inline(always)]
fn find_ends<L: Lanes>(l: L, tables: &Tables, rays: &Rays, lights: &[u32], blocked: &[u8], glow: &mut GlowScratch) {
    let (first, instances) = (tables.light_instances.0, &tables.light_instances.1);
    let count = blocked.len();
    for at in (0..count).step_by(L::COUNT) {
        let light = l.load_integers(lights, at);
        let light = l.first(count - at).select(light, l.u(lights[at]));
        let shaded = tables.lights.is_shaded(l, light);
        if !shaded.any() {
            continue;
        }
        let point = tables.lights.triangle_point(l, light, load3(l, &rays.origin, at), load3(l, &rays.direction, at));
        let (mut parts, mut numbers) = ([[0.0; PADDING]; 4], [0; PADDING]);
        let [u, v] = point.barycentric;
        [u, v, point.distance, point.mean].into_iter().zip(&mut parts).for_each(|(value, part)| value.store(part, 0));
        light.store(&mut numbers, 0);
        let bits = shaded.bits();
        for lane in (0..L::COUNT.min(count - at)).filter(|lane| bits >> lane & 1 != 0 && blocked[at + lane] == 0) {
            let instance = instances[(numbers[lane] - first) as usize];
            let primitive = numbers[lane] - tables.triangle_lights[instance as usize];
            let [u, v, t] = [parts[0][lane], parts[1][lane], parts[2][lane]];
            glow.ends.push(TransparentHit { ray: (at + lane) as u32, instance, primitive, u, v, t });
            glow.inverse_mean[at + lane] = 1.0 / parts[3][lane];
        }
    }
}

/// Fills `glow.emitted` with what a chunk of points of one material emits against the rays that meet them, over the means.
#[inline(always)]
fn emitted_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    material: u32,
    points: &[TransparentHit],
    rays: &Rays,
    glow: &mut GlowScratch,
    columns: &mut ChunkColumns,
) {
    let GlowScratch { weights, emitted, inverse_mean, .. } = glow;
    let mut order = [0; CHUNK];
    order.iter_mut().zip(0..points.len() as u32).for_each(|(place, number)| *place = number);
    let source = ChunkSource { order: &order, count: points.len(), rays: ChunkRays::Rays(rays) };
    emitted.clear();
    match tables.materials.shading(material) {
        Shading::Surface(surface) => add_emitted(l, tables, surface as usize, (points, &source), None, emitted, columns),
        Shading::Mix(mix) => {
            let mix = &tables.materials.mixes[mix as usize];
            let program = mix.glow.as_deref().unwrap_or(&mix.program);
            kernels::run_program(l, tables, program, points, &source, columns);
            weights.clear();
            (0..mix.count * 3).for_each(|column| weights.extend_from_slice(columns.outputs.column(column)));
            for closure in 0..mix.count {
                let own = [0, 1, 2].map(|c| &weights[(closure * 3 + c) * CHUNK..(closure * 3 + c + 1) * CHUNK]);
                add_emitted(l, tables, mix.first as usize + closure, (points, &source), Some(own), emitted, columns);
            }
        }
    }
    for (i, point) in points.iter().enumerate() {
        emitted.scale(i, inverse_mean[point.ray as usize]);
    }
}

/// Adds what a closure emits, times its weights if it is one of several.
#[inline(always)]
fn add_emitted<L: Lanes>(
    l: L,
    tables: &Tables,
    surface: usize,
    (points, source): (&[TransparentHit], &ChunkSource<'_>),
    weights: Option<[&[f32]; 3]>,
    sums: &mut SpectrumColumns,
    columns: &mut ChunkColumns,
) {
    let material = &tables.materials.surfaces[surface];
    if !material.emissive {
        return;
    }
    let Some(program) = &material.glow else {
        let [r, g, b] = material.even_emission.unwrap_or_default().map(|x| l.f(x));
        let even = spectrum(Rgb::new(r, g, b));
        (0..points.len()).step_by(L::COUNT).for_each(|at| sums.store(sums.load(l, at) + weighted(even, weights, at), at));
        return;
    };
    kernels::run_program(l, tables, program, points, source, columns);
    let ChunkColumns { surface, outputs, .. } = columns;
    let values = values_by(&material.surface, program, outputs);
    for at in (0..points.len()).step_by(L::COUNT) {
        let frame = Frame::from_normal(load3(l, &surface.shading_normal, at));
        let wo = frame.to_local(load3(l, &surface.wo, at));
        let mut emission = kernels::emitted(l, &material.surface, &values, at, wo, l.load(&surface.side, at).gt(0.0));
        if material.surface.lobes.cut_out {
            emission = emission * threshold(values.get(l, OPACITY, at).saturate(), material.opacity_threshold);
        }
        sums.store(sums.load(l, at) + weighted(emission, weights, at), at);
    }
}

/// Times the weights at some points, where there are any.
#[inline(always)]
fn weighted<L: Lanes>(emission: Spectrum<L>, weights: Option<[&[f32]; 3]>, at: usize) -> Spectrum<L> {
    match weights {
        Some([r, g, b]) => emission * spectrum(Rgb::load(emission.lanes(), [r, g, b], at)).max(0.0),
        None => emission,
    }
}

/// A point of a mesh, and the unit direction from which it is seen.
#[derive(Clone, Copy, Debug)]
pub struct GlowPoint {
    /// The instance's number.
    pub instance: u32,
    /// The triangle's number in its mesh.
    pub primitive: u32,
    /// Barycentric coordinates of corners 1 and 2.
    pub barycentric: [f32; 2],
    /// Rebased world space.
    pub toward: [f32; 3],
}

/// Gives light paths that start at such meshes what the points emit.
pub(crate) fn shine_starts(tables: &Tables, execution: Execution, paths: &Paths, starts: &mut LightStarts, room: &mut GlowRoom) {
    let (l, first) = (One, tables.light_instances.0);
    let (mut points, mut slots) = (Vec::new(), Vec::new());
    for path in 0..paths.count {
        let slot = paths.slot(path) as usize;
        let light = l.u(starts.light[slot]);
        if !tables.lights.is_shaded(l, light).any() {
            continue;
        }
        let (origin, direction) = (load3(l, &paths.rays.origin, path), load3(l, &paths.rays.direction, path));
        let point = tables.lights.triangle_point(l, light, origin, direction);
        let instance = tables.light_instances.1[(starts.light[slot] - first) as usize];
        points.push(GlowPoint {
            instance,
            primitive: starts.light[slot] - tables.triangle_lights[instance as usize],
            barycentric: point.barycentric.map(|x| x.to_array()[0]),
            toward: [direction.x, direction.y, direction.z].map(|x| x.to_array()[0]),
        });
        slots.push((slot, 1.0 / point.mean.to_array()[0]));
    }
    let mut values = vec![[0.0; 3]; points.len()];
    emitted(tables, execution, &points, room, &mut values);
    for ((slot, inverse_mean), value) in slots.into_iter().zip(values) {
        starts.flux.tint(slot, value.map(|x| x * inverse_mean));
    }
}

/// What points emit as light sampling sees it, R, G, B; `values` has a place for each point.
pub fn emitted(tables: &Tables, execution: Execution, points: &[GlowPoint], room: &mut GlowRoom, values: &mut [[f32; 3]]) {
    let GlowRoom { rays, glow, columns } = room;
    for (points, values) in points.chunks(CHUNK).zip(values.chunks_mut(CHUNK)) {
        glow.begin(points.len());
        glow.inverse_mean.fill(1.0);
        for (number, point) in points.iter().enumerate() {
            (0..3).for_each(|axis| rays.direction[axis][number] = -point.toward[axis]);
            let GlowPoint { instance, primitive, barycentric: [u, v], .. } = *point;
            glow.ends.push(TransparentHit { ray: number as u32, instance, primitive, u, v, t: 1.0 });
        }
        let mut ends = std::mem::take(&mut glow.ends);
        for_materials(tables, &mut ends, |material, chunk| {
            dispatch!(execution, l => emitted_chunk(l, tables, material, chunk, rays, glow, columns));
            for (i, end) in chunk.iter().enumerate() {
                let channels = glow.emitted.columns().iter().map(|column| column[i]);
                values[end.ray as usize].iter_mut().zip(channels).for_each(|(value, channel)| *value = channel);
            }
        });
        glow.ends = ends;
    }
}
