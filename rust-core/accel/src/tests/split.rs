//! Long triangles that lie askew, in several leaves each: rays find what they find in a tree where each lies in one.

use super::{Geometry, Hits, Instance, Mesh, OwnedRays, Random, Tlas, instance, levels, scene};
use crate::build::split::Parts;
use crate::tree::blas::Triangles;
use crate::{Blas, Care, TransparentHit};
use gonio_simd::Execution;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A wheel: spokes of long triangles at all angles, within a rim of short ones.
fn wheel(random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    let mut add = |corners: [[f32; 3]; 3]| {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.triangles.push([first, first + 1, first + 2]);
    };
    for spoke in 0..24 {
        let (sin, cos) = (spoke as f32 * 0.13).sin_cos();
        for _ in 0..8 {
            let [x, y, z] = random.point().map(|x| 0.02 * x);
            add([[x - cos, y - sin, z], [x + cos, y + sin, z + 0.01], [x + cos, y + sin + 0.01, z]]);
        }
    }
    for step in 0..400 {
        let [(s, c), (t, d)] = [step, step + 1].map(|at| (at as f32 * (std::f32::consts::TAU / 400.0)).sin_cos());
        add([[c, s, -0.05], [d, t, -0.05], [c, s, 0.05]]);
    }
    mesh
}

fn built(mesh: &Mesh, care: Care) -> Arc<Blas> {
    Arc::new(Blas::build(&mesh.positions, &mesh.triangles, care, &AtomicBool::new(false)).expect("not cancelled"))
}

fn placed(tree: &Arc<Blas>, transparent: bool) -> Tlas {
    let place = |k: usize| {
        let mut rows = Instance::IDENTITY;
        (rows[2][3], rows[0][3]) = (0.4 * k as f64, 0.2 * k as f64);
        Instance { transparent, ..instance(Geometry::Mesh(0), rows) }
    };
    scene(vec![tree.clone()], &(0..5).map(place).collect::<Vec<_>>())
}

#[test]
fn rays_meet_the_same_triangles() {
    let mut random = Random(5);
    let mesh = wheel(&mut random);
    let triangles = Triangles { positions: &mesh.positions, triangles: &mesh.triangles };
    let parts = Parts::of(&triangles);
    assert!(parts.is_some_and(|parts| parts.triangles == mesh.triangles.len()), "spokes gain by it");
    let trees = [Care::Thorough, Care::Quick].map(|care| built(&mesh, care));
    assert!(trees[0].memory().blocks > trees[1].memory().blocks, "some triangles lie in several leaves");
    let rays = OwnedRays::random(&mut random, 8192, 1.2, true);
    let hit = |tree: &Arc<Blas>, execution: Execution, coherent: bool| {
        let (scene, mut hits, mut blocked) = (placed(tree, false), Hits::default(), vec![9; 8192]);
        scene.first_hit(execution, &rays.batch(), coherent, &mut hits);
        scene.occluded(execution, &rays.batch(), coherent, &mut blocked);
        (hits, blocked)
    };
    for level in levels() {
        for coherent in [true, false] {
            let [split, whole] = [0, 1].map(|number| hit(&trees[number], Execution::Vector(level), coherent));
            assert_eq!(split, whole, "{level:?}");
        }
    }
    assert_eq!(hit(&trees[0], Execution::Scalar, false), hit(&trees[1], Execution::Scalar, false));
}

#[test]
fn each_transparent_triangle_is_passed_once() {
    let mut random = Random(6);
    let mesh = wheel(&mut random);
    let rays = OwnedRays::random(&mut random, 4096, 1.2, false);
    for execution in levels().into_iter().map(Execution::Vector).chain([Execution::Scalar]) {
        let [split, whole] = [Care::Thorough, Care::Quick].map(|care| {
            let (mut blocked, mut passed) = (vec![9; 4096], Vec::<TransparentHit>::new());
            placed(&built(&mesh, care), true).any_hit_transparent(execution, &rays.batch(), &mut blocked, &mut passed);
            let mut passed: Vec<_> = passed.iter().map(|hit| (hit.ray, hit.instance, hit.primitive, hit.t.to_bits())).collect();
            passed.sort_unstable();
            passed
        });
        assert!(split.len() > 2000);
        assert_eq!(split, whole, "{execution:?}");
    }
}

#[test]
fn what_does_not_gain_is_left_alone() {
    // A sphere of fat triangles.
    let mut mesh = Mesh::default();
    let at = |i: u32, k: u32| {
        let ((s, c), (t, d)) = ((i as f32 * 0.1963).sin_cos(), ((k + 1) as f32 * 0.185).sin_cos());
        [t * c, t * s, d]
    };
    for (i, k) in (0..32).flat_map(|i| (0..15).map(move |k| (i, k))) {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)]);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let triangles = Triangles { positions: &mesh.positions, triangles: &mesh.triangles };
    assert!(Parts::of(&triangles).is_none());
    let mesh = Mesh::soup(&mut Random(7), 2000, 1.0, 0.1);
    assert!(Parts::of(&Triangles { positions: &mesh.positions, triangles: &mesh.triangles }).is_none());
}
