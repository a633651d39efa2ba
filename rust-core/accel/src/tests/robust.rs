//! Rays along surfaces, from far away, and with very unequal direction components.

use super::{Mesh, OwnedRays, Random, first_hits, levels};
use crate::NONE;
use gonio_simd::Execution;

#[test]
fn rays_with_zero_components_hit_boxes_they_start_on_the_border_of() {
    // A quad whose box is flat; the rays run along coordinate axes through its corners' planes.
    let mesh =
        Mesh { positions: vec![[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]], triangles: vec![[0, 1, 2], [0, 2, 3]] };
    let scene = mesh.scene();
    let mut rays = OwnedRays::default();
    for x in [0.0, 0.25, 1.0] {
        for y in [0.0, 0.75, 1.0] {
            for zero in [0.0, -0.0] {
                rays.push([x, y, 1.0], [zero, zero, -1.0], f32::INFINITY);
            }
        }
    }
    for tiny in [1e-30, -1e-38] {
        rays.push([0.25, 0.75, 1.0], [tiny, tiny, -1.0], f32::INFINITY);
    }
    for level in levels() {
        let mut hits = first_hits(&scene, level, &rays);
        assert!(hits.instance.iter().all(|&i| i != NONE), "{level:?}");
        scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut hits);
        assert!(hits.instance.iter().all(|&i| i != NONE), "{level:?}");
    }
}

#[test]
fn directions_of_any_length_hit_the_same() {
    let mut random = Random(51);
    let mesh = Mesh::soup(&mut random, 300, 1.0, 0.3);
    let scene = mesh.scene();
    let rays = OwnedRays { t_max: vec![f32::INFINITY; 2000], ..OwnedRays::random(&mut random, 2000, 1.0, true) };
    for power in [-30, 30] {
        let scale = 2f32.powi(power);
        let mut scaled = rays.clone();
        scaled.direction.iter_mut().flatten().for_each(|x| *x *= scale);
        for level in levels() {
            let (a, b) = (first_hits(&scene, level, &rays), first_hits(&scene, level, &scaled));
            assert_eq!(a.primitive, b.primitive);
            assert!(a.t.iter().zip(&b.t).all(|(a, b)| *a == b * scale));
        }
    }
}

/// Rays from far away agree with the oracle about everything that is well inside a triangle.
#[test]
fn far_origins_hit_what_is_large_enough() {
    let mut random = Random(52);
    let mesh = Mesh::soup(&mut random, 100, 1.0, 1.0);
    let scene = mesh.scene();
    let mut rays = OwnedRays::default();
    for _ in 0..2000 {
        let origin = random.point().map(|x| 1000.0 * x);
        let target = random.point();
        rays.push(origin, [0, 1, 2].map(|axis| target[axis] - origin[axis]), f32::INFINITY);
    }
    let hits = first_hits(&scene, levels()[0], &rays);
    let mut missed = 0;
    for i in 0..2000 {
        let (o, d, t_max) = super::oracle::ray(&rays, i);
        if super::oracle::nearest(&mesh, o, d, t_max).is_some_and(|hit| hit.margin > 1e-2) && hits.instance[i] == NONE {
            missed += 1;
        }
    }
    assert_eq!(missed, 0);
}
