//! Tests of the accelerator against an oracle in f64, and of all execution paths against each other.

mod agreement;
mod building;
mod degenerate;
mod loose_lights;
mod moving;
mod oracle;
mod passing;
mod refit;
mod robust;
mod scenes;
mod smooth;
mod split;
mod watertight;

use super::{Blas, Care, Geometry, Hits, Instance, Passed, RayBatch, RayMask, Tlas};
use fearless_simd::Level;
use gonio_simd::Execution;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A linear congruential generator with a fixed seed (Knuth's multiplier), for reproducible scenes.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    fn point(&mut self) -> [f32; 3] {
        [self.signed(), self.signed(), self.signed()]
    }
}

/// Rays that own their columns.
#[derive(Default, Clone)]
struct OwnedRays {
    origin: [Vec<f32>; 3],
    direction: [Vec<f32>; 3],
    t_min: Vec<f32>,
    t_max: Vec<f32>,
    mask: Vec<RayMask>,
    /// Empty, or a time each.
    time: Vec<f32>,
    /// Empty, or a hit each.
    passed: Vec<Passed>,
}

impl OwnedRays {
    fn push(&mut self, origin: [f32; 3], direction: [f32; 3], t_max: f32) {
        for axis in 0..3 {
            self.origin[axis].push(origin[axis]);
            self.direction[axis].push(direction[axis]);
        }
        self.t_min.push(0.0);
        self.t_max.push(t_max);
        self.mask.push(1);
    }

    /// The rays from `first` up to `end`.
    fn part(&self, first: usize, end: usize) -> RayBatch<'_> {
        let all = self.batch();
        RayBatch {
            origin: all.origin.map(|x| &x[first..end]),
            direction: all.direction.map(|x| &x[first..end]),
            t_min: &all.t_min[first..end],
            t_max: &all.t_max[first..end],
            mask: &all.mask[first..end],
            time: if all.time.is_empty() { all.time } else { &all.time[first..end] },
            passed: if all.passed.is_empty() { all.passed } else { &all.passed[first..end] },
        }
    }

    fn batch(&self) -> RayBatch<'_> {
        RayBatch {
            origin: [&self.origin[0], &self.origin[1], &self.origin[2]],
            direction: [&self.direction[0], &self.direction[1], &self.direction[2]],
            t_min: &self.t_min,
            t_max: &self.t_max,
            mask: &self.mask,
            time: &self.time,
            passed: &self.passed,
        }
    }

    /// Rays between random points; every group of sixteen starts at one point and is aimed at a small patch when `coherent`.
    fn random(random: &mut Random, n: usize, scale: f32, coherent: bool) -> Self {
        let mut rays = OwnedRays::default();
        let (mut origin, mut target) = ([0.0; 3], [0.0; 3]);
        for i in 0..n {
            if i % 16 == 0 || !coherent {
                (origin, target) = (random.point().map(|x| 2.0 * scale * x), random.point().map(|x| scale * x));
            }
            let spread = random.point().map(|x| 0.1 * scale * x);
            let direction = [0, 1, 2].map(|axis| target[axis] + spread[axis] - origin[axis]);
            rays.push(origin, direction, if i % 5 == 0 { 1.1 } else { f32::INFINITY });
        }
        rays
    }
}

/// Vertices and triangles of a mesh.
#[derive(Default, Clone)]
struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn soup(random: &mut Random, n: usize, scale: f32, size: f32) -> Self {
        let mut mesh = Mesh::default();
        for i in 0..n as u32 {
            let centre = random.point();
            for _ in 0..3 {
                let offset = random.point();
                mesh.positions.push([0, 1, 2].map(|axis| scale * (centre[axis] + size * offset[axis])));
            }
            mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        mesh
    }

    fn blas(&self) -> Arc<Blas> {
        Arc::new(Blas::build(&self.positions, &self.triangles, Care::Quick, &AtomicBool::new(false)).expect("not cancelled"))
    }

    /// The mesh alone in a scene.
    fn scene(&self) -> Tlas {
        scene(vec![self.blas()], &[instance(Geometry::Mesh(0), Instance::IDENTITY)])
    }
}

fn instance(geometry: Geometry, object_to_world: [[f64; 4]; 3]) -> Instance {
    Instance { geometry, object_to_world, mask: 1, transparent: false }
}

/// A scene whose rays go in streams however small it is.
fn scene(meshes: Vec<Arc<Blas>>, instances: &[Instance]) -> Tlas {
    let scene = Tlas::build(meshes, instances, &AtomicBool::new(false)).expect("not cancelled");
    scene.tuners.settle(true);
    scene
}

/// Every SIMD level of this machine that is built.
pub(crate) fn levels() -> Vec<Level> {
    let vector = |execution| match execution {
        Execution::Vector(level) => Some(level),
        Execution::Scalar => None,
    };
    Execution::all().into_iter().filter_map(vector).collect()
}

fn first_hits(scene: &Tlas, level: Level, rays: &OwnedRays) -> Hits {
    let mut hits = Hits::default();
    scene.first_hit(Execution::Vector(level), &rays.batch(), false, &mut hits);
    hits
}
