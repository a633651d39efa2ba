//! Instances that move: every walk finds what a scene at rest at the ray's time has.

use super::agreement::random_placement;
use super::{Geometry, Hits, Instance, Mesh, OwnedRays, Random, Tlas, instance, levels};
use crate::{Blas, Care, FIRST_PIECE, LAST_PIECE, MovingInstance, NONE, RayMask, Seen, Spheres};
use fearless_simd::Level;
use gonio_simd::Execution;
use gonio_simd::motion::{Interpolation, Motion};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const TIMES: [f32; 4] = [0.0, 0.3, 0.75, 1.0];

/// Instances of which every other moves, by random keys.
fn moving_scene(random: &mut Random, interpolation: Interpolation) -> (Vec<Arc<Blas>>, Vec<Instance>, Vec<MovingInstance>) {
    let meshes: Vec<Arc<Blas>> =
        [(1, 1.0), (40, 0.5), (800, 0.2)].into_iter().map(|(n, size)| Mesh::soup(random, n, 1.0, size).blas()).collect();
    let placements: Vec<Vec<[[f64; 4]; 3]>> = (0..90).map(|i| (0..2 + i % 3).map(|_| random_placement(random)).collect()).collect();
    let place = |(i, keys): (usize, &Vec<[[f64; 4]; 3]>)| Instance {
        mask: 1 + (i % 2) as RayMask,
        transparent: i % 5 == 0,
        ..instance(Geometry::Mesh(i as u32 % 3), keys[0])
    };
    let instances: Vec<Instance> = placements.iter().enumerate().map(place).collect();
    let moves = |i: usize| MovingInstance { instance: i as u32, motion: Motion::new(&placements[i], interpolation).expect("it moves") };
    let moving = (0..instances.len()).filter(|i| i % 2 == 0).map(moves).collect();
    (meshes, instances, moving)
}

fn built(meshes: &[Arc<Blas>], instances: &[Instance], moving: &[MovingInstance]) -> Tlas {
    let scene = Tlas::build_moving(meshes.to_vec(), instances, moving, instances.len(), &AtomicBool::new(false)).expect("not cancelled");
    scene.tuners.settle(true);
    scene
}

/// The nearest hits, on which single rays, packets and streams agree.
fn hits_of_all_walks(scene: &Tlas, level: Level, rays: &OwnedRays) -> Hits {
    let single = super::first_hits(scene, level, rays);
    let (mut packets, mut stream) = (Hits::default(), Hits::default());
    scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut packets);
    scene.first_hit(Execution::Vector(level), &rays.batch(), false, &mut stream);
    assert_eq!(single, packets, "{level:?}");
    assert_eq!(single, stream, "{level:?}");
    single
}

#[test]
fn all_walks_find_what_stands_there_at_the_rays_time() {
    for interpolation in [Interpolation::Decomposed, Interpolation::Linear] {
        let mut random = Random(31);
        let (meshes, instances, moving) = moving_scene(&mut random, interpolation);
        let scene = built(&meshes, &instances, &moving);
        assert!(scene.moves());
        let mut rays = OwnedRays::random(&mut random, 4096, 1.0, true);
        rays.time = (0..4096).map(|i| TIMES[i % 4]).collect();
        for (i, mask) in rays.mask.iter_mut().enumerate() {
            *mask = 1 + (i % 3) as RayMask;
        }
        let stands = |time: f32| {
            let mut stand = instances.clone();
            moving.iter().for_each(|one| stand[one.instance as usize].object_to_world = one.motion.at(time));
            built(&meshes, &stand, &[])
        };
        let standing: Vec<Hits> = TIMES.map(|time| super::first_hits(&stands(time), levels()[0], &rays)).into();
        for level in levels() {
            let single = super::first_hits(&scene, level, &rays);
            let (mut packets, mut stream, mut scalar) = (Hits::default(), Hits::default(), Hits::default());
            scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut packets);
            scene.first_hit(Execution::Vector(level), &rays.batch(), false, &mut stream);
            scene.first_hit(Execution::Scalar, &rays.batch(), false, &mut scalar);
            assert_eq!(single, packets, "{level:?}");
            assert_eq!(single, stream, "{level:?}");
            let (mut any, mut any_packets) = (vec![9; 4096], vec![9; 4096]);
            scene.occluded(Execution::Vector(level), &rays.batch(), false, &mut any);
            scene.occluded(Execution::Vector(level), &rays.batch(), true, &mut any_packets);
            assert_eq!(any, any_packets, "{level:?}");
            let mut others = 0;
            for i in 0..4096 {
                let stand = &standing[i % 4];
                assert_eq!(any[i] == 1, single.instance[i] != NONE, "ray {i}");
                // Triangles in world space are rounded otherwise, so that a few rays along edges differ.
                let near = (stand.t[i] - single.t[i]).abs() <= 1e-4 * stand.t[i].abs().max(1.0);
                others += usize::from(stand.instance[i] != single.instance[i] || !(near || stand.instance[i] == NONE));
                others += usize::from(scalar.instance[i] != single.instance[i]);
            }
            assert!(others <= 8, "{others} rays differ, {level:?}");
            assert!(single.instance.iter().filter(|i| **i != NONE).count() > 1000);
        }
    }
}

#[test]
fn walks_within_an_instance_see_it_at_their_time() {
    let mut random = Random(5);
    let (meshes, instances, moving) = moving_scene(&mut random, Interpolation::Decomposed);
    let scene = built(&meshes, &instances, &moving);
    let mut rays = OwnedRays::random(&mut random, 512, 1.0, false);
    rays.time = vec![0.6; 512];
    let numbers: Vec<u32> = (0..512).map(|i| i % 90).collect();
    let mut stand = instances.clone();
    moving.iter().for_each(|one| stand[one.instance as usize].object_to_world = one.motion.at(0.6));
    let (mut found, mut expected) = (Hits::default(), Hits::default());
    scene.first_hit_within(Execution::Scalar, &rays.batch(), &numbers, &mut found);
    built(&meshes, &stand, &[]).first_hit_within(Execution::Scalar, &rays.batch(), &numbers, &mut expected);
    assert_eq!(found, expected);
    assert!(found.instance.iter().any(|instance| *instance != NONE));
}

#[test]
fn curves_and_points_that_move_are_met_as_they_are_at_the_rays_time() {
    let (mut random, cancel) = (Random(31), AtomicBool::new(false));
    let ball = |random: &mut Random| [random.signed(), random.signed(), random.signed(), 0.02 + 0.03 * random.unit()];
    let rest: Vec<[f32; 4]> = (0..400).map(|_| ball(&mut random)).collect();
    let moved = |random: &mut Random| -> Vec<[f32; 4]> {
        rest.iter().map(|p| [0, 1, 2, 3].map(|k| p[k] + if k < 3 { 0.2 * random.signed() } else { 0.0 })).collect()
    };
    let keys: Vec<Vec<[f32; 4]>> = vec![rest.clone(), moved(&mut random), moved(&mut random)];
    // Strands of four points.
    let bits = |i: u32| if i.is_multiple_of(4) { FIRST_PIECE } else { 0 } | if i % 4 == 2 { LAST_PIECE } else { 0 };
    let pieces: Vec<u32> = (0..400).filter(|i| i % 4 < 3).map(|i| i | bits(i)).collect();
    let mut rays = OwnedRays::random(&mut random, 2048, 1.0, true);
    rays.time = (0..2048).map(|i| TIMES[i % 4]).collect();
    let at = |time: f32| -> Vec<[f32; 4]> {
        let (number, share) = if time < 0.5 { (0, 2.0 * time) } else { (1, 2.0 * time - 1.0) };
        keys[number].iter().zip(&keys[number + 1]).map(|(a, b)| [0, 1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * share)).collect()
    };
    let instances: Vec<Instance> = (0..20).map(|_| instance(Geometry::Mesh(0), random_placement(&mut random))).collect();
    for (is_curve, seen) in [(true, Seen::Solid), (true, Seen::Facing), (false, Seen::Solid), (false, Seen::Facing)] {
        let tree = match is_curve {
            true => Blas::of_moving_curves(keys.clone(), &pieces, seen, Care::Quick, &cancel),
            false => Blas::of_moving_points(keys.clone(), seen, Care::Quick, &cancel),
        };
        let scene = built(&[Arc::new(tree.expect("not cancelled"))], &instances, &[]);
        assert!(scene.moves());
        let stands = |time: f32| {
            let tree = match is_curve {
                true => Blas::of_curves(Spheres::Together(&at(time)), &pieces, seen, Care::Quick, &cancel),
                false => Blas::of_points(Spheres::Together(&at(time)), seen, Care::Quick, &cancel),
            };
            built(&[Arc::new(tree.expect("not cancelled"))], &instances, &[])
        };
        let standing: Vec<Hits> = TIMES.map(|time| super::first_hits(&stands(time), levels()[0], &rays)).into();
        for level in levels() {
            let single = hits_of_all_walks(&scene, level, &rays);
            let differs =
                |i: &usize| standing[i % 4].instance[*i] != single.instance[*i] || standing[i % 4].primitive[*i] != single.primitive[*i];
            let others = (0..2048).filter(differs).count();
            assert!(others <= 2, "{others} rays differ, {is_curve} {seen:?} {level:?}");
            assert!(single.instance.iter().filter(|i| **i != NONE).count() > 40);
        }
    }
}

#[test]
fn meshes_that_deform_are_met_as_they_are_at_the_rays_time() {
    let mut random = Random(77);
    let mesh = Mesh::soup(&mut random, 700, 1.0, 0.2);
    let moved = |random: &mut Random| mesh.positions.iter().map(|p| [0, 1, 2].map(|k| p[k] + 0.3 * random.signed())).collect::<Vec<_>>();
    let keys = [mesh.positions.clone(), moved(&mut random), moved(&mut random)];
    let slices: Vec<&[[f32; 3]]> = keys.iter().map(Vec::as_slice).collect();
    let tree = Blas::build_deforming(&slices, &mesh.triangles, Care::Quick, &AtomicBool::new(false)).expect("not cancelled");
    assert!(!tree.is_still() && tree.refit(&mesh.positions, &mesh.triangles).is_none());
    let instances: Vec<Instance> = (0..60).map(|_| instance(Geometry::Mesh(0), random_placement(&mut random))).collect();
    let scene = built(&[Arc::new(tree)], &instances, &[]);
    assert!(scene.moves());
    let mut rays = OwnedRays::random(&mut random, 2048, 1.0, true);
    rays.time = (0..2048).map(|i| TIMES[i % 4]).collect();
    let stands = |time: f32| {
        let (number, share) = if time < 0.5 { (0, 2.0 * time) } else { (1, 2.0 * time - 1.0) };
        let between = |(a, b): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * share);
        let positions = keys[number].iter().zip(&keys[number + 1]).map(between).collect();
        built(&[Mesh { positions, triangles: mesh.triangles.clone() }.blas()], &instances, &[])
    };
    let standing: Vec<Hits> = TIMES.map(|time| super::first_hits(&stands(time), levels()[0], &rays)).into();
    for level in levels() {
        let single = hits_of_all_walks(&scene, level, &rays);
        let mut any = vec![9; 2048];
        scene.occluded(Execution::Vector(level), &rays.batch(), true, &mut any);
        let differs =
            |i: &usize| standing[i % 4].instance[*i] != single.instance[*i] || standing[i % 4].primitive[*i] != single.primitive[*i];
        assert_eq!((0..2048).filter(differs).count(), 0, "{level:?}");
        assert!((0..2048).all(|i| (any[i] == 1) == (single.instance[i] != NONE)));
        assert!(single.instance.iter().filter(|i| **i != NONE).count() > 40);
    }
}
