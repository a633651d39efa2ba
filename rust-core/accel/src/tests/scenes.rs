//! Instances: placement, masks, shapes, moving, emptiness.

use super::oracle::crossing;
use super::{Geometry, Instance, Mesh, OwnedRays, Random, agreement::random_placement, first_hits, instance, levels, scene};
use crate::{Blas, Cancelled, Care, Hits, NONE, Shape, Tlas, intersect::triangle_block::TriangleBlock};
use gonio_simd::Execution;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Rotated, scaled and mirrored instances against brute force over all placed triangles in f64.
#[test]
fn placed_instances_match_the_oracle() {
    let mut random = Random(21);
    let mesh = Mesh::soup(&mut random, 30, 1.0, 0.5);
    let instances: Vec<Instance> = (0..60).map(|_| instance(Geometry::Mesh(0), random_placement(&mut random))).collect();
    let scene = scene(vec![mesh.blas()], &instances);
    let rays = OwnedRays::random(&mut random, 3000, 1.0, true);
    let hits = first_hits(&scene, levels()[0], &rays);
    let mut wrong = 0;
    for i in 0..3000 {
        let (o, d, t_max) = super::oracle::ray(&rays, i);
        let mut best = (f64::INFINITY, NONE, NONE);
        for (k, placed) in instances.iter().enumerate() {
            for (p, triangle) in mesh.triangles.iter().enumerate() {
                let corners = triangle.map(|v| {
                    let x = mesh.positions[v as usize].map(f64::from);
                    placed.object_to_world.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3])
                });
                let Some((t, u, v)) = crossing(o, d, corners) else { continue };
                if u.min(v).min(1.0 - u - v) >= 0.0 && t > 0.0 && t <= t_max && t < best.0 {
                    best = (t, k as u32, p as u32);
                }
            }
        }
        wrong += usize::from((best.1, best.2) != (hits.instance[i], hits.primitive[i]));
    }
    assert!(wrong <= 3, "{wrong} of 3000 rays");
}

/// A box of twelve triangles.
fn cuboid() -> Mesh {
    let corner = |i: u32| [i & 1, (i >> 1) & 1, (i >> 2) & 1].map(|bit| bit as f32 - 0.5);
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { positions: (0..8).map(corner).collect(), triangles }
}

/// Triangles that stand in the top level are hit where the mesh in its own space is.
#[test]
fn triangles_of_small_meshes_are_hit_in_world_space() {
    let mut random = Random(24);
    let instances: Vec<Instance> = (0..100).map(|_| instance(Geometry::Mesh(0), random_placement(&mut random))).collect();
    let scene = scene(vec![cuboid().blas()], &instances);
    assert_eq!(scene.blocks.iter().map(TriangleBlock::len).sum::<usize>(), 12 * instances.len());
    let rays = OwnedRays::random(&mut random, 3000, 1.0, true);
    let all = first_hits(&scene, levels()[0], &rays);
    let (mut met, mut alone) = (0, Hits::default());
    for i in (0..3000).filter(|i| all.instance[*i] != NONE) {
        scene.first_hit_within(Execution::Vector(levels()[0]), &rays.part(i, i + 1), &all.instance[i..=i], &mut alone);
        let near = |a: f32, b: f32| (a - b).abs() <= 1e-4 * (1.0 + b.abs());
        let same = all.primitive[i] == alone.primitive[0] && near(all.u[i], alone.u[0]) && near(all.v[i], alone.v[0]);
        met += usize::from(near(all.t[i], alone.t[0]) && same);
    }
    let hits = all.instance.iter().filter(|&&i| i != NONE).count();
    // Rays along edges may meet the other triangle.
    assert!(hits > 1000 && met + 3 >= hits, "{met} of {hits}");
}

#[test]
fn many_instances_of_small_meshes_stay_instances() {
    let placed = |i: u32| [[1.0, 0.0, 0.0, f64::from(i)], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let instances: Vec<Instance> = (0..4097).map(|i| instance(Geometry::Mesh(0), placed(i))).collect();
    assert!(scene(vec![cuboid().blas()], &instances).blocks.is_empty());
}

#[test]
fn masks_hide_instances() {
    let boxed = instance(Geometry::Shape(Shape::Rectangle), Instance::IDENTITY);
    let behind = Instance { object_to_world: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]], mask: 4, ..boxed };
    let scene = scene(Vec::new(), &[Instance { mask: 2, ..boxed }, behind]);
    let mut rays = OwnedRays::default();
    for _ in 0..16 {
        rays.push([0.1, 0.2, 1.0], [0.0, 0.0, -1.0], f32::INFINITY);
    }
    rays.mask = [2, 4, 6, 1, 2, 4, 6, 1, 2, 4, 6, 1, 2, 4, 6, 0].to_vec();
    let expected: Vec<u32> = rays
        .mask
        .iter()
        .map(|m| {
            if m & 2 != 0 {
                0
            } else if m & 4 != 0 {
                1
            } else {
                NONE
            }
        })
        .collect();
    for level in levels() {
        let mut hits = first_hits(&scene, level, &rays);
        assert_eq!(hits.instance, expected);
        scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut hits);
        assert_eq!(hits.instance, expected);
    }
}

#[test]
fn flat_shapes_are_hit_from_both_sides_and_closed_ones_from_outside() {
    let cases = [
        (Shape::Rectangle, [0.25, -0.25, 3.0], [0.0, 0.0, -1.0], Some(3.0)),
        (Shape::Rectangle, [0.25, -0.25, -3.0], [0.0, 0.0, 2.0], Some(1.5)),
        (Shape::Rectangle, [0.75, 0.0, 3.0], [0.0, 0.0, -1.0], None),
        (Shape::Disk, [0.6, 0.6, 3.0], [0.0, 0.0, -1.0], Some(3.0)),
        (Shape::Disk, [0.8, 0.8, 3.0], [0.0, 0.0, -1.0], None),
        (Shape::Sphere, [0.0, 0.0, 3.0], [0.0, 0.0, -1.0], Some(2.0)),
        (Shape::Sphere, [0.0, 0.0, 0.0], [0.0, 3.0, 4.0], None),
        (Shape::Sphere, [0.0, 6.0, 8.0], [0.0, -3.0, -4.0], Some(1.8)),
        (Shape::Cylinder, [0.1, 0.0, 0.0], [0.0, 0.0, 1.0], None),
        (Shape::Cylinder, [0.4, 0.0, 3.0], [0.0, 0.0, -1.0], Some(2.0)),
        (Shape::Cylinder, [0.6, 0.0, 3.0], [0.0, 0.0, -1.0], None),
        (Shape::Cylinder, [3.0, 0.0, 0.0], [-1.0, 0.0, 0.0], None),
    ];
    for (shape, origin, direction, t) in cases {
        let scene = scene(Vec::new(), &[instance(Geometry::Shape(shape), Instance::IDENTITY)]);
        let mut rays = OwnedRays::default();
        rays.push(origin, direction, 100.0);
        let hits = first_hits(&scene, levels()[0], &rays);
        assert_eq!(hits.t[0], t.unwrap_or(100.0), "{shape:?} {origin:?}");
        assert_eq!(hits.instance[0] == NONE, t.is_none());
    }
}

#[test]
fn nothing_is_hit_in_empty_scenes() {
    let empty = Arc::new(Blas::build(&[], &[], Care::Quick, &AtomicBool::new(false)).expect("not cancelled"));
    let singular = [[0.0; 4]; 3];
    let triangle = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]] }.blas();
    let hidden = [
        instance(Geometry::Mesh(0), Instance::IDENTITY),
        instance(Geometry::Mesh(7), Instance::IDENTITY),
        instance(Geometry::Mesh(1), singular),
        instance(Geometry::Mesh(1), [[f64::NAN; 4]; 3]),
    ];
    let mut random = Random(22);
    let rays = OwnedRays::random(&mut random, 100, 1.0, true);
    for scene in [scene(Vec::new(), &[]), scene(vec![empty, triangle], &hidden)] {
        let mut hits = first_hits(&scene, levels()[0], &rays);
        assert!(hits.instance.iter().all(|&i| i == NONE) && hits.t == rays.t_max);
        scene.first_hit(Execution::Vector(levels()[0]), &rays.batch(), true, &mut hits);
        assert!(hits.instance.iter().all(|&i| i == NONE));
        scene.first_hit(Execution::Scalar, &rays.batch(), false, &mut hits);
        assert!(hits.instance.iter().all(|&i| i == NONE));
    }
    let mut hits = Hits::default();
    scene(Vec::new(), &[]).first_hit(Execution::Vector(levels()[0]), &OwnedRays::default().batch(), false, &mut hits);
    assert_eq!(hits, Hits::default());
}

#[test]
fn rebuilding_moves_instances() {
    let mut scene = scene(Vec::new(), &[instance(Geometry::Shape(Shape::Sphere), Instance::IDENTITY)]);
    let mut rays = OwnedRays::default();
    rays.push([0.0, 0.0, 5.0], [0.0, 0.0, -1.0], f32::INFINITY);
    assert_eq!(first_hits(&scene, levels()[0], &rays).t[0], 4.0);
    let mut moved = Instance::IDENTITY;
    moved[2][3] = 2.0;
    scene.rebuild(&[instance(Geometry::Shape(Shape::Sphere), moved)], &AtomicBool::new(false)).expect("not cancelled");
    assert_eq!(first_hits(&scene, levels()[0], &rays).t[0], 2.0);
}

#[test]
fn instances_are_cheap_and_builds_can_be_cancelled() {
    let mut random = Random(23);
    let instances: Vec<Instance> = (0..20_000).map(|_| instance(Geometry::Shape(Shape::Sphere), random_placement(&mut random))).collect();
    let bytes = scene(Vec::new(), &instances).memory() / instances.len();
    assert!(bytes < 200, "{bytes} bytes an instance");
    let cancel = AtomicBool::new(true);
    assert_eq!(Tlas::build(Vec::new(), &instances, &cancel).err(), Some(Cancelled));
    let mesh = Mesh::soup(&mut random, 1000, 1.0, 0.1);
    assert_eq!(Blas::build(&mesh.positions, &mesh.triangles, Care::Quick, &cancel).err(), Some(Cancelled));
}
