//! Triangles and trees at the edge of sense.

use super::{Hits, Mesh, OwnedRays, Random, first_hits, levels};
use crate::NONE;
use gonio_simd::Execution;

/// A soup with points, lines, NaN, infinite and huge triangles and missing points among it hits what it hits without them.
#[test]
fn unusable_triangles_change_nothing() {
    let mut random = Random(41);
    let good = Mesh::soup(&mut random, 500, 1.0, 0.2);
    let mut mixed = good.clone();
    let n = mixed.positions.len() as u32;
    mixed.positions.extend([
        [f32::NAN, 0.0, 0.0],
        [f32::INFINITY, 0.0, 0.0],
        [0.0, -f32::INFINITY, f32::NAN],
        [3e38, 0.0, 0.0],
        [0.1, 0.2, 0.3],
    ]);
    for i in 0..4 {
        mixed.triangles.extend([[0, 1, n + i], [n + 4, n + 4, n + 4], [0, n + 4, 0], [3, 4, 4], [0, 1, n + 77], [0, 1, u32::MAX]]);
    }
    // A huge but usable triangle, far away.
    mixed.positions.extend([[1e11, 1e11, 0.0], [1e11, 0.0, 1e11], [1e11, -1e11, -1e11]]);
    mixed.triangles.push([n + 5, n + 6, n + 7]);
    let rays = OwnedRays::random(&mut random, 4000, 1.0, true);
    let rays = OwnedRays { t_max: vec![100.0; 4000], ..rays };
    let (a, b) = (good.scene(), mixed.scene());
    for level in levels() {
        let (a, b) = (first_hits(&a, level, &rays), first_hits(&b, level, &rays));
        assert_eq!(a, b, "{level:?}");
    }
}

#[test]
fn unusable_rays_hit_nothing() {
    let mesh = Mesh::soup(&mut Random(42), 200, 1.0, 1.0);
    let scene = mesh.scene();
    let mut rays = OwnedRays::default();
    for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY, 3e38] {
        rays.push([bad, 0.0, 0.0], [1.0, 0.0, 0.0], f32::INFINITY);
        rays.push([0.0; 3], [0.0, bad, 0.0], f32::INFINITY);
        rays.push([0.0; 3], [1.0, bad, bad], f32::INFINITY);
    }
    rays.push([0.0; 3], [0.0; 3], f32::INFINITY);
    rays.push([0.0; 3], [1.0, 0.0, 0.0], f32::NAN);
    rays.push([0.0; 3], [1.0, 0.0, 0.0], -1.0);
    for level in levels() {
        let mut hits = first_hits(&scene, level, &rays);
        assert!(hits.instance.iter().all(|&i| i == NONE));
        scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut hits);
        assert!(hits.instance.iter().all(|&i| i == NONE));
        let mut out = vec![1; rays.mask.len()];
        scene.occluded(Execution::Vector(level), &rays.batch(), false, &mut out);
        assert!(out.iter().all(|&o| o == 0));
        scene.occluded(Execution::Vector(level), &rays.batch(), true, &mut out);
        assert!(out.iter().all(|&o| o == 0));
    }
}

/// Thousands of triangles at one place, equal triangles in a row, and triangles that halve in size again and again: trees without good splits.
#[test]
fn trees_without_good_splits_stay_correct() {
    let stacked = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]; 20_000] };
    let mut row = Mesh::default();
    for i in 0..20_000u32 {
        let x = i as f32 - 1e4;
        row.positions.extend([[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0]]);
        row.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    assert!(first_hits(&row.scene(), levels()[0], &OwnedRays::random(&mut Random(43), 100, 1.0, false)).t.len() == 100);
    let mut nested = Mesh::default();
    for i in 0..2000u32 {
        let size = 0.5f32.powf(i as f32 / 20.0);
        nested.positions.extend([[-size, -size, size], [size, -size, size], [0.0, size, size]]);
        nested.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let mut rays = OwnedRays::default();
    for i in 0..100 {
        rays.push([0.2 - i as f32 * 0.001, 0.2, 3.0], [0.001, 0.0, -1.0], f32::INFINITY);
    }
    for level in levels() {
        let hits = first_hits(&stacked.scene(), level, &rays);
        assert!(hits.primitive.iter().all(|&p| p == 19_999), "the last of equal triangles is named");
        let mut packets = Hits::default();
        stacked.scene().first_hit(Execution::Vector(level), &rays.batch(), true, &mut packets);
        assert_eq!(packets, hits);
        let hits = first_hits(&nested.scene(), level, &rays);
        assert_eq!(super::oracle::disagreements(&nested, &rays, &hits), 0);
    }
}
