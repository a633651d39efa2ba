//! Surface points of a chunk of hits: positions with error bounds, normals, tangents and ray footprints.
//!
//! In go hits and rays (with ray cones), out come [`SurfaceColumns`], gathered from the geometry tables. The shading program runs on them.

use crate::graph::{Program, SurfaceColumns};
use crate::state::columns::gather3;
use crate::state::paths::{ConeLanes, Paths, TrackLanes};
use crate::state::queue::walks::Walks;
use crate::state::rays::Rays;
use crate::tables::Tables;
use crate::words::flag;
use gonio_accel::{Hits, TransparentHit};
use gonio_simd::{Column, F, Lanes, PADDING, U, Vec3};

/// The rays of a chunk.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ChunkRays<'a> {
    /// Those of paths, with cones around them.
    Paths(&'a Paths),
    /// Rays alone.
    Rays(&'a Rays),
    /// Those of subsurface walks, turned round: points are seen from outside, where the light comes out.
    Walks(&'a Walks),
}

impl ChunkRays<'_> {
    /// Their times; empty where nothing moves.
    #[inline(always)]
    fn times(&self) -> &[f32] {
        match self {
            ChunkRays::Paths(paths) => &paths.rays.time,
            ChunkRays::Rays(rays) => &rays.time,
            ChunkRays::Walks(walks) => &walks.rays.time,
        }
    }
}

/// What a chunk of hits is looked up from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChunkSource<'a> {
    /// Ray numbers, padded to whole registers.
    pub(crate) order: &'a [u32],
    /// Rays of the chunk.
    pub(crate) count: usize,
    pub(crate) rays: ChunkRays<'a>,
}

/// A register of hits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FoundHits<L: Lanes> {
    ray: U<L>,
    instance: U<L>,
    primitive: U<L>,
    barycentric: [F<L>; 2],
    distance: F<L>,
}

/// Where hits are found: by ray in [`Hits`], or in a list.
pub(crate) trait HitSource {
    /// The hits of some entries.
    fn load<L: Lanes>(&self, l: L, entries: U<L>) -> FoundHits<L>;
}

impl HitSource for Hits {
    #[inline(always)]
    fn load<L: Lanes>(&self, l: L, entries: U<L>) -> FoundHits<L> {
        FoundHits {
            ray: entries,
            instance: l.gather_integers(&self.instance, entries),
            primitive: l.gather_integers(&self.primitive, entries),
            barycentric: [l.gather(&self.u, entries), l.gather(&self.v, entries)],
            distance: l.gather(&self.t, entries),
        }
    }
}

impl HitSource for [TransparentHit] {
    #[inline(always)]
    fn load<L: Lanes>(&self, l: L, entries: U<L>) -> FoundHits<L> {
        let (mut whole, mut parts) = ([[0; PADDING]; 3], [[0.0; PADDING]; 3]);
        for (lane, entry) in entries.to_array().into_iter().take(L::COUNT).enumerate() {
            let hit = &self[entry as usize];
            [whole[0][lane], whole[1][lane], whole[2][lane]] = [hit.ray, hit.instance, hit.primitive];
            [parts[0][lane], parts[1][lane], parts[2][lane]] = [hit.u, hit.v, hit.t];
        }
        let [ray, instance, primitive] = [l.load_integers(&whole[0], 0), l.load_integers(&whole[1], 0), l.load_integers(&whole[2], 0)];
        let [u, v, distance] = [l.load(&parts[0], 0), l.load(&parts[1], 0), l.load(&parts[2], 0)];
        FoundHits { ray, instance, primitive, barycentric: [u, v], distance }
    }
}

/// Fills the surface columns for a chunk.
#[inline(always)]
pub(crate) fn surface_chunk<L: Lanes, H: HitSource + ?Sized>(
    l: L,
    tables: &Tables,
    program: &Program,
    hits: &H,
    source: &ChunkSource<'_>,
    out: &mut SurfaceColumns,
) {
    out.origin = tables.origin.map(|x| x as f32);
    let times = source.rays.times();
    out.has_times = !times.is_empty();
    for at in (0..source.count).step_by(L::COUNT) {
        let hits = hits.load(l, l.load_integers(source.order, at));
        let mut covered = l.m(false);
        let (direction, width) = match source.rays {
            ChunkRays::Paths(paths) => {
                let ConeLanes { direction, width } = paths.cone(l, hits.ray);
                let TrackLanes { spread, flags, .. } = paths.track(l, hits.ray);
                covered = (flags & flag::COVERED).ne(0);
                (direction, hits.distance.mul_add(spread, width))
            }
            ChunkRays::Rays(rays) => (gather3(l, &rays.direction, hits.ray), l.f(0.0)),
            ChunkRays::Walks(walks) => (-gather3(l, &walks.rays.direction, hits.ray), l.gather(&walks.width, hits.ray)),
        };
        if program.light_path {
            store_ray(l, &hits, source.rays, out, at);
        }
        if out.has_times {
            l.gather(times, hits.ray).store(&mut out.time, at);
        }
        surface_lanes(l, tables, program, &hits, direction, width, out, at);
        if covered.any() {
            let error = l.load(&out.error, at);
            covered.select(-error, error).store(&mut out.error, at);
        }
    }
}

/// What a program may ask of the rays; those without paths are shadow rays.
#[inline(always)]
fn store_ray<L: Lanes>(l: L, hits: &FoundHits<L>, rays: ChunkRays<'_>, out: &mut SurfaceColumns, at: usize) {
    let (flags, counts) = match rays {
        ChunkRays::Paths(paths) => {
            let TrackLanes { flags, counts, .. } = paths.track(l, hits.ray);
            (flags & !flag::COVERED, counts)
        }
        ChunkRays::Rays(_) => (l.u(flag::SHADOW), l.u(0)),
        ChunkRays::Walks(walks) => (l.gather_integers(&walks.flags, hits.ray), l.gather_integers(&walks.counts, hits.ray)),
    };
    flags.store(&mut out.ray_flags, at);
    counts.store(&mut out.ray_counts, at);
    hits.distance.store(&mut out.ray_length, at);
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a hit, its ray and where the point goes")]
fn surface_lanes<L: Lanes>(
    l: L,
    tables: &Tables,
    program: &Program,
    found: &FoundHits<L>,
    direction: Vec3<L>,
    width: F<L>,
    out: &mut SurfaceColumns,
    at: usize,
) {
    let FoundHits { instance, primitive, barycentric, .. } = *found;
    instance.store(&mut out.instance, at);
    primitive.store(&mut out.primitive, at);
    barycentric[0].store(&mut out.barycentric[0], at);
    barycentric[1].store(&mut out.barycentric[1], at);
    let geometry = &tables.geometry;
    let hit = geometry.hit_lanes(l, instance, primitive, barycentric[0], barycentric[1]);
    let hit = if out.has_times { hit.at_time(l.load(&out.time, at)) } else { hit };
    let point = geometry.surface_point(l, &hit);
    let wo = -direction;
    let front = point.geometric_normal.dot(wo).ge(0.0);
    let side = front.select(l.f(1.0), l.f(-1.0));
    store3(point.position, &mut out.position, at);
    point.error.store(&mut out.error, at);
    store3(point.geometric_normal * side, &mut out.geometric_normal, at);
    side.store(&mut out.side, at);
    store3(wo, &mut out.wo, at);
    let (tangent, density) = match program.uv {
        Some(column) => {
            let uv = geometry.uv_derivatives(l, &hit, column, point.edges);
            // Units of the coordinates a metre.
            (uv.tangent, (uv.determinant.abs() / point.double_area.max(1e-30)).sqrt())
        }
        None => (Vec3::splat(l, [0.0; 3]), l.f(0.0)),
    };
    let (tangent, shading) = match program.edge {
        Some(edge) => (point.edges[edge] * side, point.geometric_normal),
        None => (tangent, point.shading_normal),
    };
    let (tangent, shading) = if geometry.any_smooth() {
        let smooth = hit.smooth.shape.ne(0);
        (smooth.select(point.tangent, tangent), smooth.select(point.shading_normal, shading))
    } else {
        (tangent, shading)
    };
    store3(tangent, &mut out.tangent, at);
    store3(shading * side, &mut out.shading_normal, at);
    // A pixel's cone meets an inclined surface in a longer ellipse; its shorter axis would blur less, its longer one more.
    let cosine = point.geometric_normal.dot(wo).abs().max(0.05);
    width.store(&mut out.cone, at);
    let width = width / cosine.sqrt();
    width.store(&mut out.width, at);
    (width * density * out.lookup_width).store(&mut out.uv_width, at);
}

#[inline(always)]
fn store3<L: Lanes>(v: Vec3<L>, columns: &mut [Column; 3], at: usize) {
    let [x, y, z] = columns;
    v.store([x, y, z], at);
}
