//! Curves and points against an oracle in f64, and all traversals against each other.

use super::{Geometry, Instance, OwnedRays, Random, agreement::random_placement, first_hits, instance, levels, scene};
use crate::{Blas, Care, FIRST_PIECE, Hits, LAST_PIECE, NONE, Seen, Spheres, Tlas};
use gonio_simd::Execution;
use std::sync::{Arc, atomic::AtomicBool};

type Point = [f64; 3];

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn along(a: Point, b: Point, s: f64) -> Point {
    [0, 1, 2].map(|k| a[k] + s * b[k])
}

/// Strands of a few pieces each that wander, with radii that change.
fn strands(random: &mut Random, n: usize, pieces: usize, radius: f32) -> (Vec<[f32; 4]>, Vec<u32>) {
    let (mut points, mut entries) = (Vec::new(), Vec::new());
    for _ in 0..n {
        let (mut at, first) = (random.point(), points.len() as u32);
        let mut way = random.point();
        for i in 0..=pieces {
            points.push([at[0], at[1], at[2], radius * (0.3 + random.unit())]);
            if i < pieces {
                let bits = if i == 0 { FIRST_PIECE } else { 0 } | if i + 1 == pieces { LAST_PIECE } else { 0 };
                entries.push((first + i as u32) | bits);
            }
            let turn = random.point();
            way = [0, 1, 2].map(|k| 0.8 * way[k] + 0.4 * turn[k]);
            at = [0, 1, 2].map(|k| at[k] + 0.2 * way[k]);
        }
    }
    (points, entries)
}

fn curves(points: &[[f32; 4]], entries: &[u32], seen: Seen) -> Arc<Blas> {
    Arc::new(Blas::of_curves(Spheres::Together(points), entries, seen, Care::Quick, &AtomicBool::new(false)).expect("not cancelled"))
}

fn balls(points: &[[f32; 4]], seen: Seen) -> Arc<Blas> {
    Arc::new(Blas::of_points(Spheres::Together(points), seen, Care::Quick, &AtomicBool::new(false)).expect("not cancelled"))
}

fn alone(tree: Arc<Blas>) -> Tlas {
    scene(vec![tree], &[instance(Geometry::Mesh(0), Instance::IDENTITY)])
}

/// How far a point lies outside a rounded cone: distances to the spheres along the axis, the least of them by golden section.
fn outside(p: Point, a: [f32; 4], b: [f32; 4]) -> f64 {
    let [(ca, ra), (cb, rb)] = [a, b].map(|e| ([0, 1, 2].map(|k| f64::from(e[k])), f64::from(e[3])));
    let axis = along(cb, ca, -1.0);
    let off = |s: f64| {
        let to = along(p, along(ca, axis, s), -1.0);
        dot(to, to).sqrt() - (ra + s * (rb - ra))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (x, y) = (low + 0.381_966 * (high - low), high - 0.381_966 * (high - low));
        if off(x) < off(y) { high = y } else { low = x }
    }
    off(0.5 * (low + high))
}

/// Where a ray first enters any of the rounded cones, by sphere tracing in f64; the ray starts outside.
fn entry(o: Point, d: Point, t_max: f64, points: &[[f32; 4]], entries: &[u32]) -> Option<f64> {
    let length = dot(d, d).sqrt();
    let mut t = 0.0;
    for _ in 0..4000 {
        let p = along(o, d, t);
        let firsts = entries.iter().map(|entry| (entry & !(FIRST_PIECE | LAST_PIECE)) as usize);
        let off = firsts.map(|first| outside(p, points[first], points[first + 1])).fold(f64::INFINITY, f64::min);
        if off < 1e-9 {
            return Some(t);
        }
        t += off / length;
        if t > t_max.min(20.0) {
            return None;
        }
    }
    None
}

#[test]
fn round_curves_match_the_oracle() {
    let mut random = Random(31);
    for (n, pieces, radius) in [(1, 1, 0.2), (3, 4, 0.05), (4, 6, 0.01)] {
        let (points, entries) = strands(&mut random, n, pieces, radius);
        let tree = alone(curves(&points, &entries, Seen::Solid));
        let mut rays = OwnedRays::default();
        for i in 0..600 {
            // Aimed at the strands, from outside of them.
            let target = points[i % points.len()];
            let origin = random.point().map(|x| 4.0 * x + 3.0f32.copysign(x));
            let spread = random.point().map(|x| 2.0 * radius * x);
            rays.push(origin, [0, 1, 2].map(|k| target[k] + spread[k] - origin[k]), f32::INFINITY);
        }
        let mut scalar = Hits::default();
        tree.first_hit(Execution::Scalar, &rays.batch(), false, &mut scalar);
        let all = levels().into_iter().map(|level| first_hits(&tree, level, &rays)).chain([scalar]);
        for hits in all {
            let (mut wrong, mut found) = (0, 0);
            for i in 0..600 {
                let (o, d, t_max) = super::oracle::ray(&rays, i);
                let expected = entry(o, d, t_max, &points, &entries);
                found += usize::from(expected.is_some());
                wrong += usize::from(match expected {
                    None => hits.instance[i] != NONE,
                    Some(t) => hits.instance[i] == NONE || (f64::from(hits.t[i]) - t).abs() * dot(d, d).sqrt() > 0.02 * f64::from(radius),
                });
            }
            assert!(found > 150, "{found}");
            assert!(wrong <= 4, "{wrong} of 600 rays differ, {n} strands of {pieces} pieces");
        }
    }
}

#[test]
fn spheres_discs_and_ribbons_match_the_oracle() {
    let mut random = Random(32);
    let points: Vec<[f32; 4]> = (0..60).map(|_| (random.point(), random.unit())).map(|([x, y, z], r)| [x, y, z, 0.02 + 0.1 * r]).collect();
    let (joints, entries) = strands(&mut random, 30, 1, 0.05);
    let rays = OwnedRays::random(&mut random, 4000, 1.0, true);
    let scenes = [alone(balls(&points, Seen::Solid)), alone(balls(&points, Seen::Facing)), alone(curves(&joints, &entries, Seen::Facing))];
    for (kind, tree) in scenes.iter().enumerate() {
        let mut scalar = Hits::default();
        tree.first_hit(Execution::Scalar, &rays.batch(), false, &mut scalar);
        for hits in levels().into_iter().map(|level| first_hits(tree, level, &rays)).chain([scalar]) {
            let (mut wrong, mut found) = (0, 0);
            for i in 0..4000 {
                let (o, d, t_max) = super::oracle::ray(&rays, i);
                let distances: Vec<f64> = match kind {
                    2 => entries.iter().filter_map(|e| ribbon(o, d, &joints[(e & 0xffff) as usize..][..2])).collect(),
                    _ => points.iter().filter_map(|p| ball(o, d, *p, kind == 1)).collect(),
                };
                let nearest = distances.into_iter().filter(|t| *t > 0.0 && *t <= t_max).fold(f64::INFINITY, f64::min);
                found += usize::from(nearest.is_finite());
                let agrees = if hits.instance[i] == NONE { nearest.is_infinite() } else { (f64::from(hits.t[i]) - nearest).abs() < 1e-3 };
                wrong += usize::from(!agrees);
            }
            assert!(found > 200, "{found}");
            assert!(wrong <= 6, "{wrong} of 4000 rays differ, kind {kind}");
        }
    }
}

/// The distance to a ball, or to a disc that faces the ray beyond twice its radius.
fn ball(o: Point, d: Point, [x, y, z, r]: [f32; 4], disc: bool) -> Option<f64> {
    let (centre, r) = ([x, y, z].map(f64::from), f64::from(r));
    let to = along(centre, o, -1.0);
    let foot = dot(to, d) / dot(d, d);
    let off = along(to, d, -foot);
    let half = (r * r - dot(off, off)) / dot(d, d);
    let t = if disc { foot } else { foot - half.max(0.0).sqrt() };
    (half >= 0.0 && (!disc || t * dot(d, d).sqrt() > 2.0 * r)).then_some(t)
}

/// The distance to a ribbon of one piece that faces the ray.
fn ribbon(o: Point, d: Point, ends: &[[f32; 4]]) -> Option<f64> {
    let [a, b] = [0, 1].map(|i| [0, 1, 2].map(|k| f64::from(ends[i][k])));
    let axis = along(b, a, -1.0);
    let flat = |v: Point| along(v, d, -dot(v, d) / dot(d, d));
    let (to, across) = (along(a, o, -1.0), flat(axis));
    let share = -dot(flat(to), across) / dot(across, across);
    let r = f64::from(ends[0][3]) + share * (f64::from(ends[1][3]) - f64::from(ends[0][3]));
    let off = along(flat(to), across, share);
    let t = dot(along(to, axis, share), d) / dot(d, d);
    ((0.0..=1.0).contains(&share) && dot(off, off) <= r * r && t * dot(d, d).sqrt() > 2.0 * r).then_some(t)
}

/// Thousands of rays into the joints of a bent tube: none passes.
#[test]
fn joints_are_tight() {
    let mut random = Random(33);
    for radius in [0.05, 1e-3] {
        let points: Vec<[f32; 4]> = (0..40)
            .map(|i| i as f32 * 0.3)
            .map(|s| [s.sin() * 0.5, s.cos() * 0.5, 0.02 * s, radius * (1.0 + 0.3 * (3.0 * s).sin())])
            .collect();
        let bits = |i: u32| if i == 0 { FIRST_PIECE } else { 0 } | if i == 38 { LAST_PIECE } else { 0 };
        let entries: Vec<u32> = (0..39).map(|i| i | bits(i)).collect();
        let tree = alone(curves(&points, &entries, Seen::Solid));
        let mut rays = OwnedRays::default();
        for i in 0..8000 {
            let joint = points[1 + i % 38];
            let origin = random.point().map(|x| 2.0 * x + 1.5f32.copysign(x));
            let inside = random.point().map(|x| 0.4 * radius * x);
            rays.push(origin, [0, 1, 2].map(|k| joint[k] + inside[k] - origin[k]), f32::INFINITY);
        }
        for level in levels() {
            assert!(first_hits(&tree, level, &rays).instance.iter().all(|i| *i != NONE), "{level:?}, radius {radius}");
        }
        let mut scalar = Hits::default();
        tree.first_hit(Execution::Scalar, &rays.batch(), false, &mut scalar);
        assert!(scalar.instance.iter().all(|i| *i != NONE));
    }
}

/// Curves, points and triangles in instances: packets, streams, single rays and shadow rays agree bit for bit.
#[test]
fn all_traversals_agree_on_curves_and_points() {
    let mut random = Random(34);
    let (points, entries) = strands(&mut random, 200, 5, 0.03);
    let cloud: Vec<[f32; 4]> = (0..500).map(|_| (random.point(), random.unit())).map(|([x, y, z], r)| [x, y, z, 0.05 * r]).collect();
    let trees = vec![
        curves(&points, &entries, Seen::Solid),
        curves(&points, &entries, Seen::Facing),
        balls(&cloud, Seen::Solid),
        balls(&cloud, Seen::Facing),
        super::Mesh::soup(&mut random, 100, 1.0, 0.3).blas(),
    ];
    let instances: Vec<Instance> = (0..60)
        .map(|i| {
            let placed = if i < 5 { Instance::IDENTITY } else { random_placement(&mut random) };
            let shifted = [[1.0, 0.0, 0.0, 0.3], [0.0, 1.0, 0.0, -0.2], [0.0, 0.0, 1.0, 0.1]];
            let object_to_world = if (5..10).contains(&i) { shifted } else { placed };
            Instance { geometry: Geometry::Mesh(i % 5), object_to_world, mask: 1, transparent: i % 3 == 0 }
        })
        .collect();
    let tree = scene(trees, &instances);
    let n = 6000;
    for coherent in [true, false] {
        let rays = OwnedRays::random(&mut random, n, 1.0, coherent);
        for level in levels() {
            let bits = |hits: &Hits, i: usize| ([hits.t[i], hits.u[i], hits.v[i]].map(f32::to_bits), hits.primitive[i], hits.instance[i]);
            let streamed = first_hits(&tree, level, &rays);
            let (mut packets, mut single) = (Hits::default(), Hits::default());
            tree.first_hit(Execution::Vector(level), &rays.batch(), true, &mut packets);
            let (mut a, mut b) = (vec![9; n], vec![9; n]);
            tree.occluded(Execution::Vector(level), &rays.batch(), false, &mut a);
            tree.occluded(Execution::Vector(level), &rays.batch(), true, &mut b);
            for i in 0..n {
                tree.first_hit(Execution::Vector(level), &rays.part(i, i + 1), false, &mut single);
                assert_eq!(bits(&streamed, i), bits(&single, 0), "ray {i}, {level:?}");
                assert_eq!(bits(&streamed, i), bits(&packets, i), "ray {i}, {level:?}");
                let hit = u8::from(streamed.instance[i] != NONE);
                assert_eq!([a[i], b[i]], [hit, hit], "ray {i}, {level:?}");
            }
            assert!(streamed.instance.iter().filter(|i| **i != NONE).count() > n / 3);
        }
    }
}

#[test]
fn what_makes_no_sense_is_left_out() {
    let nan = f32::NAN;
    let points = [[0.0, 0.0, 0.0, 0.1], [1.0, 0.0, 0.0, nan], [nan, 0.0, 0.0, 0.1], [0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]];
    let entries = [0, 1, 2, 3, 4, 77].map(|i| i | FIRST_PIECE | LAST_PIECE);
    for seen in [Seen::Solid, Seen::Facing] {
        assert_eq!(curves(&points, &entries, seen).memory().triangles, 0);
        assert_eq!(balls(&points, seen).memory().triangles, 1);
    }
    // A piece without a length is a ball.
    let tree = alone(curves(&[[0.0, 0.0, 0.0, 0.5], [0.0, 0.0, 0.0, 0.5]], &[FIRST_PIECE | LAST_PIECE], Seen::Solid));
    let mut rays = OwnedRays::default();
    rays.push([0.0, 0.0, 2.0], [0.0, 0.0, -1.0], 10.0);
    for level in levels() {
        assert_eq!(first_hits(&tree, level, &rays).t, [1.5]);
    }
}

#[test]
fn curves_and_points_take_little_memory() {
    let mut random = Random(35);
    let (points, entries) = strands(&mut random, 10_000, 10, 1e-3);
    let memory = curves(&points, &entries, Seen::Solid).memory();
    assert_eq!(memory.triangles, 100_000);
    let bytes = memory.bytes() as f64 / memory.triangles as f64;
    assert!(bytes < 160.0, "{bytes}");
    let cloud: Vec<[f32; 4]> = (0..100_000).map(|_| random.point()).map(|[x, y, z]| [x, y, z, 1e-3]).collect();
    let memory = balls(&cloud, Seen::Solid).memory();
    let bytes = memory.bytes() as f64 / memory.triangles as f64;
    assert!(bytes < 90.0, "{bytes}");
}
