//! The nearest hit by brute force in f64 (Cramer's rule), and comparisons with it.

use super::{Hits, Mesh, OwnedRays};
use crate::NONE;
use gonio_simd::Execution;

/// The nearest hit: distance, triangle, and how far inside its triangle it is (the least barycentric coordinate).
#[derive(Clone, Copy, Debug)]
pub(super) struct OracleHit {
    pub(super) t: f64,
    pub(super) primitive: u32,
    pub(super) margin: f64,
    pub(super) uv: [f64; 2],
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Crossing of a ray with a triangle's plane: distance and the coordinates of vertices 1 and 2.
pub(super) fn crossing(o: [f64; 3], d: [f64; 3], corners: [[f64; 3]; 3]) -> Option<(f64, f64, f64)> {
    let (e1, e2) = (sub(corners[1], corners[0]), sub(corners[2], corners[0]));
    let p = cross(d, e2);
    let determinant = dot(e1, p);
    if determinant == 0.0 {
        return None;
    }
    let s = sub(o, corners[0]);
    let q = cross(s, e1);
    Some((dot(e2, q) / determinant, dot(s, p) / determinant, dot(d, q) / determinant))
}

pub(super) fn nearest(mesh: &Mesh, o: [f64; 3], d: [f64; 3], t_max: f64) -> Option<OracleHit> {
    let mut best: Option<OracleHit> = None;
    for (primitive, triangle) in mesh.triangles.iter().enumerate() {
        let corners = triangle.map(|i| mesh.positions[i as usize].map(f64::from));
        let Some((t, u, v)) = crossing(o, d, corners) else { continue };
        let margin = u.min(v).min(1.0 - u - v);
        if margin >= 0.0 && t > 0.0 && t <= t_max && best.is_none_or(|b| t < b.t) {
            best = Some(OracleHit { t, primitive: primitive as u32, margin, uv: [u, v] });
        }
    }
    best
}

pub(super) fn ray(rays: &OwnedRays, i: usize) -> ([f64; 3], [f64; 3], f64) {
    let pick = |v: &[Vec<f32>; 3]| [0, 1, 2].map(|axis| f64::from(v[axis][i]));
    (pick(&rays.origin), pick(&rays.direction), f64::from(rays.t_max[i]))
}

/// Counts the rays whose hit differs from the oracle's by more than rounding can explain.
pub(super) fn disagreements(mesh: &Mesh, rays: &OwnedRays, hits: &Hits) -> usize {
    let mut wrong = 0;
    for i in 0..rays.t_max.len() {
        let (o, d, t_max) = ray(rays, i);
        let close = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * (1.0 + b.abs());
        let agrees = match nearest(mesh, o, d, t_max) {
            None => hits.instance[i] == NONE,
            Some(hit) if hits.instance[i] == NONE => hit.margin < 1e-4,
            Some(hit) => {
                let same = hits.primitive[i] == hit.primitive;
                let uv = close(f64::from(hits.u[i]), hit.uv[0], 1e-3) && close(f64::from(hits.v[i]), hit.uv[1], 1e-3);
                close(f64::from(hits.t[i]), hit.t, 1e-4) && (!same || uv)
            }
        };
        wrong += usize::from(!agrees);
    }
    wrong
}

/// The oracle and every path of execution agree up to rays along edges: at most one ray in two thousand.
#[test]
fn soups_match_the_oracle() {
    let mut random = super::Random(7);
    for (n, size, scale) in [(1, 1.0, 1.0), (7, 1.0, 1.0), (100, 0.5, 1.0), (1000, 0.2, 1.0), (1000, 0.2, 1e5), (1000, 0.2, 1e-3)] {
        let mesh = Mesh::soup(&mut random, n, scale, size);
        let scene = mesh.scene();
        let rays = OwnedRays::random(&mut random, 4000, scale, true);
        for level in super::levels() {
            let wrong = disagreements(&mesh, &rays, &super::first_hits(&scene, level, &rays));
            assert!(wrong <= 2, "{wrong} of 4000 rays differ, {n} triangles, scale {scale}, {level:?}");
        }
        let mut hits = Hits::default();
        scene.first_hit(Execution::Scalar, &rays.batch(), false, &mut hits);
        assert!(disagreements(&mesh, &rays, &hits) <= 2);
    }
}
