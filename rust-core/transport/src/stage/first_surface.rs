//! First-surface AOVs: depth, normal, albedo, mist and indices where camera rays land; and holdouts, which hide them.

use crate::accumulate::shader_passes;
use crate::accumulate::surface_aovs::{FirstSurface, SurfaceLook};
use crate::stage::catcher;
use crate::state::columns::append3;
use crate::state::flag;
use crate::state::measure_points::MeasurePoints;
use crate::state::vertex::{Stage, Vertex};
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::material::SurfaceMaterial;
use crate::tables::transport::Mist;
use gonio_bsdf::Lobes;
use gonio_camera::sampler::pixel;
use gonio_simd::{F, Lanes, M, U, Vec3};

/// Leaves out what the camera sees of holdouts: paths end there without light or coverage.
#[inline(always)]
pub(crate) fn covered<L: Lanes>(
    stage: &Stage<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
    present: M<L>,
    at: usize,
    ws: &Workspace,
) -> M<L> {
    let Stage { l, tables, .. } = *stage;
    let camera = (point.flags & flag::CAMERA).ne(0);
    let hole = if material.holdout {
        l.m(true)
    } else {
        let set = tables.geometry.set_lanes(l, l.load_integers(&ws.surface.instance, at));
        l.gather_integers(&tables.geometry.set_holdout, set).ne(0)
    };
    present.and_not(hole & camera)
}

/// Records the AOVs of first surfaces.
#[inline(always)]
pub(crate) fn record_first<L: Lanes>(
    stage: &Stage<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    at: usize,
    ws: &mut Workspace,
) {
    let Stage { l, tables, transport, .. } = *stage;
    let seen = present & (point.flags & flag::CAMERA).ne(0) & catcher::shown(point.slot);
    if !seen.any() {
        return;
    }
    let eye = Vec3::splat(l, transport.eye);
    let surface = FirstSurface {
        slot: pixel(point.slot),
        share: point.share,
        covers: catcher::covers(point.slot),
        look: if transport.passes.surface { Some(look(stage, point, lobes, eye)) } else { None },
        numbers: if transport.passes.numbers { Some(numbers(stage, material, at, ws)) } else { None },
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        clearness: match &transport.passes.mist {
            Some(mist) => Some(clearness(mist, point.position - eye)),
            None => None,
        },
        uv: if transport.passes.uv { Some(texture_coordinates(l, tables, material, at, ws)) } else { None },
        kinds: if ws.sums.lights.wanted() { Some(lobes.albedo_kinds()) } else { None },
    };
    ws.sums.record(l, &surface, seen);
    if let Some(program) = stage.shader {
        shader_passes::record(l, program, point, seen, at, ws);
    }
}

/// Where the surface is, and what it is like.
#[inline(always)]
fn look<L: Lanes>(stage: &Stage<'_, L>, point: &Vertex<L>, lobes: &Lobes<'_, L>, eye: Vec3<L>) -> SurfaceLook<L> {
    SurfaceLook {
        depth: (point.position - eye).dot(Vec3::splat(stage.l, stage.transport.forward)),
        normal: point.frame.z,
        position: point.position,
        albedo: lobes.albedo(),
    }
}

/// The instance set, and the pass indices of the instance and of the material.
#[inline(always)]
fn numbers<L: Lanes>(stage: &Stage<'_, L>, material: &SurfaceMaterial, at: usize, ws: &Workspace) -> [U<L>; 3] {
    let Stage { l, tables, .. } = *stage;
    let set = tables.geometry.set_lanes(l, l.load_integers(&ws.surface.instance, at));
    [set, l.gather_integers(&tables.geometry.set_pass_index, set), l.u(material.pass_index)]
}

/// What the mist leaves of a point this far from the camera.
#[inline(always)]
fn clearness<L: Lanes>(mist: &Mist, from_eye: Vec3<L>) -> F<L> {
    let Mist { start, depth, falloff } = *mist;
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
pub(crate) fn append_measure<L: Lanes>(point: &Vertex<L>, chosen: M<L>, out: &mut MeasurePoints) {
    if !chosen.any() {
        return;
    }
    let n = out.count;
    append3(point.position, chosen, &mut out.position, n);
    point.error.append(chosen, &mut out.error, n);
    append3(point.geometric, chosen, &mut out.geometric_normal, n);
    append3(point.frame.z, chosen, &mut out.shading_normal, n);
    append3(point.throughput.into(), chosen, &mut out.throughput, n);
    point.width.append(chosen, &mut out.width, n);
    point.slot.append(chosen, &mut out.slot, n);
    out.count += chosen.count();
}
