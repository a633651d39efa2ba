//! Validation, triangulation, normals and tangents.

use super::{Random, assert_close, cube, grid, primvar};
use crate::*;

#[test]
fn negative_inputs_are_named() {
    let error = PolygonMesh::from_signed(vec![[0.0; 3]], &[3, -1], &[0, 0, 0]).unwrap_err();
    assert_eq!(error, MeshProblem::NegativeFaceCount { face: 1, count: -1 });
    let error = PolygonMesh::from_signed(vec![[0.0; 3]], &[3], &[0, 0, -5]).unwrap_err();
    assert_eq!(error, MeshProblem::NegativeVertex { corner: 2, index: -5 });
}

#[test]
fn broken_topology_is_fatal() {
    let mut mesh = grid(1, 1);
    mesh.corners[2] = 9;
    let problems = mesh.clone().checked().unwrap_err();
    assert_eq!(problems, [MeshProblem::VertexOutOfRange { corner: 2, vertex: 9, points: 4, count: 1 }]);
    assert_eq!(problems[0].to_string(), "face corner 2 has vertex 9, but there are 4 points (1 such corners)");
    mesh.face_counts = vec![u32::MAX; 3];
    assert!(mesh.validate().contains(&MeshProblem::CornerCount { expected: 3 * u64::from(u32::MAX), found: 4 }));
    let mut mesh = grid(1, 1);
    mesh.points[1][2] = f32::NAN;
    assert_eq!(mesh.validate()[0].severity(), Severity::Fatal);
}

#[test]
fn broken_primvars_are_dropped_alone() {
    let mut mesh = grid(2, 1);
    mesh.primvars = vec![
        primvar("good", Interpolation::Uniform, 1, vec![1.0, f32::NAN], None),
        primvar("short", Interpolation::FaceVarying, 2, vec![0.0; 6], None),
        primvar("wide", Interpolation::Constant, 17, vec![0.0; 17], None),
        primvar("index", Interpolation::Vertex, 1, vec![0.0; 2], Some(vec![0, 1, 0, 1, 2, 0])),
    ];
    let (mesh, problems) = mesh.checked().unwrap();
    let names: Vec<&str> = mesh.primvars.iter().map(|primvar| primvar.name.as_str()).collect();
    assert_eq!(names, ["good"]);
    assert_eq!(mesh.primvars[0].values, [1.0, 0.0]);
    assert_eq!(problems[0].to_string(), "primvar 'short' has 3 elements, expected 8 for FaceVarying interpolation");
    assert_eq!(problems[2].to_string(), "primvar 'index' has index 2 at place 4, but there are 2 elements");
    assert_eq!(problems.len(), 4);
}

#[test]
fn quads_are_cut_from_0_to_2_unless_concave() {
    let flat = grid(1, 1);
    assert_eq!(triangulate(&flat).corner_of, [[0, 1, 2], [0, 2, 3]]);
    let mut arrow = flat.clone();
    // Corner 1 of the face is pushed in behind the diagonal 0–2.
    arrow.points[1] = [0.2, 0.8, 0.0];
    assert_eq!(triangulate(&arrow).corner_of, [[1, 2, 3], [1, 3, 0]]);
}

#[test]
fn left_handed_meshes_and_holes() {
    let mut mesh = grid(2, 1);
    mesh.left_handed = true;
    mesh.hole_faces = vec![0, 77];
    let result = triangulate(&mesh);
    assert_eq!(result.triangles, [[1, 5, 2], [1, 4, 5]]);
    assert_eq!(result.face_of, [1, 1]);
    assert_close(&facet_normals(&mesh)[1], &[0.0, 0.0, -1.0], 0.0);
    mesh.face_counts = vec![2, 6];
    assert_eq!(triangulate(&mesh).skipped_faces, 0, "the short face is a hole");
    mesh.hole_faces.clear();
    assert_eq!(triangulate(&mesh).skipped_faces, 1);
}

fn triangle_area(mesh: &PolygonMesh, [a, b, c]: [u32; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|v| mesh.points[v as usize].map(f64::from));
    let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    0.5 * (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt()
}

/// A star-shaped polygon of `count` corners in a tilted plane, and its area.
fn star(random: &mut Random, count: u32) -> (PolygonMesh, f64) {
    let radii: Vec<f32> = (0..count).map(|_| 0.1 + random.float()).collect();
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(count);
    let (a, b) = ([0.6f64, 0.0, 0.8], [0.0f64, 1.0, 0.0]);
    let point = |i: u32| {
        let (sine, cosine) = angle(i).sin_cos();
        let r = f64::from(radii[i as usize]);
        [0, 1, 2].map(|k| (r * (cosine * a[k] + sine * b[k])) as f32)
    };
    let sector = angle(1).sin();
    let area = (0..count as usize).map(|i| 0.5 * sector * f64::from(radii[i]) * f64::from(radii[(i + 1) % count as usize])).sum();
    let mesh = PolygonMesh {
        points: (0..count).map(point).collect(),
        face_counts: vec![count],
        corners: (0..count).collect(),
        ..PolygonMesh::default()
    };
    (mesh, area)
}

#[test]
fn ears_cover_concave_polygons_exactly() {
    let mut random = Random(7);
    for round in 0..300 {
        let count = 5 + random.below(if round % 30 == 0 { 600 } else { 40 }) as u32;
        let (mesh, area) = star(&mut random, count);
        let triangles = triangulate(&mesh).triangles;
        assert_eq!(triangles.len(), count as usize - 2);
        let covered: f64 = triangles.iter().map(|&triangle| triangle_area(&mesh, triangle)).sum();
        assert!((covered - area).abs() < 1e-5 * area, "round {round}: {covered} of {area}");
    }
}

#[test]
fn huge_polygons_take_no_quadratic_time() {
    let (mesh, area) = star(&mut Random(1), 60_000);
    let covered: f64 = triangulate(&mesh).triangles.iter().map(|&triangle| triangle_area(&mesh, triangle)).sum();
    assert!(covered >= 0.99 * area);
    let count = 60_000u32;
    let comb = |i: u32| if i.is_multiple_of(2) { [-(i as f32), i as f32, 0.0] } else { [2.0 * count as f32, i as f32, 0.0] };
    let comb = PolygonMesh { points: (0..count).map(comb).collect(), ..mesh };
    assert_eq!(triangulate(&comb).triangles.len(), count as usize - 2);
}

#[test]
fn normals_of_a_cube() {
    let mesh = cube();
    for (point, normal) in mesh.points.iter().zip(smooth_normals(&mesh)) {
        assert_close(&normal, &point.map(|x| x / 3.0f32.sqrt()), 1e-6);
    }
    let facets = facet_normals(&mesh);
    let sharp = corner_normals(&mesh, 0.5);
    let round = corner_normals(&mesh, 1.7);
    for (face, range) in mesh.usable_faces() {
        for corner in range {
            assert_close(sharp.at(corner).unwrap(), &facets[face as usize], 1e-6);
            assert_close(round.at(corner).unwrap(), &smooth_normals(&mesh)[mesh.corners[corner] as usize], 1e-6);
        }
    }
}

#[test]
fn tangents_follow_u() {
    let mesh = grid(2, 2);
    let triangulation = triangulate(&mesh);
    let normals = vec![[0.0, 0.0, 1.0]; 3 * triangulation.triangles.len()];
    let at = |flip: f32| -> Vec<[f32; 2]> {
        triangulation.triangles.iter().flatten().map(|&v| mesh.points[v as usize]).map(|p| [flip * (p[0] + p[1]), p[1] - p[0]]).collect()
    };
    let diagonal = 0.5f32.sqrt();
    for (flip, sign) in [(1.0, 1.0), (-1.0, -1.0)] {
        for tangent in corner_tangents(&mesh.points, &triangulation.triangles, &normals, &at(flip)) {
            assert_close(&tangent, &[flip * diagonal, flip * diagonal, 0.0, sign], 1e-6);
        }
    }
    for tangent in corner_tangents(&mesh.points, &triangulation.triangles, &normals, &[]) {
        assert!(tangent[2].abs() < 1e-6 && (tangent[0].hypot(tangent[1]) - 1.0).abs() < 1e-6 && tangent[3] == 1.0);
    }
}

#[test]
fn primvars_follow_their_triangles() {
    let mut mesh = grid(2, 1);
    mesh.primvars = vec![
        primvar("face", Interpolation::Uniform, 1, vec![5.0, 6.0], None),
        primvar("corner", Interpolation::FaceVarying, 1, (0..8).map(|i| i as f32).collect(), None),
    ];
    let triangulation = triangulate(&mesh);
    assert_eq!(mesh.primvars[0].triangulated(&triangulation).indices, Some(vec![0, 0, 1, 1]));
    assert_eq!(mesh.primvars[1].triangulated(&triangulation).indices, Some(vec![0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]));
}
