//! What absorbs where cameras and sensors stand: the closed meshes that hold a place.
//!
//! A ray from the place leaves each mesh that holds it once more than it enters it. Cycles fills its stack of volumes in the same way.

use super::bounds::Bounds;
use crate::{
    accel::{Hits, RayBatch},
    scene::Scene,
    transport::{MaterialTable, Tables},
};
use gonio_simd::{Execution, Lanes, One, Vec3};

/// Along no axis and no diagonal, so that it seldom meets an edge.
const DIRECTION: [f32; 3] = [0.233_25, 0.317_56, 0.919_11];
/// Most surfaces of a mesh that are counted.
const MOST: usize = 4096;

/// Placed meshes that are full of what absorbs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies(Vec<Body>);

#[derive(Clone, Debug)]
struct Body {
    instance: u32,
    bounds: Bounds,
}

impl Bodies {
    /// Those of a scene whose meshes have bounds; `rows` are the sets that instances came from, their numbers there, and their meshes.
    pub(super) fn of(
        scene: &Scene,
        mesh_bounds: &[Bounds],
        materials: &MaterialTable,
        rows: impl Iterator<Item = (u32, u32, u32)>,
    ) -> Self {
        let filled: Vec<bool> = scene.materials.iter().map(|material| material.absorption.iter().any(|x| *x > 0.0)).collect();
        if !filled.contains(&true) {
            return Self::default();
        }
        let is_filled = |id: usize| filled.get(id) == Some(&true) && materials.interior(materials.number(id)).is_some();
        let holds: Vec<bool> = scene.instances.iter().map(|set| set.materials.iter().any(|id| is_filled(id.index()))).collect();
        let body = |(instance, (set, number, mesh)): (usize, (u32, u32, u32))| {
            let is_mesh = (mesh as usize) < scene.meshes.len() && holds.get(set as usize) == Some(&true);
            let transform = scene.instances.get(set as usize)?.transforms.get(number as usize)?;
            is_mesh.then(|| Body { instance: instance as u32, bounds: mesh_bounds[mesh as usize].transformed(transform) })
        };
        Self(rows.enumerate().filter_map(body).collect())
    }

    /// Absorption a metre at a place, world space; where things stand at the middle of the shutter.
    pub(crate) fn absorption(&self, tables: &Tables, place: [f64; 3]) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for body in self.0.iter().filter(|body| (0..3).all(|i| (body.bounds.min[i]..=body.bounds.max[i]).contains(&place[i]))) {
            let origin = [0, 1, 2].map(|i| (place[i] - tables.origin[i]) as f32);
            let own = around(tables, body.instance, origin);
            (0..3).for_each(|i| sum[i] += own[i]);
        }
        // Open meshes may be left without having been entered, or the other way round.
        sum.map(|x: f64| x.max(0.0) as f32)
    }
}

/// What an instance absorbs at a place, rebased: what fills it where a ray leaves it, less where it enters.
fn around(tables: &Tables, instance: u32, origin: [f32; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let mut hits = Hits::default();
    let mut from = 0.0;
    for _ in 0..MOST {
        let rays = RayBatch {
            origin: [&origin[..1], &origin[1..2], &origin[2..]],
            direction: [&DIRECTION[..1], &DIRECTION[1..2], &DIRECTION[2..]],
            t_min: &[from],
            t_max: &[f32::INFINITY],
            mask: &[u8::MAX],
            time: &[],
            passed: &[],
        };
        tables.bvh.first_hit_within(Execution::Scalar, &rays, &[instance], &mut hits);
        let (t, primitive) = (hits.t[0], hits.primitive[0]);
        if !t.is_finite() {
            break;
        }
        from = t.next_up();
        if let Some(interior) = tables.materials.interior(tables.geometry.material(instance, primitive)) {
            let hit = tables.geometry.hit_lanes(One, One.u(instance), One.u(primitive), One.f(hits.u[0]), One.f(hits.v[0]));
            let normal = tables.geometry.surface_point(One, &hit).geometric_normal;
            let sign = if normal.dot(Vec3::splat(One, DIRECTION)).gt(0.0).any() { 1.0 } else { -1.0 };
            (0..3).for_each(|i| sum[i] += sign * f64::from(interior[i]));
        }
    }
    sum
}
