//! First-surface AOVs: depth, normal, albedo, mist and indices where camera rays land; and holdouts, which hide them.

use crate::accumulate::add::add;
use crate::accumulate::deposit::Deposits;
use crate::accumulate::shader_passes::add_shader_passes;
use crate::accumulate::surface_aovs::{FirstSurface, SurfaceLook};
use crate::stage::shade::catcher;
use crate::state::chunk::ChunkContext;
use crate::state::vertex::Vertex;
use crate::tables::material::SurfaceMaterial;
use crate::tables::motion_vectors::Moved;
use crate::tables::transport::Mist;
use crate::words::flag;
use gonio_bsdf::Lobes;
use gonio_camera::sampler::pixel;
use gonio_simd::{F, Lanes, M, PADDING, U, Vec3};

/// Leaves out what the camera sees of holdouts, and counts it where `counted`: paths end there without light or coverage.
#[inline(always)]
pub(crate) fn without_holdouts<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
    present: M<L>,
    counted: Option<&mut Deposits>,
) -> M<L> {
    let ChunkContext { l, tables, .. } = *chunk;
    let camera = (point.core.flags & flag::CAMERA).ne(0);
    let hole = if material.holdout {
        l.m(true)
    } else if material.surface.lobes.straight {
        // What lets all of the light pass covers nothing that could be cut out, as around fog.
        l.m(false)
    } else {
        let set = tables.geometry.set_lanes(l, point.instance);
        l.gather_integers(&tables.geometry.set_holdout, set).ne(0)
    };
    let hole = hole & camera;
    if let Some(deposits) = counted
        && !deposits.sums.holes.is_empty()
        && (present & hole).any()
    {
        add(&mut deposits.sums.holes, pixel(point.core.slot), point.share, present & hole & catcher::shown(point.core.slot));
    }
    present.and_not(hole)
}

/// Records the AOVs of first surfaces.
#[inline(always)]
pub(crate) fn add_first_surface<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    at: usize,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, transport, .. } = *chunk;
    let seen = present & (point.core.flags & flag::CAMERA).ne(0) & catcher::shown(point.core.slot);
    if !seen.any() {
        return;
    }
    let eye = Vec3::splat(l, transport.eye);
    let surface = FirstSurface {
        slot: pixel(point.core.slot),
        share: point.share,
        covers: catcher::covers(point.core.slot),
        look: if transport.passes.surface { Some(look(chunk, point, lobes, eye)) } else { None },
        numbers: if transport.passes.numbers { Some(numbers(chunk, material, point, at)) } else { None },
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        clearness: match &transport.passes.mist {
            Some(mist) => Some(clearness(mist, point.at.position - eye)),
            None => None,
        },
        uv: if transport.passes.uv { Some(texture_coordinates(chunk, material, point, at)) } else { None },
        motion: motion_vectors(chunk, point, seen, at),
        kinds: if deposits.sums.lights.wanted() { Some(chunk.sample.all_to_film(point.core.slot, lobes.albedo_kinds())) } else { None },
    };
    deposits.sums.add_first_surface(l, &surface, seen);
    if transport.passes.mattes {
        let of = (&chunk.tables.matte_names, &chunk.tables.geometry);
        deposits.sums.mattes.add(of, material.matte_id, (surface.slot, point.instance), point.share, seen);
    }
    if let Some(distance) = transport.passes.deep {
        let depth = transport.deep_depth(distance, point.at.position);
        deposits.sums.deep.add(surface.slot, depth, point.share, seen, false);
    }
    if let Some(program) = chunk.shader {
        add_shader_passes(program, &chunk.columns.shader_outputs, point, seen, at, &mut deposits.sums);
    }
}

/// Where the surface is, and what it is like.
#[inline(always)]
fn look<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, lobes: &Lobes<'_, L>, eye: Vec3<L>) -> SurfaceLook<L> {
    SurfaceLook {
        depth: (point.at.position - eye).dot(Vec3::splat(chunk.l, chunk.transport.forward)),
        normal: point.at.frame.z,
        position: point.at.position,
        albedo: chunk.sample.to_film(point.core.slot, lobes.albedo()),
    }
}

/// Motion vectors of the chosen lanes, where a pass shows them.
#[inline(always)]
fn motion_vectors<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, chosen: M<L>, at: usize) -> Option<[F<L>; 4]> {
    let ChunkContext { l, tables, transport, columns, .. } = *chunk;
    let (Some(cameras), Some(frames)) = (&transport.passes.motion, &tables.neighbours) else { return None };
    let barycentric = &columns.surface.barycentric;
    let primitive = l.load_integers(&columns.surface.primitive, at);
    let hit = tables.geometry.hit_lanes(l, point.instance, primitive, l.load(&barycentric[0], at), l.load(&barycentric[1], at));
    let (instances, geometries) = (hit.instance.to_array(), hit.mesh.to_array());
    let [a, b, c] = hit.points;
    let points = [(a - hit.first_point).to_array(), (b - hit.first_point).to_array(), (c - hit.first_point).to_array()];
    let weights = [(l.f(1.0) - hit.u - hit.v).to_array(), hit.u.to_array(), hit.v.to_array()];
    let Vec3 { x, y, z } = point.at.position;
    let position = [x.to_array(), y.to_array(), z.to_array()];
    let mut vectors = [[0.0; PADDING]; 4];
    let mut bits = chosen.bits();
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize;
        let hit = Moved {
            instance: instances[lane],
            geometry: geometries[lane],
            points: [points[0][lane], points[1][lane], points[2][lane]],
            weights: [weights[0][lane], weights[1][lane], weights[2][lane]],
            position: [position[0][lane], position[1][lane], position[2][lane]],
        };
        for (column, value) in vectors.iter_mut().zip(frames.vectors(cameras, &hit)) {
            column[lane] = value;
        }
        bits &= bits - 1;
    }
    Some([l.load(&vectors[0], 0), l.load(&vectors[1], 0), l.load(&vectors[2], 0), l.load(&vectors[3], 0)])
}

/// The instance set, the pass indices of the instance and of the material, the instance's number in its set, and the triangle.
#[inline(always)]
fn numbers<L: Lanes>(chunk: &ChunkContext<'_, L>, material: &SurfaceMaterial, point: &Vertex<L>, at: usize) -> [U<L>; 5] {
    let ChunkContext { l, tables, columns, .. } = *chunk;
    let set = tables.geometry.set_lanes(l, point.instance);
    let (number, triangle) = (tables.geometry.number_lanes(l, point.instance), l.load_integers(&columns.surface.primitive, at));
    [set, l.gather_integers(&tables.geometry.set_pass_index, set), l.u(material.pass_index), number, triangle]
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
fn texture_coordinates<L: Lanes>(chunk: &ChunkContext<'_, L>, material: &SurfaceMaterial, point: &Vertex<L>, at: usize) -> [F<L>; 2] {
    let ChunkContext { l, tables, columns, .. } = *chunk;
    let Some(column) = material.program.uv else { return [l.f(0.0); 2] };
    let barycentric = &columns.surface.barycentric;
    let primitive = l.load_integers(&columns.surface.primitive, at);
    let hit = tables.geometry.hit_lanes(l, point.instance, primitive, l.load(&barycentric[0], at), l.load(&barycentric[1], at));
    let ([u, v, ..], _) = tables.geometry.primvar(l, &hit, column);
    [u, v]
}
