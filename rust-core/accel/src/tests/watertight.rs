//! Closed meshes have no gaps: rays from inside, aimed exactly at edges and vertices.

use super::{Hits, Mesh, OwnedRays, Random, levels};
use crate::NONE;
use gonio_simd::Execution;
use std::collections::HashMap;

/// An octahedron with every triangle cut in four, `levels` times, its points on the unit sphere.
fn ball(levels: usize) -> Mesh {
    let mut mesh = Mesh {
        positions: vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]],
        triangles: vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
    };
    for _ in 0..levels {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut cut = Vec::with_capacity(4 * mesh.triangles.len());
        for &[a, b, c] in &mesh.triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(i, j)| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    let (p, q) = (mesh.positions[i as usize], mesh.positions[j as usize]);
                    let sum = [0, 1, 2].map(|axis| p[axis] + q[axis]);
                    let length = sum.iter().map(|x| x * x).sum::<f32>().sqrt();
                    mesh.positions.push(sum.map(|x| x / length));
                    mesh.positions.len() as u32 - 1
                })
            });
            cut.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        mesh.triangles = cut;
    }
    mesh
}

/// Rays from inside at vertices, edge midpoints and other points of edges, until there are `n`.
fn rays_at_edges(mesh: &Mesh, random: &mut Random, n: usize, spread: f32) -> OwnedRays {
    let mut rays = OwnedRays::default();
    let mut count = 0;
    while count < n {
        let triangle = mesh.triangles[(random.unit() * mesh.triangles.len() as f32) as usize % mesh.triangles.len()];
        let [a, b] = [triangle[0], triangle[1 + count % 2]].map(|i| mesh.positions[i as usize]);
        let s = [0.0, 0.5, random.unit()][count % 3];
        let target = [0, 1, 2].map(|axis| a[axis] + s * (b[axis] - a[axis]));
        // Some origins share coordinates with the target, so that directions have zeros.
        let mut origin = if count % 7 == 0 { [0.0; 3] } else { random.point().map(|x| spread * x) };
        if count % 5 == 0 {
            origin[count % 3] = spread * target[count % 3];
        }
        rays.push(origin, [0, 1, 2].map(|axis| target[axis] - origin[axis]), f32::INFINITY);
        count += 1;
    }
    rays
}

fn leaks(hits: &Hits) -> usize {
    hits.instance.iter().filter(|&&i| i == NONE).count()
}

#[test]
fn trees_take_little_memory() {
    let memory = ball(6).blas().memory();
    let bytes = memory.bytes() as f64 / memory.triangles as f64;
    assert!(bytes < 90.0, "{bytes} bytes a triangle");
}

#[test]
fn no_ray_slips_through_a_closed_mesh() {
    let mut random = Random(31);
    for (subdivisions, scale, shift) in [(2, 1.0, 0.0), (5, 1.0, 0.0), (6, 1e-3, 0.0), (4, 100.0, 1e4)] {
        let mut mesh = ball(subdivisions);
        let rays = {
            let mut rays = rays_at_edges(&mesh, &mut random, 256_000, 0.5);
            for axis in 0..3 {
                rays.origin[axis].iter_mut().for_each(|x| *x = *x * scale + shift);
                rays.direction[axis].iter_mut().for_each(|x| *x *= scale);
            }
            mesh.positions.iter_mut().flatten().for_each(|x| *x = *x * scale + shift);
            rays
        };
        let scene = mesh.scene();
        for level in levels() {
            let mut hits = super::first_hits(&scene, level, &rays);
            assert_eq!(leaks(&hits), 0, "single, {subdivisions} subdivisions, scale {scale}, {level:?}");
            scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut hits);
            assert_eq!(leaks(&hits), 0, "packets, {subdivisions} subdivisions, scale {scale}, {level:?}");
        }
        let mut hits = Hits::default();
        scene.first_hit(Execution::Scalar, &rays.batch(), false, &mut hits);
        assert_eq!(leaks(&hits), 0, "scalar, {subdivisions} subdivisions, scale {scale}");
    }
}

/// A flat grid shot straight down at its edges and vertices, where direction components are exactly zero.
#[test]
fn grids_have_no_gaps_for_axis_parallel_rays() {
    for axis in 0..3 {
        let n = 40u32;
        let place = |x: f32, y: f32, z: f32| {
            let mut p = [0.0; 3];
            (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (z, x, y);
            p
        };
        let mut mesh = Mesh::default();
        for i in 0..=n {
            for j in 0..=n {
                mesh.positions.push(place(i as f32 * 0.1, j as f32 * 0.3, 0.7));
            }
        }
        for i in 0..n {
            for j in 0..n {
                let k = i * (n + 1) + j;
                mesh.triangles.extend([[k, k + 1, k + n + 1], [k + 1, k + n + 2, k + n + 1]]);
            }
        }
        let scene = mesh.scene();
        let mut rays = OwnedRays::default();
        for i in 0..=2 * n {
            for j in 0..=2 * n {
                let (x, y) = (i as f32 * 0.05, j as f32 * 0.15);
                let inside = |v: f32, step: f32| v.min(n as f32 * step);
                rays.push(place(inside(x, 0.1), inside(y, 0.3), 2.0), place(0.0, 0.0, -1.0), f32::INFINITY);
                rays.push(place(inside(x, 0.1), inside(y, 0.3), -2.0), place(-0.0, 0.0, 1.0), f32::INFINITY);
            }
        }
        for level in levels() {
            let mut hits = super::first_hits(&scene, level, &rays);
            assert_eq!(leaks(&hits), 0, "single, axis {axis}, {level:?}");
            scene.first_hit(Execution::Vector(level), &rays.batch(), true, &mut hits);
            assert_eq!(leaks(&hits), 0, "packets, axis {axis}, {level:?}");
        }
    }
}
