//! How much of the disc that a photon's light is spread over lies on surfaces. At edges and in corners the rest is nothing: its light would be lost.

use crate::{
    accel::{Hits, NONE, RayBatch, RayMask},
    transport::{Arrivals, OFF_PLANE, Photon, Tables, ray_mask},
};
use gonio_simd::{Column, Execution, Frame, Lanes, One, Vec3};
use std::f32::consts::{PI, TAU};

/// Places on a disc's rim that are asked first, and those all over it where it is not whole.
const RIM: usize = 4;
const PLACES: usize = 16;
/// Rays that are traced together.
const TOGETHER: usize = 4096;
/// Radians from one place of a disc to the next, which spreads them evenly.
const GOLDEN: f32 = PI * 0.763_932_02;

/// The surfaces that photons lie on.
pub(super) struct Ground<'a> {
    tables: &'a Tables,
    execution: Execution,
    /// By material, whether light arrived on anything of it: mirrors and clear glass take none.
    takes: Vec<bool>,
}

impl<'a> Ground<'a> {
    pub(super) fn new(tables: &'a Tables, execution: Execution) -> Self {
        let materials = tables.materials.surfaces.len() + tables.materials.mixes.len();
        Self { tables, execution, takes: vec![false; materials] }
    }

    /// Notes what light arrived on.
    pub(super) fn note(&mut self, arrivals: &Arrivals, entry: usize) {
        let material = self.tables.geometry.material(arrivals.instance[entry], arrivals.primitive[entry]);
        self.takes[material as usize] = true;
    }

    /// Normals of the triangles that light arrived on, and metres to their nearest edges.
    pub(super) fn triangles(&self, arrivals: &Arrivals, found: &mut [Column; 4]) {
        gonio_simd::dispatch!(self.execution, l => triangles_of(l, self.tables, arrivals, found));
    }

    /// The parts of photons' discs of a radius that lie on such surfaces.
    pub(super) fn covered(&self, photons: &[Photon], radius: f32) -> Vec<f32> {
        let mut room = Room::default();
        let mut shares = vec![1.0; photons.len()];
        let near_edges: Vec<u32> = (0..photons.len() as u32).filter(|number| photons[*number as usize].inside < radius).collect();
        let mut cut = Vec::new();
        for numbers in near_edges.chunks(TOGETHER / RIM) {
            self.ask(photons, numbers, radius, rim_place, RIM, &mut room);
            cut.extend(numbers.iter().zip(&room.met).filter(|(_, met)| **met < RIM as u32).map(|(number, _)| *number));
        }
        for numbers in cut.chunks(TOGETHER / PLACES) {
            self.ask(photons, numbers, radius, disc_place, PLACES, &mut room);
            for (number, met) in numbers.iter().zip(&room.met) {
                // Nothing is known of what has moved since.
                shares[*number as usize] = if *met == 0 { 1.0 } else { *met as f32 / PLACES as f32 };
            }
        }
        shares
    }

    /// Counts how many of some places of each disc are met from above.
    fn ask(&self, photons: &[Photon], numbers: &[u32], radius: f32, place: fn(usize, f32) -> [f32; 2], places: usize, room: &mut Room) {
        room.clear();
        for number in numbers {
            let photon = &photons[*number as usize];
            let frame = Frame::from_normal(Vec3::splat(One, photon.normal));
            let [along, across] = [frame.x, frame.y].map(|v| [v.x, v.y, v.z].map(|x| x.to_array()[0]));
            // Each photon's places are turned by an angle of its own.
            let turn = (*number as f32 * 0.618_034).fract() * TAU;
            for [x, y] in (0..places).map(|number| place(number, turn)) {
                let off = |axis: usize| (along[axis] * x + across[axis] * y) + photon.normal[axis] * OFF_PLANE;
                room.push([0, 1, 2].map(|axis| off(axis).mul_add(radius, photon.position[axis])), photon.normal, 2.0 * OFF_PLANE * radius);
            }
        }
        let mut hits = std::mem::take(&mut room.hits);
        self.tables.bvh.first_hit(self.execution, &room.rays(), false, &mut hits);
        let of_photons = hits.instance.chunks(places).zip(hits.primitive.chunks(places));
        room.met.extend(of_photons.map(|(instances, primitives)| {
            let met = instances.iter().zip(primitives).filter(|(instance, primitive)| self.takes(**instance, **primitive));
            met.count() as u32
        }));
        room.hits = hits;
    }

    fn takes(&self, instance: u32, primitive: u32) -> bool {
        let met = instance != NONE && instance < self.tables.first_light_instance;
        met && self.takes[self.tables.geometry.material(instance, primitive) as usize]
    }
}

#[inline(always)]
fn triangles_of<L: Lanes>(l: L, tables: &Tables, arrivals: &Arrivals, found: &mut [Column; 4]) {
    for at in (0..arrivals.count).step_by(L::COUNT) {
        let alive = l.first(arrivals.count - at);
        let [instance, primitive] = [&arrivals.instance, &arrivals.primitive].map(|column| l.load_integers(column, at).keep_if(alive));
        let [u, v] = [0, 1].map(|i| l.load(&arrivals.barycentric[i], at));
        let point = tables.geometry.surface_point(l, &tables.geometry.hit_lanes(l, instance, primitive, u, v));
        let [one, two] = point.edges;
        // A barycentric coordinate is a share of the height over the opposite edge.
        let inside = ((1.0 - u - v) / (two - one).length()).min(u / two.length()).min(v / one.length()) * point.double_area;
        let [x, y, z, edge] = &mut *found;
        point.geometric_normal.store([x, y, z], at);
        inside.store(edge, at);
    }
}

/// A place on the rim of the unit disc.
fn rim_place(number: usize, turn: f32) -> [f32; 2] {
    let (sin, cos) = (turn + number as f32 * (TAU / RIM as f32)).sin_cos();
    [cos, sin]
}

/// A place of the unit disc, each for as much of it.
fn disc_place(number: usize, turn: f32) -> [f32; 2] {
    let (sin, cos) = (turn + number as f32 * GOLDEN).sin_cos();
    let away = ((number as f32 + 0.5) / PLACES as f32).sqrt();
    [cos * away, sin * away]
}

/// Rays that are asked together, what they meet, and how many of each photon's do.
#[derive(Default)]
struct Room {
    origin: [Vec<f32>; 3],
    direction: [Vec<f32>; 3],
    t_min: Vec<f32>,
    t_max: Vec<f32>,
    mask: Vec<RayMask>,
    hits: Hits,
    met: Vec<u32>,
}

impl Room {
    fn clear(&mut self) {
        self.origin.iter_mut().chain(&mut self.direction).chain([&mut self.t_min, &mut self.t_max]).for_each(Vec::clear);
        self.mask.clear();
        self.met.clear();
    }

    /// A ray against a normal.
    fn push(&mut self, origin: [f32; 3], normal: [f32; 3], reach: f32) {
        for axis in 0..3 {
            self.origin[axis].push(origin[axis]);
            self.direction[axis].push(-normal[axis]);
        }
        self.t_min.push(0.0);
        self.t_max.push(reach);
        self.mask.push(ray_mask::ALL);
    }

    fn rays(&self) -> RayBatch<'_> {
        RayBatch {
            origin: self.origin.each_ref().map(Vec::as_slice),
            direction: self.direction.each_ref().map(Vec::as_slice),
            t_min: &self.t_min,
            t_max: &self.t_max,
            mask: &self.mask,
            time: &[],
            passed: &[],
        }
    }
}
