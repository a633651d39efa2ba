//! Single rays, packets and the scalar path find the same.

use super::{Geometry, Hits, Instance, Mesh, OwnedRays, Random, Tlas, instance, levels, scene};
use crate::{NONE, RayMask, Shape, traverse::stream_tuner::StreamTuners};
use gonio_simd::Execution;

/// A random map: rotation by a quaternion, scale with a mirror now and then, translation.
pub(super) fn random_placement(random: &mut Random) -> [[f64; 4]; 3] {
    let q: [f64; 4] = [random.signed(), random.signed(), random.signed(), random.signed()].map(f64::from);
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt() + 1e-9;
    let [w, x, y, z] = q.map(|c| c / length);
    let rotation = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    let scale = [0, 1, 2].map(|_| f64::from(0.02 + 0.2 * random.unit()) * if random.unit() < 0.3 { -1.0 } else { 1.0 });
    let mut m = [[0.0; 4]; 3];
    for (row, out) in m.iter_mut().enumerate() {
        for column in 0..3 {
            out[column] = rotation[row][column] * scale[column];
        }
        out[3] = f64::from(random.signed());
    }
    m
}

fn busy_scene(random: &mut Random, n: usize) -> (Tlas, Vec<Instance>) {
    let meshes: Vec<_> = [(1, 1.0), (40, 0.5), (3000, 0.1)].map(|(n, size)| Mesh::soup(random, n, 1.0, size).blas()).into();
    let shapes = [Shape::Rectangle, Shape::Disk, Shape::Sphere, Shape::Cylinder];
    let instances: Vec<Instance> = (0..n)
        .map(|i| {
            let geometry = if i % 3 == 0 { Geometry::Shape(shapes[i / 3 % 4]) } else { Geometry::Mesh(i as u32 % 3) };
            let placed = instance(geometry, random_placement(random));
            Instance { mask: 1 + (i % 2) as RayMask, transparent: i % 5 == 0, ..placed }
        })
        .collect();
    (scene(meshes, &instances), instances)
}

#[test]
fn packets_find_what_single_rays_find() {
    let mut random = Random(11);
    let (scene, _) = busy_scene(&mut random, 300);
    for coherent in [true, false] {
        let mut rays = OwnedRays::random(&mut random, 20_011, 1.0, coherent);
        for (i, mask) in rays.mask.iter_mut().enumerate() {
            *mask = 1 + (i % 3) as RayMask;
        }
        for level in levels() {
            let single = super::first_hits(&scene, level, &rays);
            let mut packets = Hits::default();
            scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut packets);
            assert_eq!(single, packets, "{level:?}");
            assert!(single.instance.iter().filter(|&&i| i != NONE).count() > 2000);
            let (mut a, mut b) = (vec![9; 20_011], vec![9; 20_011]);
            scene.occluded(Execution::Vector(level), &rays.batch(), false, &mut a);
            scene.occluded(Execution::Vector(level), &rays.batch(), true, &mut b);
            assert_eq!(a, b, "{level:?}");
            let hit: Vec<u8> = single.instance.iter().map(|&i| u8::from(i != NONE)).collect();
            assert_eq!(a, hit, "{level:?}");
        }
    }
}

#[test]
fn rays_in_streams_find_what_single_rays_find() {
    let mut random = Random(14);
    let (scene, _) = busy_scene(&mut random, 300);
    let mut rays = OwnedRays::random(&mut random, 3001, 1.0, false);
    for i in (0..3001).step_by(7) {
        rays.direction[0][i] = f32::NAN;
    }
    // A whole run of rays that hit nothing, longer than a stream.
    rays.direction[1][100..160].fill(f32::INFINITY);
    for level in levels() {
        let (mut streamed, mut single) = (Hits::default(), Hits::default());
        scene.first_hit(Execution::Vector(level), &rays.batch(), false, &mut streamed);
        let mut blocked = vec![9; 3001];
        scene.occluded(Execution::Vector(level), &rays.batch(), false, &mut blocked);
        for (i, is_blocked) in blocked.iter().enumerate() {
            scene.first_hit(Execution::Vector(level), &rays.part(i, i + 1), false, &mut single);
            let [a, b] = [(&streamed, i), (&single, 0)]
                .map(|(hits, i)| ([hits.t[i], hits.u[i], hits.v[i]].map(f32::to_bits), hits.primitive[i], hits.instance[i]));
            assert_eq!(a, b, "ray {i}, {level:?}");
            assert_eq!(*is_blocked, u8::from(single.instance[0] != NONE), "ray {i}, {level:?}");
        }
    }
}

#[test]
fn rays_find_the_same_while_modes_are_measured_and_after() {
    let mut random = Random(15);
    let (streamed, _) = busy_scene(&mut random, 300);
    for n in [700, 2113] {
        let rays = OwnedRays::random(&mut random, n, 1.0, false);
        for level in levels() {
            let tried = Tlas { tuners: StreamTuners::default(), ..streamed.clone() };
            let known = super::first_hits(&streamed, level, &rays);
            let mut blocked = vec![9; n];
            streamed.occluded(Execution::Vector(level), &rays.batch(), false, &mut blocked);
            for turn in 0..40 {
                assert_eq!(super::first_hits(&tried, level, &rays), known, "turn {turn}, {level:?}");
                let mut found = vec![9; n];
                tried.occluded(Execution::Vector(level), &rays.batch(), false, &mut found);
                assert_eq!(found, blocked, "turn {turn}, {level:?}");
            }
        }
    }
}

#[test]
fn the_scalar_path_finds_the_same_up_to_rounding() {
    let mut random = Random(12);
    let (scene, _) = busy_scene(&mut random, 300);
    let rays = OwnedRays::random(&mut random, 20_000, 1.0, true);
    let mut scalar = Hits::default();
    scene.first_hit(Execution::Scalar, &rays.batch(), false, &mut scalar);
    let mut blocked = vec![0; 20_000];
    scene.occluded(Execution::Scalar, &rays.batch(), false, &mut blocked);
    for level in levels() {
        let single = super::first_hits(&scene, level, &rays);
        let differ =
            (0..20_000).filter(|&i| (single.instance[i], single.primitive[i]) != (scalar.instance[i], scalar.primitive[i])).count();
        assert!(differ <= 10, "{differ} of 20000 rays, {level:?}");
        let differ = (0..20_000).filter(|&i| (blocked[i] != 0) != (scalar.instance[i] != NONE)).count();
        assert_eq!(differ, 0);
    }
}

#[test]
fn passed_hits_are_all_transparent_hits_of_rays_that_no_opaque_surface_blocks() {
    let mut random = Random(13);
    let (everything, instances) = busy_scene(&mut random, 200);
    let hidden = |keep: bool| -> Vec<Instance> {
        instances.iter().map(|i| Instance { mask: if i.transparent == keep { i.mask } else { 0 }, ..*i }).collect()
    };
    let meshes = everything.meshes().to_vec();
    let (opaque, transparent) = (scene(meshes.clone(), &hidden(false)), scene(meshes, &hidden(true)));
    let rays = OwnedRays::random(&mut random, 5_000, 1.0, false);
    for level in levels() {
        let (mut expected, mut blocked, mut passed) = (vec![0; 5_000], vec![0; 5_000], Vec::new());
        opaque.occluded(Execution::Vector(level), &rays.batch(), false, &mut expected);
        everything.any_hit_transparent(Execution::Vector(level), &rays.batch(), &mut blocked, &mut passed);
        assert_eq!(blocked, expected);
        assert!(passed.iter().all(|hit| blocked[hit.ray as usize] == 0 && instances[hit.instance as usize].transparent));
        // The nearest of a ray's passed hits is its first hit on transparent instances alone.
        let first = super::first_hits(&transparent, level, &rays);
        for i in (0..5_000).filter(|&i| blocked[i] == 0) {
            let nearest = passed.iter().filter(|hit| hit.ray as usize == i).map(|hit| hit.t).fold(rays.t_max[i], f32::min);
            assert_eq!(nearest, first.t[i]);
        }
        let (mut scalar_blocked, mut scalar_passed) = (vec![0; 5_000], Vec::new());
        everything.any_hit_transparent(Execution::Scalar, &rays.batch(), &mut scalar_blocked, &mut scalar_passed);
        assert!(scalar_passed.len().abs_diff(passed.len()) <= 5);
    }
}

#[test]
fn an_edge_that_two_triangles_share_is_passed_once() {
    let positions = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let pane = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] };
    let sheets = [0.5, 0.25].map(|height| {
        let mut object_to_world = Instance::IDENTITY;
        object_to_world[2][3] = height;
        Instance { geometry: Geometry::Mesh(0), object_to_world, mask: 1, transparent: true }
    });
    let panes = scene(vec![pane.blas()], &sheets);
    let mut rays = OwnedRays::default();
    for i in 0..101 {
        // Along the diagonal, exactly.
        let along = i as f32 / 64.0 - 0.75;
        rays.push([along, along, 1.0], [0.0, 0.0, -1.0], 10.0);
    }
    for level in levels() {
        let (mut blocked, mut passed) = (vec![0; 101], Vec::new());
        panes.any_hit_transparent(Execution::Vector(level), &rays.batch(), &mut blocked, &mut passed);
        assert_eq!(passed.len(), 2 * 101);
        passed.clear();
        panes.any_hit_transparent(Execution::Scalar, &rays.batch(), &mut blocked, &mut passed);
        assert_eq!(passed.len(), 2 * 101);
    }
}
