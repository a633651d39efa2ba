//! What is kept of the first surface that a camera ray meets, and holdouts, which hide it.

use super::{
    accumulate::FirstSurface,
    material::{SurfaceMaterial, Tables},
    path::{Mist, Transport},
    shade::{Point, Stage},
    state::{MeasurePoints, Workspace, append3, flag},
};
use crate::bsdf::Lobes;
use gonio_simd::{F, Lanes, M, Vec3};

/// Leaves out what the camera sees of holdouts: paths end there without light or coverage.
#[inline(always)]
pub(super) fn covered<L: Lanes>(stage: &Stage<'_, L>, point: &Point<L>, present: M<L>, at: usize, ws: &Workspace) -> M<L> {
    let Stage { l, tables, material, .. } = *stage;
    let camera = (point.flags & flag::CAMERA).ne(0);
    let hole = if material.holdout {
        l.m(true)
    } else {
        let set = l.gather_integers(&tables.geometry.instance_set, l.load_integers(&ws.surface.instance, at));
        l.gather_integers(&tables.geometry.set_holdout, set).ne(0)
    };
    present.and_not(hole & camera)
}

/// Keeps what camera rays met first.
#[inline(always)]
pub(super) fn record_first<L: Lanes>(
    stage: &Stage<'_, L>,
    point: &Point<L>,
    lobes: &Lobes<L>,
    present: M<L>,
    at: usize,
    ws: &mut Workspace,
) {
    let Stage { l, tables, transport, material, .. } = *stage;
    let seen = present & (point.flags & flag::CAMERA).ne(0);
    if !seen.any() {
        return;
    }
    let eye = Vec3::splat(l, transport.eye);
    let set = l.gather_integers(&tables.geometry.instance_set, l.load_integers(&ws.surface.instance, at));
    let surface = FirstSurface {
        slot: point.slot,
        depth: (point.position - eye).dot(Vec3::splat(l, transport.forward)),
        normal: point.frame.z,
        position: point.position,
        albedo: lobes.albedo(),
        prim_id: set,
        object_index: l.gather_integers(&tables.geometry.set_pass_index, set),
        material_index: l.u(material.pass_index),
        clearness: clearness(transport, point.position - eye),
        uv: if transport.passes.uv { Some(texture_coordinates(l, tables, material, at, ws)) } else { None },
        kinds: lobes.albedo_kinds(),
    };
    ws.first_hit.record(l, &surface, seen);
}

/// What the mist leaves of a point this far from the camera.
#[inline(always)]
fn clearness<L: Lanes>(transport: &Transport, from_eye: Vec3<L>) -> F<L> {
    let Mist { start, depth, falloff } = transport.passes.mist;
    let inside = ((from_eye.length() - start) * (1.0 / depth.max(1e-6))).saturate();
    1.0 - inside.max(1e-9).pow(inside.lanes().f(falloff))
}

/// The texture coordinates that the material's images follow.
#[inline(always)]
fn texture_coordinates<L: Lanes>(l: L, tables: &Tables, material: &SurfaceMaterial, at: usize, ws: &Workspace) -> [F<L>; 2] {
    let Some(column) = material.program.uv else { return [l.f(0.0); 2] };
    let barycentric = [l.load(&ws.surface.barycentric[0], at), l.load(&ws.surface.barycentric[1], at)];
    let (instance, primitive) = (l.load_integers(&ws.surface.instance, at), l.load_integers(&ws.surface.primitive, at));
    let hit = tables.geometry.hit_lanes(l, instance, primitive, barycentric[0], barycentric[1]);
    let ([u, v, ..], _) = tables.geometry.primvar(l, &hit, column);
    [u, v]
}

#[inline(always)]
pub(super) fn append_measure<L: Lanes>(point: &Point<L>, chosen: M<L>, out: &mut MeasurePoints) {
    if !chosen.any() {
        return;
    }
    let n = out.count;
    append3(point.position, chosen, &mut out.position, n);
    point.error.append(chosen, &mut out.error, n);
    append3(point.geometric, chosen, &mut out.geometric_normal, n);
    append3(point.frame.z, chosen, &mut out.shading_normal, n);
    let weight = point.throughput;
    append3(Vec3::new(weight.r, weight.g, weight.b), chosen, &mut out.throughput, n);
    point.width.append(chosen, &mut out.width, n);
    point.slot.append(chosen, &mut out.slot, n);
    out.count += chosen.count();
}
