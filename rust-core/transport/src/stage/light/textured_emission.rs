//! Emission for light sampling of meshes that glow by an image or a pattern: samples carry the mean, here they get what the point emits.

use crate::graph::CHUNK;
use crate::kernels;
use crate::stage::find::closures::{ClosureHits, MaterialHits, each_closure};
use crate::stage::find::sort::for_materials;
use crate::state::chunk::ChunkColumns;
use crate::state::columns::load3;
use crate::state::light_paths::LightStarts;
use crate::state::mix_weights::ClosureWeights;
use crate::state::paths::Paths;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::state::rays::Rays;
use crate::state::textured_emission::{EmissionRoom, EmissionScratch};
use crate::state::wavelengths::SlotWavelengths;
use crate::tables::Tables;
use crate::tables::material::{threshold, values_by};
use crate::tables::transport::Transport;
use gonio_accel::TransparentHit;
use gonio_bsdf::parameter::OPACITY;
use gonio_simd::{Execution, Frame, Lanes, One, PADDING, Spectrum, SpectrumColumns, dispatch};

/// Gives the shadow rays that arrive at such meshes what the points emit.
pub(crate) fn multiply(
    tables: &Tables,
    transport: &Transport,
    trace: &mut ShadowTrace,
    shadows: &mut ShadowRays,
    columns: &mut ChunkColumns,
) {
    if !tables.lights.any_shaded() {
        return;
    }
    let ShadowTrace { blocked, emission, wavelengths, .. } = trace;
    emission.begin(shadows.count);
    dispatch!(transport.execution, l => find_ends(l, tables, &shadows.rays, &shadows.light, blocked, emission));
    let mut ends = std::mem::take(&mut emission.ends);
    for_materials(tables, &mut ends, |material, chunk| {
        let wavelengths = wavelengths.as_deref().map(|wavelengths| (wavelengths, &*shadows.slot));
        let points = MaterialHits { material, hits: chunk, rays: &shadows.rays, wavelengths };
        dispatch!(transport.execution, l => emitted_chunk(l, tables, points, emission, columns));
        for (i, end) in chunk.iter().enumerate() {
            shadows.contribution.multiply(end.ray as usize, &emission.emitted, i);
        }
    });
    emission.ends = ends;
}

/// Lists where rays that nothing blocks end on triangles that programs know, and the reciprocals of their means.
#[inline(always)]
fn find_ends<L: Lanes>(l: L, tables: &Tables, rays: &Rays, lights: &[u32], blocked: &[u8], scratch: &mut EmissionScratch) {
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
            scratch.ends.push(TransparentHit { ray: (at + lane) as u32, instance, primitive, u, v, t });
            scratch.inverse_mean[at + lane] = 1.0 / parts[3][lane];
        }
    }
}

/// Fills `scratch.emitted` with what a chunk of points of one material emits against the rays that meet them, over the means.
#[inline(always)]
fn emitted_chunk<L: Lanes>(l: L, tables: &Tables, chunk: MaterialHits<'_>, scratch: &mut EmissionScratch, columns: &mut ChunkColumns) {
    let EmissionScratch { weights, emitted, inverse_mean, .. } = scratch;
    emitted.clear();
    each_closure(
        l,
        tables,
        chunk,
        |mix| mix.textured_emission.as_deref().unwrap_or(&mix.program),
        (weights, columns),
        #[inline(always)]
        |closure| add_emitted(l, tables, closure, emitted),
    );
    for (i, point) in chunk.hits.iter().enumerate() {
        emitted.scale(i, inverse_mean[point.ray as usize]);
    }
}

/// Adds what a closure emits, times its weights if it is one of several.
#[inline(always)]
fn add_emitted<L: Lanes>(l: L, tables: &Tables, mut closure: ClosureHits<'_>, sums: &mut SpectrumColumns) {
    let material = &tables.materials.surfaces[closure.surface];
    if !material.emissive {
        return;
    }
    let count = closure.hits.len();
    let Some(program) = &material.textured_emission else {
        for at in (0..count).step_by(L::COUNT) {
            let even = material.even_radiance(l, closure.columns.wavelengths.column().load(l, at));
            sums.store(sums.load(l, at) + weighted(even, closure.weights, at), at);
        }
        return;
    };
    closure.run(l, tables, program);
    let ClosureHits { weights, columns, .. } = closure;
    let (surface, values) = (&columns.surface, values_by(&material.surface, program, columns.outputs()));
    for at in (0..count).step_by(L::COUNT) {
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
fn weighted<L: Lanes>(emission: Spectrum<L>, weights: Option<ClosureWeights<'_>>, at: usize) -> Spectrum<L> {
    match weights {
        Some(weights) => emission * weights.load(emission.lanes(), at),
        None => emission,
    }
}

/// A point of a mesh, and the unit direction from which it is seen.
#[derive(Clone, Copy, Debug)]
pub struct EmissionPoint {
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
pub(crate) fn emit_from_starts(
    tables: &Tables,
    execution: Execution,
    paths: &Paths,
    starts: &mut LightStarts,
    room: &mut EmissionRoom,
    wavelengths: Option<&SlotWavelengths>,
) {
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
        points.push(EmissionPoint {
            instance,
            primitive: starts.light[slot] - tables.triangle_lights[instance as usize],
            barycentric: point.barycentric.map(|x| x.to_array()[0]),
            toward: [direction.x, direction.y, direction.z].map(|x| x.to_array()[0]),
        });
        slots.push((slot, 1.0 / point.mean.to_array()[0]));
    }
    let of_points: Vec<u32> = slots.iter().map(|(slot, _)| *slot as u32).collect();
    let mut values = SpectrumColumns::new(points.len());
    let wavelengths = wavelengths.map(|wavelengths| (wavelengths, &*of_points));
    find_emitted(tables, execution, &points, room, &mut values, wavelengths);
    for (number, (slot, inverse_mean)) in slots.into_iter().enumerate() {
        values.scale(number, inverse_mean);
        starts.flux.multiply(slot, &values, number);
    }
}

/// What points emit as light sampling sees it, R, G, B; `values` has a place for each point.
pub fn emitted(tables: &Tables, execution: Execution, points: &[EmissionPoint], room: &mut EmissionRoom, values: &mut [[f32; 3]]) {
    let mut emitted = SpectrumColumns::new(points.len());
    find_emitted(tables, execution, points, room, &mut emitted, None);
    values.iter_mut().enumerate().for_each(|(number, value)| *value = emitted.load(One, number).to_rgb().into());
}

/// The same as light.
fn find_emitted(
    tables: &Tables,
    execution: Execution,
    points: &[EmissionPoint],
    room: &mut EmissionRoom,
    values: &mut SpectrumColumns,
    wavelengths: Option<(&SlotWavelengths, &[u32])>,
) {
    let EmissionRoom { rays, scratch, columns } = room;
    values.clear();
    for (first, points) in points.chunks(CHUNK).enumerate() {
        scratch.begin(points.len());
        scratch.inverse_mean.fill(1.0);
        for (number, point) in points.iter().enumerate() {
            (0..3).for_each(|axis| rays.direction[axis][number] = -point.toward[axis]);
            let EmissionPoint { instance, primitive, barycentric: [u, v], .. } = *point;
            scratch.ends.push(TransparentHit { ray: number as u32, instance, primitive, u, v, t: 1.0 });
        }
        let mut ends = std::mem::take(&mut scratch.ends);
        for_materials(tables, &mut ends, |material, chunk| {
            let wavelengths = wavelengths.map(|(of_slots, slots)| (of_slots, &slots[first * CHUNK..]));
            let points = MaterialHits { material, hits: chunk, rays, wavelengths };
            dispatch!(execution, l => emitted_chunk(l, tables, points, scratch, columns));
            for (i, end) in chunk.iter().enumerate() {
                values.add(first * CHUNK + end.ray as usize, &scratch.emitted, i, 1.0);
            }
        });
        scratch.ends = ends;
    }
}
