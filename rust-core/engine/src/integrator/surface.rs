//! The third stage: surface points of a chunk of hits, gathered from the geometry tables.

use super::{material::Tables, state::gather3};
use crate::{
    accel::Hits,
    graph::{Program, SurfaceColumns},
};
use gonio_simd::{Column, F, Lanes, U, Vec3};

/// What a chunk of hits is looked up from.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChunkSource<'a> {
    /// Ray numbers, padded to whole registers.
    pub(super) order: &'a [u32],
    /// Rays of the chunk.
    pub(super) count: usize,
    pub(super) direction: &'a [Column; 3],
    /// Cone width at the rays' starts, and growth a metre.
    pub(super) cone: Option<[&'a Column; 2]>,
}

/// Where hits are found: by ray in [`Hits`], or in a list.
pub(super) trait HitSource {
    fn instance(&self, ray: usize) -> u32;
    fn primitive(&self, ray: usize) -> u32;
    fn barycentric(&self, ray: usize) -> [f32; 2];
    fn distance(&self, ray: usize) -> f32;
    /// The ray of an entry.
    fn ray(&self, entry: usize) -> usize;
}

impl HitSource for Hits {
    fn instance(&self, i: usize) -> u32 {
        self.instance[i]
    }
    fn primitive(&self, i: usize) -> u32 {
        self.primitive[i]
    }
    fn barycentric(&self, i: usize) -> [f32; 2] {
        [self.u[i], self.v[i]]
    }
    fn distance(&self, i: usize) -> f32 {
        self.t[i]
    }
    fn ray(&self, entry: usize) -> usize {
        entry
    }
}

impl HitSource for [crate::accel::PassedHit] {
    fn instance(&self, i: usize) -> u32 {
        self[i].instance
    }
    fn primitive(&self, i: usize) -> u32 {
        self[i].primitive
    }
    fn barycentric(&self, i: usize) -> [f32; 2] {
        [self[i].u, self[i].v]
    }
    fn distance(&self, i: usize) -> f32 {
        self[i].t
    }
    fn ray(&self, entry: usize) -> usize {
        self[entry].ray as usize
    }
}

/// Fills the surface columns for a chunk.
#[inline(always)]
pub(super) fn surface_chunk<L: Lanes, H: HitSource + ?Sized>(
    l: L,
    tables: &Tables,
    program: &Program,
    hits: &H,
    source: &ChunkSource<'_>,
    out: &mut SurfaceColumns,
) {
    out.origin = tables.origin.map(|x| x as f32);
    let mut distance = [0.0; gonio_simd::PADDING];
    let mut rays = [0; gonio_simd::PADDING];
    for at in (0..source.count).step_by(L::COUNT) {
        for lane in 0..L::COUNT {
            let entry = source.order[at + lane] as usize;
            out.instance[at + lane] = hits.instance(entry);
            out.primitive[at + lane] = hits.primitive(entry);
            [out.barycentric[0][at + lane], out.barycentric[1][at + lane]] = hits.barycentric(entry);
            distance[lane] = hits.distance(entry);
            rays[lane] = hits.ray(entry) as u32;
        }
        let (ray, distance) = (l.load_integers(&rays, 0), l.load(&distance, 0));
        let width = match source.cone {
            Some([width, spread]) => distance.mul_add(l.gather(spread, ray), l.gather(width, ray)),
            None => l.f(0.0),
        };
        surface_lanes(l, tables, program, gather3(l, source.direction, ray), width, out, at);
    }
}

#[inline(always)]
fn surface_lanes<L: Lanes>(l: L, tables: &Tables, program: &Program, direction: Vec3<L>, width: F<L>, out: &mut SurfaceColumns, at: usize) {
    let barycentric = [l.load(&out.barycentric[0], at), l.load(&out.barycentric[1], at)];
    let geometry = &tables.geometry;
    let instance: U<L> = l.load_integers(&out.instance, at);
    let hit = geometry.hit_lanes(l, instance, l.load_integers(&out.primitive, at), barycentric[0], barycentric[1]);
    let point = geometry.surface_point(l, &hit);
    let wo = -direction;
    let front = point.geometric_normal.dot(wo).ge(0.0);
    let side = front.select(l.f(1.0), l.f(-1.0));
    store3(point.position, &mut out.position, at);
    point.error.store(&mut out.error, at);
    store3(point.geometric_normal * side, &mut out.geometric_normal, at);
    store3(point.shading_normal * side, &mut out.shading_normal, at);
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
    store3(tangent, &mut out.tangent, at);
    // A pixel's cone meets an inclined surface in a longer ellipse; its shorter axis would blur less, its longer one more.
    let cosine = point.geometric_normal.dot(wo).abs().max(0.05);
    let width = width / cosine.sqrt();
    width.store(&mut out.width, at);
    (width * density).store(&mut out.uv_width, at);
}

#[inline(always)]
pub(super) fn store3<L: Lanes>(v: Vec3<L>, columns: &mut [Column; 3], at: usize) {
    let [x, y, z] = columns;
    v.store([x, y, z], at);
}
