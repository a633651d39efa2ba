//! Steps to the next pixel, and what changes over them.

use super::harness::{COLUMNS, POINTS, TRIANGLES, close, dot, leaf, st, three, triple};
use crate::graph::CHUNK;
use gonio_simd::Execution;
use serde_json::json;

/// Edges of a triangle in the world.
fn edges(triangle: usize) -> [[f64; 3]; 2] {
    let corners = TRIANGLES[triangle].map(|point| POINTS[point as usize].map(f64::from));
    [1, 2].map(|corner| {
        let edge = [0, 1, 2].map(|k| corners[corner][k] - corners[0][k]);
        [0, 1, 2].map(|k| (0..3).map(|axis| COLUMNS[axis][k] * edge[axis]).sum())
    })
}

/// How the barycentric coordinates of corners 1 and 2 change along a vector in the triangle's plane, by the normal equations.
fn barycentric_change(triangle: usize, v: [f64; 3]) -> [f64; 2] {
    let [e, f] = edges(triangle);
    let (ee, ef, ff, ev, fv) = (dot(e, e), dot(e, f), dot(f, f), dot(e, v), dot(f, v));
    let determinant = ee * ff - ef * ef;
    [(ev * ff - fv * ef) / determinant, (fv * ee - ev * ef) / determinant]
}

/// How the texture coordinates change along a vector.
pub(super) fn uv_change(triangle: usize, v: [f64; 3]) -> [f64; 2] {
    let corners = [0, 1, 2].map(|corner| st(triangle, corner).map(f64::from));
    let [a, b] = barycentric_change(triangle, v);
    [0, 1].map(|k| (corners[1][k] - corners[0][k]) * a + (corners[2][k] - corners[0][k]) * b)
}

/// The derivatives of the position along u and v.
pub(super) fn uv_directions(triangle: usize) -> [[f64; 3]; 2] {
    let [e, f] = edges(triangle);
    let [[du1, dv1], [du2, dv2]] = [uv_change(triangle, e), uv_change(triangle, f)];
    let determinant = du1 * dv2 - du2 * dv1;
    [[0, 1, 2].map(|k| (e[k] * dv2 - f[k] * dv1) / determinant), [0, 1, 2].map(|k| (f[k] * du1 - e[k] * du2) / determinant)]
}

#[test]
fn steps_lie_in_the_surface() {
    let benches = [0, 1].map(|axis| leaf(&json!({ "PositionStep": { "axis": axis } })));
    let points = &benches[0].points;
    for execution in Execution::all() {
        let [first, second] = [&benches[0], &benches[1]].map(|bench| bench.run(execution));
        for i in 0..CHUNK {
            let (a, b, normal) = (three(first[i]), three(second[i]), triple(&points.geometric_normal, i));
            let width = f64::from(points.cone[i]);
            assert!((dot(a, a).sqrt() / width - 1.0).abs() < 1e-5 && (dot(b, b).sqrt() / width - 1.0).abs() < 1e-5);
            assert!(dot(a, normal).abs() < 1e-6 && dot(b, normal).abs() < 1e-6 && dot(a, b).abs() < 1e-6);
        }
    }
}

#[test]
fn steps_without_a_cone_are_small_but_there() {
    let mut bench = leaf(&json!({ "PositionStep": { "axis": 1 } }));
    bench.points.cone.fill(0.0);
    bench.check(|_, found| {
        let length = dot(three(found), three(found)).sqrt();
        assert!((1e-5..1e-2).contains(&length), "{length}");
    });
}

#[test]
fn primvars_change_with_the_steps() {
    for axis in [0, 1] {
        let step = leaf(&json!({ "PositionStep": { "axis": axis } })).run(Execution::Scalar);
        let change = |name: &str| leaf(&json!({ "PrimvarStep": { "name": name, "axis": axis } }));
        let bench = change("st");
        bench.check(|i, found| {
            let expected = uv_change(bench.points.primitive[i] as usize, three(step[i]));
            (0..2).for_each(|k| close(found[k], expected[k], 5e-6, "st"));
            assert_eq!(found[2..], [0.0; 2]);
        });
        let bench = change("heat");
        bench.check(|i, found| {
            let triangle = bench.points.primitive[i] as usize;
            let [v0, v1, v2] = TRIANGLES[triangle].map(|point| {
                let [x, y, z] = POINTS[point as usize].map(f64::from);
                [x + 2.0 * y, y - z, x * 3.0]
            });
            let [a, b] = barycentric_change(triangle, three(step[i]));
            (0..3).for_each(|k| close(found[k], (v1[k] - v0[k]) * a + (v2[k] - v0[k]) * b, 2e-5, "heat"));
        });
        for name in ["tone", "absent"] {
            change(name).check(|_, found| assert_eq!(found, [0.0; 4], "{name}"));
        }
    }
}
