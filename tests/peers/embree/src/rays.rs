//! The sets of rays: camera, diffuse bounces, and shadow rays towards a light overhead.

use crate::world::World;
use gonio::accel::{Hits, NONE, RayBatch};

/// Rays that own their columns.
#[derive(Clone, Default)]
pub struct OwnedRays {
    pub origin: [Vec<f32>; 3],
    pub direction: [Vec<f32>; 3],
    pub t_min: Vec<f32>,
    pub t_max: Vec<f32>,
    mask: Vec<gonio::accel::RayMask>,
}

impl OwnedRays {
    pub fn push(&mut self, origin: [f32; 3], direction: [f32; 3], t_min: f32, t_max: f32) {
        for axis in 0..3 {
            self.origin[axis].push(origin[axis]);
            self.direction[axis].push(direction[axis]);
        }
        self.t_min.push(t_min);
        self.t_max.push(t_max);
        self.mask.push(gonio::accel::RayMask::MAX);
    }

    pub fn len(&self) -> usize {
        self.t_max.len()
    }

    /// Rays `first` to `first + n`.
    pub fn batch(&self, first: usize, n: usize) -> RayBatch<'_> {
        let range = first..first + n;
        RayBatch {
            origin: [0, 1, 2].map(|axis| &self.origin[axis][range.clone()]),
            direction: [0, 1, 2].map(|axis| &self.direction[axis][range.clone()]),
            t_min: &self.t_min[range.clone()],
            t_max: &self.t_max[range.clone()],
            mask: &self.mask[range],
            time: &[],
            passed: &[],
        }
    }
}

/// A linear congruential generator with a fixed seed (Knuth's multiplier).
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// Pinhole camera, one ray a pixel, pixels in tiles of 4 x 4.
pub fn primary(world: &World, width: usize, height: usize) -> OwnedRays {
    let mut rays = OwnedRays::default();
    for tile in 0..width * height / 16 {
        let (tx, ty) = (tile % (width / 4) * 4, tile / (width / 4) * 4);
        for k in 0..16 {
            let x = (tx + k % 4) as f32 + 0.5 - 0.5 * width as f32;
            let y = 0.5 * height as f32 - (ty + k / 4) as f32 - 0.5;
            let (x, y) = (1.6 * x / width as f32, 1.6 * y / width as f32 - 0.25);
            let direction = normalized([0.9 * x + 0.1, 1.0, y]);
            rays.push(world.eye, direction, 0.0, f32::INFINITY);
        }
    }
    rays
}

pub fn normalized(v: [f32; 3]) -> [f32; 3] {
    let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
    v.map(|x| x / length)
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The corners in the world of what a ray hit.
fn corners(world: &World, hits: &Hits, i: usize) -> [[f32; 3]; 3] {
    let placement = &world.placements[hits.instance[i] as usize];
    let mesh = &world.meshes[placement.mesh as usize];
    mesh.triangles[hits.primitive[i] as usize].map(|k| {
        let [x, y, z] = mesh.positions[k as usize].map(f64::from);
        placement.object_to_world.map(|row| (row[0] * x + row[1] * y + row[2] * z + row[3]) as f32)
    })
}

/// The hit point of a ray and the unit normal on its side; misses end above the world's middle.
fn surface(world: &World, rays: &OwnedRays, hits: &Hits, i: usize) -> ([f32; 3], [f32; 3]) {
    if hits.instance[i] == NONE {
        return ([0.0, 0.0, 2.0], [0.0, 0.0, 1.0]);
    }
    let corners = corners(world, hits, i);
    let edge = |k: usize| [0, 1, 2].map(|a| corners[k][a] - corners[0][a]);
    let normal = normalized(cross(edge(1), edge(2)));
    let direction = [0, 1, 2].map(|a| rays.direction[a][i]);
    let facing = (0..3).map(|a| normal[a] * direction[a]).sum::<f32>();
    let normal = if facing > 0.0 { normal.map(|x| -x) } else { normal };
    let point = [0, 1, 2].map(|a| rays.origin[a][i] + hits.t[i] * direction[a] + 1e-4 * normal[a]);
    (point, normal)
}

/// Cosine-distributed rays from the hits.
pub fn bounce(world: &World, rays: &OwnedRays, hits: &Hits, random: &mut Random) -> OwnedRays {
    let mut out = OwnedRays::default();
    for i in 0..rays.len() {
        let (point, normal) = surface(world, rays, hits, i);
        let (phi, z) = (std::f32::consts::TAU * random.unit(), 2.0 * random.unit() - 1.0);
        let r = (1.0 - z * z).max(0.0).sqrt();
        let ball = [r * phi.cos(), r * phi.sin(), z];
        out.push(point, normalized([0, 1, 2].map(|a| normal[a] * 1.0001 + ball[a])), 0.0, f32::INFINITY);
    }
    out
}

/// Rays from the hits to points of the light.
pub fn shadow(world: &World, rays: &OwnedRays, hits: &Hits, random: &mut Random) -> OwnedRays {
    let mut out = OwnedRays::default();
    for i in 0..rays.len() {
        let (point, _) = surface(world, rays, hits, i);
        let (middle, half) = world.light;
        let mut side = || half * (2.0 * random.unit() - 1.0);
        let light = [middle[0] + side(), middle[1] + side(), middle[2]];
        out.push(point, [0, 1, 2].map(|a| light[a] - point[a]), 0.0, 0.999);
    }
    out
}
