//! Tessellated shapes: closed, outward, with the right area and volume.

use super::{assert_close, euler_characteristic};
use crate::quadrics::*;
use crate::*;
use std::f64::consts::PI;

/// Signed volume: positive when all faces wind outward.
fn volume(mesh: &PolygonMesh) -> f64 {
    let six_fold = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|v| mesh.points[v as usize].map(f64::from));
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    triangulate(mesh).triangles.iter().map(six_fold).sum::<f64>() / 6.0
}

fn closed_shapes() -> Vec<(&'static str, PolygonMesh, f64)> {
    let frustum = |h: f64, a: f64, b: f64| PI * h * (a * a + a * b + b * b) / 3.0;
    let ball = |r: f64| 4.0 / 3.0 * PI * r * r * r;
    vec![
        ("sphere", sphere(1.5, 256), ball(1.5)),
        ("cube", cube(3.0), 27.0),
        ("cylinder", cylinder(2.0, 1.0, 1.0, Axis::X, 256), frustum(2.0, 1.0, 1.0)),
        ("frustum", cylinder(2.0, 1.0, 0.5, Axis::Y, 256), frustum(2.0, 1.0, 0.5)),
        ("cone", cone(2.0, 1.0, Axis::Z, 256), frustum(2.0, 1.0, 0.0)),
        ("capsule", capsule(2.0, 1.0, 1.0, Axis::Z, 256), frustum(2.0, 1.0, 1.0) + ball(1.0)),
        ("egg", capsule(2.0, 1.0, 0.5, Axis::X, 256), frustum(2.0, 1.0, 0.5) + 0.5 * (ball(1.0) + ball(0.5))),
    ]
}

#[test]
fn shapes_are_closed_and_outward() {
    for (name, mesh, expected) in closed_shapes() {
        assert_eq!(mesh.validate(), [], "{name}");
        assert_eq!(euler_characteristic(&mesh), 2, "{name}");
        let found = volume(&mesh);
        assert!((found / expected - 1.0).abs() < 1e-3, "{name}: {found}, expected {expected}");
    }
}

#[test]
fn normals_agree_with_the_faces() {
    for (name, mesh, _) in closed_shapes() {
        let facets = facet_normals(&mesh);
        for (face, range) in mesh.usable_faces() {
            for corner in range {
                let normal = mesh.primvars[0].at(corner).unwrap();
                let facet = facets[face as usize];
                let cosine = normal[0] * facet[0] + normal[1] * facet[1] + normal[2] * facet[2];
                assert!(cosine > 0.999, "{name}, face {face}: {normal:?} and {facet:?}");
            }
        }
    }
}

#[test]
fn planes_face_their_axis() {
    for (axis, normal, size) in [
        (Axis::X, [1.0, 0.0, 0.0], [0.0, 3.0, 2.0]),
        (Axis::Y, [0.0, 1.0, 0.0], [2.0, 0.0, 3.0]),
        (Axis::Z, [0.0, 0.0, 1.0], [2.0, 3.0, 0.0]),
    ] {
        let mesh = plane(2.0, 3.0, axis);
        assert_close(&facet_normals(&mesh)[0], &normal, 1e-6);
        let extent = [0, 1, 2].map(|k| 2.0 * mesh.points.iter().fold(0.0f32, |most, point| most.max(point[k])));
        assert_close(&extent, &size, 1e-6);
    }
}

#[test]
fn odd_sizes_do_no_harm() {
    for size in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-38] {
        for mesh in [
            sphere(size, 0),
            cube(size),
            cylinder(1.0, size, size, Axis::Z, 3),
            cone(size, size, Axis::X, 5),
            capsule(size, size, 1.0, Axis::Y, 7),
            plane(size, size, Axis::X),
        ] {
            assert_eq!(mesh.validate(), []);
        }
    }
}
