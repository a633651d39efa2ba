//! Rays that the caller brings, and what each of them meets first. Lights' shapes block nothing, as in pictures.

use crate::{
    accel::{Hits, NONE, RayBatch, RayMask},
    compile::{CompiledScene, compile},
    error::{Error, Result},
    scene::{Instances, PRIMVARS, Scene},
    threads::in_pool,
    transport::ray_mask,
};
use gonio_simd::{Column, Execution, Lanes, Vec3, dispatch};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// A scene that rays are sent into.
#[derive(Debug)]
pub struct RayCaster {
    compiled: CompiledScene,
    instances: Vec<Instances>,
    uv: Option<usize>,
}

/// What rays have met, an entry each.
#[derive(Clone, Debug, Default)]
pub struct SurfaceHits {
    /// Metres; infinite where nothing was met.
    pub distance: Vec<f64>,
    /// World space, metres; not a number where nothing was met, like all that follows but the numbers.
    pub position: Vec<[f64; 3]>,
    /// The unit shading normal, on the side from which the triangle's corners run counter-clockwise.
    pub normal: Vec<[f64; 3]>,
    /// The triangle's own unit normal on the same side.
    pub geometric_normal: Vec<[f64; 3]>,
    /// Texture coordinates; not a number where the mesh has none.
    pub uv: Vec<[f64; 2]>,
    /// The element of the scene's instances, its placement, the material, the triangle (of what the mesh was diced into); −1 for none.
    pub numbers: Vec<[i32; 4]>,
}

/// Rays that are traced together.
const BATCH: usize = 4096;

/// Rays of a batch, from the rebased origin, with unit directions.
#[derive(Default)]
struct Rays {
    origin: [Vec<f32>; 3],
    direction: [Vec<f32>; 3],
    t_min: Vec<f32>,
    t_max: Vec<f32>,
    mask: Vec<RayMask>,
}

/// Columns of a batch.
struct Room {
    rays: Rays,
    hits: Hits,
    behind: Hits,
    /// Position, shading normal, triangle's normal; coordinates.
    points: [[Column; 3]; 3],
    uv: [Column; 2],
    uv_known: Column,
}

impl RayCaster {
    /// Lays a scene out; `uv` is the primvar that hits give coordinates of.
    ///
    /// # Errors
    /// Those of compilation.
    pub fn new(scene: &Scene, uv: &str, cancel: &AtomicBool) -> Result<Self> {
        let mut scene = scene.clone();
        scene.settings.shader_passes = vec![format!("{PRIMVARS}{uv}")];
        let compiled = compile(&scene, None, cancel)?;
        let uv = compiled.primvar_column(uv);
        Ok(Self { compiled, instances: scene.instances, uv })
    }

    /// The first surface on each ray that cameras see, up to `farthest` metres. Origins are in metres; directions of any length.
    ///
    /// # Errors
    /// Other numbers of origins than of directions.
    pub fn first_hits(&self, origins: &[[f64; 3]], directions: &[[f64; 3]], farthest: f64, execution: Execution) -> Result<SurfaceHits> {
        if origins.len() != directions.len() {
            let problem = format!("{} were found for {} origins", directions.len(), origins.len());
            return Err(Error::setting("directions", problem));
        }
        let chunks = origins.par_chunks(BATCH).zip(directions.par_chunks(BATCH));
        let traced = chunks.map_init(Room::new, |room, (origins, directions)| {
            room.rays.fill(origins, directions, self.compiled.tables.origin, farthest);
            self.trace(room, execution);
            dispatch!(execution, l => self.look_up(l, room));
            self.hits(room, origins.len())
        });
        let parts: Vec<SurfaceHits> = in_pool(|| traced.collect());
        let mut all = SurfaceHits::default();
        parts.into_iter().for_each(|part| all.append(part));
        Ok(all)
    }

    /// Nearest surfaces; shapes of lights are passed.
    fn trace(&self, room: &mut Room, execution: Execution) {
        let bvh = &self.compiled.tables.bvh;
        bvh.first_hit_in_tree(execution, &room.rays.batch(), false, &mut room.hits);
        loop {
            let lights = self.at_lights(&room.hits);
            if lights.is_empty() {
                return;
            }
            for ray in &lights {
                room.rays.t_min[*ray] = (room.hits.t[*ray] * (1.0 + 1e-6)).next_up();
            }
            bvh.first_hit_in_tree(execution, &room.rays.batch(), false, &mut room.behind);
            lights.iter().for_each(|ray| copy(&room.behind, &mut room.hits, *ray));
        }
    }

    fn at_lights(&self, hits: &Hits) -> Vec<usize> {
        let first = self.compiled.tables.first_light_instance;
        (0..hits.instance.len()).filter(|ray| hits.instance[*ray] != NONE && hits.instance[*ray] >= first).collect()
    }

    /// Surface points and coordinates. Those of rays that met nothing are of any surface.
    #[inline(always)]
    fn look_up<L: Lanes>(&self, l: L, room: &mut Room) {
        let geometry = &self.compiled.tables.geometry;
        if geometry.instances.is_empty() {
            return;
        }
        let Room { hits, points: [position, normal, geometric], uv, uv_known, .. } = room;
        for at in (0..hits.t.len()).step_by(L::COUNT) {
            let (instance, primitive) = (l.load_integers_to_end(&hits.instance, at), l.load_integers_to_end(&hits.primitive, at));
            let met = instance.ne(NONE);
            let (u, v) = (l.load_to_end(&hits.u, at), l.load_to_end(&hits.v, at));
            let hit = geometry.hit_lanes(l, instance.keep_if(met), primitive.keep_if(met), u, v);
            let point = geometry.surface_point(l, &hit);
            store(point.position, position, at);
            store(point.shading_normal, normal, at);
            store(point.geometric_normal, geometric, at);
            if let Some(column) = self.uv {
                let ([s, t, ..], known) = geometry.primvar(l, &hit, column);
                s.store(&mut uv[0], at);
                t.store(&mut uv[1], at);
                l.f(1.0).keep_if(known).store(uv_known, at);
            }
        }
    }

    /// The first entries of a batch in the scene's own numbers.
    fn hits(&self, room: &Room, count: usize) -> SurfaceHits {
        let tables = &self.compiled.tables;
        let mut found = SurfaceHits::default();
        for ray in 0..count {
            let (instance, primitive) = (room.hits.instance[ray], room.hits.primitive[ray]);
            let met = instance != NONE;
            let value = |column: &Column| if met { f64::from(column[ray]) } else { f64::NAN };
            let [position, normal, geometric] = [0, 1, 2].map(|k| [0, 1, 2].map(|axis| value(&room.points[k][axis])));
            found.distance.push(if met { f64::from(room.hits.t[ray]) } else { f64::INFINITY });
            found.position.push([0, 1, 2].map(|axis| position[axis] + tables.origin[axis]));
            found.normal.push(normal);
            found.geometric_normal.push(geometric);
            let has_uv = self.uv.is_some() && room.uv_known[ray] > 0.0;
            found.uv.push([0, 1].map(|k| if has_uv { value(&room.uv[k]) } else { f64::NAN }));
            found.numbers.push(if met { self.numbers(instance, primitive) } else { [-1; 4] });
        }
        found
    }

    fn numbers(&self, instance: u32, primitive: u32) -> [i32; 4] {
        let geometry = &self.compiled.tables.geometry;
        let row = &geometry.instances[instance as usize];
        let slot = if row.first_slot == NONE { 0 } else { geometry.slots[(row.first_slot + primitive) as usize] };
        let materials = &self.instances[row.set as usize].materials;
        let material = materials.get(slot as usize).map_or(-1, |material| material.0 as i32);
        [row.set as i32, row.number as i32, material, primitive as i32]
    }
}

impl Room {
    fn new() -> Self {
        let column = || Column::new(BATCH);
        let three = || [column(), column(), column()];
        Self {
            rays: Rays::default(),
            hits: Hits::default(),
            behind: Hits::default(),
            points: [three(), three(), three()],
            uv: [column(), column()],
            uv_known: column(),
        }
    }
}

impl Rays {
    fn fill(&mut self, origins: &[[f64; 3]], directions: &[[f64; 3]], rebased: [f64; 3], farthest: f64) {
        let unit = |d: &[f64; 3]| {
            let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
            d.map(|x| (x / length) as f32)
        };
        for axis in 0..3 {
            self.origin[axis] = origins.iter().map(|origin| (origin[axis] - rebased[axis]) as f32).collect();
            self.direction[axis] = directions.iter().map(|direction| unit(direction)[axis]).collect();
        }
        self.t_min = vec![0.0; origins.len()];
        self.t_max = vec![farthest as f32; origins.len()];
        self.mask = vec![ray_mask::CAMERA; origins.len()];
    }

    fn batch(&self) -> RayBatch<'_> {
        let [origin, direction] = [&self.origin, &self.direction].map(|columns| [&columns[0][..], &columns[1][..], &columns[2][..]]);
        RayBatch { origin, direction, t_min: &self.t_min, t_max: &self.t_max, mask: &self.mask, time: &[], passed: &[] }
    }
}

impl SurfaceHits {
    /// Appends what other rays have met.
    pub fn append(&mut self, other: Self) {
        self.distance.extend(other.distance);
        self.position.extend(other.position);
        self.normal.extend(other.normal);
        self.geometric_normal.extend(other.geometric_normal);
        self.uv.extend(other.uv);
        self.numbers.extend(other.numbers);
    }
}

#[inline(always)]
fn store<L: Lanes>(v: Vec3<L>, [x, y, z]: &mut [Column; 3], at: usize) {
    v.store([x, y, z], at);
}

fn copy(from: &Hits, to: &mut Hits, ray: usize) {
    (to.t[ray], to.u[ray], to.v[ray]) = (from.t[ray], from.u[ray], from.v[ray]);
    (to.primitive[ray], to.instance[ray]) = (from.primitive[ray], from.instance[ray]);
}
