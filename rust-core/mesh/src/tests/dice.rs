//! Dicing: no cracks, no edge too long, curves near the surface.

use crate::{DiceLimits, Diced, Undiced, dice};
use std::collections::HashMap;

const MANY: DiceLimits = DiceLimits { levels: 12, triangles: 1 << 20 };

/// An octahedron on the unit sphere, its points there once for each triangle, as along seams.
fn octahedron() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let mut points = Vec::new();
    for (x, y, z) in (0..8).map(|n| ((n & 1) as f32, (n >> 1 & 1) as f32, (n >> 2) as f32)) {
        let [x, y, z] = [1.0 - 2.0 * x, 1.0 - 2.0 * y, 1.0 - 2.0 * z];
        let corners = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        points.extend(if x * y * z > 0.0 { corners } else { [corners[0], corners[2], corners[1]] });
    }
    let triangles = (0..8).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    (points, triangles)
}

fn distance(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f32>().sqrt()
}

/// Every edge has one triangle on each side, by the places of its ends.
fn is_closed(diced: &Diced) -> bool {
    let bits = |point: u32| diced.points[point as usize].map(|x| (x + 0.0).to_bits());
    let mut edges: HashMap<_, i32> = HashMap::new();
    for triangle in &diced.triangles {
        for k in 0..3 {
            let [a, b] = [bits(triangle.points[k]), bits(triangle.points[(k + 1) % 3])];
            *edges.entry(if a < b { (a, b) } else { (b, a) }).or_default() += if a < b { 1 } else { -1 };
        }
    }
    edges.values().all(|sum| *sum == 0)
}

#[test]
fn a_diced_sphere_is_closed_and_round_at_any_rates() {
    let (points, triangles) = octahedron();
    let normals: Vec<[f32; 3]> = triangles.iter().flatten().map(|point| points[*point as usize]).collect();
    let mesh = Undiced { points: &points, triangles: &triangles, normals: &normals, smooth: true };
    // Finer towards one side, so that neighbours differ.
    let rate = |a: &[f32; 3], b: &[f32; 3]| distance(a, b) / (0.05 + 0.1 * (1.0 - a[0].max(b[0])));
    let diced = dice(&mesh, MANY, &rate);
    assert!(diced.triangles.len() > 1000 && !diced.is_cut_short && is_closed(&diced));
    for triangle in &diced.triangles {
        for k in 0..3 {
            let [a, b] = [triangle.points[k], triangle.points[(k + 1) % 3]].map(|point| diced.points[point as usize]);
            assert!(distance(&a, &b) / (0.05 + 0.1 * (1.0 - a[0].max(b[0]))) <= 1.0);
            let along = distance(&triangle.normals[k], &a);
            assert!(along < 0.2, "{:?} at {a:?}", triangle.normals[k]);
        }
    }
    let radii = diced.points.iter().map(|point| distance(point, &[0.0; 3]));
    assert!(radii.clone().fold(2.0, f32::min) > 0.85 && radii.fold(0.0, f32::max) < 1.03);
}

#[test]
fn what_is_flat_stays_flat_and_creases_stay_straight() {
    let (points, triangles) = octahedron();
    let mesh = Undiced { points: &points, triangles: &triangles, normals: &[], smooth: true };
    let diced = dice(&mesh, MANY, &|a, b| distance(a, b) / 0.1);
    assert!(is_closed(&diced) && diced.points.iter().all(|p| (p.iter().map(|x| x.abs()).sum::<f32>() - 1.0).abs() < 1e-6));
    // Normals of the triangles themselves: no edge bends.
    let facets: Vec<[f32; 3]> =
        triangles.iter().flat_map(|t| [[0, 1, 2].map(|k| t.map(|p| points[p as usize][k]).iter().sum()); 3]).collect();
    let diced = dice(&Undiced { normals: &facets, ..mesh }, MANY, &|a, b| distance(a, b) / 0.1);
    assert!(diced.points.iter().all(|p| (p.iter().map(|x| x.abs()).sum::<f32>() - 1.0).abs() < 1e-5));
}

#[test]
fn places_and_parents_say_where_corners_come_from() {
    let (points, triangles) = octahedron();
    let mesh = Undiced { points: &points, triangles: &triangles, normals: &[], smooth: false };
    let diced = dice(&mesh, DiceLimits { levels: 2, ..MANY }, &|a, b| distance(a, b) / 0.1);
    assert_eq!(diced.triangles.len(), 8 * 16);
    assert_eq!(diced.points.len(), points.len() + diced.parents.len());
    for triangle in &diced.triangles {
        let corners = triangles[triangle.source as usize].map(|point| points[point as usize]);
        for k in 0..3 {
            let [u, v] = triangle.places[k];
            let expected = [0, 1, 2].map(|axis| corners[0][axis] * (1.0 - u - v) + corners[1][axis] * u + corners[2][axis] * v);
            assert!(distance(&expected, &diced.points[triangle.points[k] as usize]) < 1e-6);
        }
    }
}

#[test]
fn dicing_ends_at_its_limits_and_bad_numbers_do_no_harm() {
    let (mut points, triangles) = octahedron();
    let limits = DiceLimits { levels: 30, triangles: 1000 };
    let mesh = Undiced { points: &points, triangles: &triangles, normals: &[], smooth: true };
    let diced = dice(&mesh, limits, &|_, _| f32::INFINITY);
    assert!(diced.is_cut_short && diced.triangles.len() <= 1000);
    assert_eq!(dice(&mesh, limits, &|_, _| f32::NAN).triangles.len(), 8);
    points[0] = [f32::NAN, f32::INFINITY, 0.0];
    points[3] = points[4];
    let mesh = Undiced { points: &points, triangles: &triangles, normals: &[], smooth: true };
    let diced = dice(&mesh, limits, &|a, b| distance(a, b) / 0.5);
    assert!(diced.triangles.len() >= 8);
}

#[test]
fn without_curves_normals_are_even_between_those_of_the_triangle() {
    let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let normals = [[-0.8, 0.0, 0.6], [0.8, 0.0, 0.6], [0.0, 0.6, 0.8]];
    let mesh = Undiced { points: &points, triangles: &[[0, 1, 2]], normals: &normals, smooth: false };
    let diced = dice(&mesh, MANY, &|a, b| distance(a, b) / 0.3);
    assert!(diced.triangles.len() > 100);
    for triangle in &diced.triangles {
        for (normal, [u, v]) in triangle.normals.iter().zip(triangle.places) {
            let between = [0, 1, 2].map(|k| (1.0 - u - v) * normals[0][k] + u * normals[1][k] + v * normals[2][k]);
            assert!(distance(normal, &between) < 1e-6, "{normal:?} at {u}, {v}");
        }
    }
}
