//! Rays that go straight on meet all faces in their way, each once, also those that lie on each other.

use super::agreement::random_placement;
use super::{Geometry, Hits, Instance, Mesh, OwnedRays, Random, Tlas, instance, scene};
use crate::ray::is_on_edge;
use crate::{NONE, Passed};
use gonio_simd::Execution;

/// A square of this size about the middle, `copies` times.
fn squares(size: f32, copies: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for first in (0..copies).map(|copy| 4 * copy) {
        mesh.positions.extend([[-size, -size, 0.0], [size, -size, 0.0], [size, size, 0.0], [-size, size, 0.0]]);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    mesh
}

/// Squares of several sizes in one plane, twice each, and one mesh of three squares that lie on each other.
fn stack(placement: [[f64; 4]; 3]) -> Tlas {
    let meshes = [(1.0, 1), (0.7, 1), (0.9, 3)].map(|(size, copies)| squares(size, copies).blas());
    let instances: Vec<_> = [0, 1, 0, 2, 1].map(|mesh| Instance { transparent: true, ..instance(Geometry::Mesh(mesh), placement) }).into();
    scene(meshes.into(), &instances)
}

/// Has the rays that hit something begin just before it; the others end.
fn pass(rays: &mut OwnedRays, hits: &Hits) {
    rays.passed.resize(rays.t_min.len(), Passed::NOTHING);
    for (i, passed) in rays.passed.iter_mut().enumerate() {
        let [t, u, v] = [hits.t[i], hits.u[i], hits.v[i]];
        let is_miss = hits.instance[i] == NONE;
        rays.t_min[i] = if is_miss { f32::INFINITY } else { t.next_down() };
        let on_edge = u32::from(is_on_edge(u, v));
        *passed = Passed { t, instance: hits.instance[i], primitive: hits.primitive[i], on_edge };
    }
}

/// By ray, instance and triangle of all that it meets.
fn met(scene: &Tlas, execution: Execution, rays: &mut OwnedRays) -> Vec<(u32, u32, u32)> {
    let (mut all, mut hits) = (Vec::new(), Hits::default());
    loop {
        scene.first_hit(execution, &rays.batch(), true, &mut hits);
        let before = all.len();
        let found = (0..hits.t.len()).filter(|i| hits.instance[*i] != NONE);
        all.extend(found.map(|i| (i as u32, hits.instance[i], hits.primitive[i])));
        if all.len() == before {
            all.sort_unstable();
            return all;
        }
        pass(rays, &hits);
    }
}

#[test]
fn faces_that_lie_on_each_other_are_met_once_each() {
    let mut random = Random(31);
    for round in 0..12 {
        let placement = if round == 0 { Instance::IDENTITY } else { random_placement(&mut random) };
        let scene = stack(placement);
        let mut rays = OwnedRays::default();
        for _ in 0..600 {
            let place = [f64::from(random.signed()), f64::from(random.signed()), 0.0, 1.0];
            let target = placement.map(|row| row.iter().zip(place).map(|(a, b)| a * b).sum::<f64>() as f32);
            let origin = random.point().map(|x| 3.0 * x);
            rays.push(origin, [0, 1, 2].map(|axis| target[axis] - origin[axis]), f32::INFINITY);
        }
        for execution in Execution::all() {
            let (mut passed, mut blocked) = (Vec::new(), vec![0; 600]);
            scene.any_hit_transparent(execution, &rays.batch(), &mut blocked, &mut passed);
            let mut expected: Vec<_> = passed.iter().map(|hit| (hit.ray, hit.instance, hit.primitive)).collect();
            expected.sort_unstable();
            let mut own = OwnedRays { t_min: vec![0.0; 600], passed: Vec::new(), ..rays.clone() };
            assert_eq!(met(&scene, execution, &mut own), expected, "{execution:?}");
            assert!(expected.len() > 3 * 600, "{}", expected.len());
        }
    }
}

#[test]
fn a_surface_is_passed_once_where_its_triangles_meet() {
    let scene = squares(1.0, 1).scene();
    let mut rays = OwnedRays::default();
    rays.push([0.25, 0.25, 3.0], [0.0, 0.0, -1.0], f32::INFINITY);
    rays.push([0.5, 0.0, 3.0], [-0.5, 0.0, -3.0], f32::INFINITY);
    for execution in Execution::all() {
        let mut own = OwnedRays { t_min: vec![0.0; 2], passed: Vec::new(), ..rays.clone() };
        assert_eq!(met(&scene, execution, &mut own).len(), 2, "{execution:?}");
    }
}
