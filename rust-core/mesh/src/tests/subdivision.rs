//! Refined positions, limits and normals against closed forms.

use super::{assert_close, cube, euler_characteristic, grid};
use crate::PolygonMesh;
use crate::refine::*;

fn refined(mesh: &PolygonMesh, creases: &Creases, options: RefineOptions) -> Refined {
    let refined = refine(mesh, creases, &options, None).unwrap();
    assert_eq!(refined.mesh.validate(), []);
    refined
}

fn control(level: u32) -> RefineOptions {
    RefineOptions { level, to_limit: false, ..RefineOptions::default() }
}

fn limit(level: u32) -> RefineOptions {
    RefineOptions { level, ..RefineOptions::default() }
}

fn has_point(mesh: &PolygonMesh, point: [f32; 3]) -> bool {
    mesh.points.iter().any(|other| (0..3).all(|k| (other[k] - point[k]).abs() < 1e-5))
}

/// A fan of `count` triangles about its last point.
fn fan(count: u32) -> PolygonMesh {
    let angle = |i: u32| std::f32::consts::TAU * i as f32 / count as f32;
    let mut points: Vec<[f32; 3]> = (0..count).map(|i| [angle(i).cos(), angle(i).sin(), 0.1 * (i % 3) as f32]).collect();
    points.push([0.1, 0.05, 1.0]);
    let corners = (0..count).flat_map(|i| [i, (i + 1) % count, count]).collect();
    PolygonMesh { points, face_counts: vec![3; count as usize], corners, ..PolygonMesh::default() }
}

#[test]
fn catmull_clark_cube_level_one() {
    let result = refined(&cube(), &Creases::default(), control(1)).mesh;
    assert_eq!((result.points.len(), result.face_counts.len()), (26, 24));
    for (point, original) in result.points.iter().zip(&cube().points) {
        assert_close(point, &original.map(|x| x * 5.0 / 9.0), 1e-6);
    }
    for point in [[0.75, 0.75, 0.0], [0.0, -0.75, 0.75], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]] {
        assert!(has_point(&result, point), "{point:?}");
    }
}

#[test]
fn catmull_clark_cube_limit_is_the_same_from_every_level() {
    let levels: Vec<Refined> = (1..=4).map(|level| refined(&cube(), &Creases::default(), limit(level))).collect();
    for result in &levels {
        for (point, original) in result.mesh.points.iter().zip(&cube().points) {
            assert_close(point, &original.map(|x| 0.5 * x), 1e-6);
        }
        assert!(has_point(&result.mesh, [0.0, 0.0, 68.0 / 81.0]));
        assert_eq!(euler_characteristic(&result.mesh), 2);
    }
    for (coarse, fine) in levels[0].mesh.points.iter().zip(&levels[3].mesh.points) {
        assert_close(fine, coarse, 1e-6);
    }
}

#[test]
fn limits_agree_between_levels_at_any_valence() {
    for scheme in [Scheme::CatmullClark, Scheme::Loop] {
        for valence in 3..12 {
            // From boundary to boundary through the centre; a crease that ends inside has no exact limit stencil.
            let creases = Creases {
                crease_indices: vec![0, valence, valence / 2],
                crease_lengths: vec![3],
                crease_sharpnesses: vec![10.0],
                ..Creases::default()
            };
            let at = |level| refined(&fan(valence), &creases, RefineOptions { scheme, ..limit(level) });
            let (coarse, fine) = (at(2), at(4));
            for (a, b) in coarse.mesh.points.iter().zip(&fine.mesh.points) {
                assert_close(b, a, 2e-6);
            }
        }
    }
}

#[test]
fn limit_normals_agree_between_levels() {
    for scheme in [Scheme::CatmullClark, Scheme::Loop] {
        for valence in 3..10 {
            let at = |level| {
                refined(
                    &fan(valence),
                    &Creases::default(),
                    RefineOptions { scheme, boundary: BoundaryInterpolation::EdgeOnly, ..limit(level) },
                )
            };
            let (coarse, fine) = (at(2), at(5));
            let normal_of = |result: &Refined, vertex: u32| {
                let corner = result.mesh.corners.iter().position(|&v| v == vertex).unwrap();
                result.normals.as_ref().unwrap().at(corner).unwrap().to_vec()
            };
            for vertex in 0..coarse.mesh.points.len() as u32 {
                assert_close(&normal_of(&fine, vertex), &normal_of(&coarse, vertex), 2e-3);
            }
        }
    }
}

#[test]
fn loop_octahedron() {
    let axes = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let corners = vec![0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];
    let mesh = PolygonMesh { points: axes.to_vec(), face_counts: vec![3; 8], corners, ..PolygonMesh::default() };
    let options = RefineOptions { scheme: Scheme::Loop, ..control(1) };
    let result = refined(&mesh, &Creases::default(), options).mesh;
    assert_close(&result.points[0], &[0.515_625, 0.0, 0.0], 1e-6);
    assert!(has_point(&result, [0.375, 0.375, 0.0]));
    assert_eq!((result.points.len(), result.face_counts.len()), (18, 32));
    for level in 1..4 {
        let result = refined(&mesh, &Creases::default(), RefineOptions { level, to_limit: true, ..options });
        assert_close(&result.mesh.points[4], &[0.0, 0.0, 24.0 / 55.0], 1e-6);
        assert_eq!(euler_characteristic(&result.mesh), 2);
    }
}

#[test]
fn boundaries_are_cubic_b_splines() {
    for scheme in [Scheme::CatmullClark, Scheme::Loop] {
        let mesh = fan(7);
        let result = refined(&mesh, &Creases::default(), RefineOptions { scheme, ..limit(2) }).mesh;
        for i in 0..7 {
            let [a, b, c, d] = [i, i + 1, i + 2, i + 3].map(|i| mesh.points[i % 7]);
            let mix = |weights: [f32; 4]| [0, 1, 2].map(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k] + weights[3] * d[k]);
            assert!(has_point(&result, mix([1.0, 4.0, 1.0, 0.0].map(|w| w / 6.0))));
            assert!(has_point(&result, mix([1.0, 23.0, 23.0, 1.0].map(|w| w / 48.0))));
            // The uniform cubic B-spline at a quarter of the span.
            assert!(has_point(&result, mix([27.0, 235.0, 121.0, 1.0].map(|w| w / 384.0))));
        }
    }
}

#[test]
fn an_infinite_crease_is_the_same_curve_as_a_boundary() {
    let mut mesh = grid(4, 2);
    for (i, point) in mesh.points.iter_mut().enumerate() {
        point[2] = ((i * 5) % 7) as f32 * 0.2;
    }
    let creases =
        Creases { crease_indices: vec![5, 6, 7, 8, 9], crease_lengths: vec![5], crease_sharpnesses: vec![10.0], ..Creases::default() };
    let result = refined(&mesh, &creases, limit(3)).mesh;
    for i in 6..9 {
        let expected = [0, 1, 2].map(|k| (mesh.points[i - 1][k] + 4.0 * mesh.points[i][k] + mesh.points[i + 1][k]) / 6.0);
        assert_close(&result.points[i], &expected, 1e-6);
    }
}

#[test]
fn cube_limit_normals_point_along_the_diagonals() {
    for scheme in [Scheme::CatmullClark, Scheme::Loop] {
        let result = refined(&cube(), &Creases::default(), RefineOptions { scheme: Scheme::CatmullClark, ..limit(2) });
        let normals = result.normals.unwrap();
        for (corner, &vertex) in result.mesh.corners.iter().enumerate().filter(|(_, vertex)| **vertex < 8) {
            assert_close(normals.at(corner).unwrap(), &cube().points[vertex as usize].map(|x| x / 3.0f32.sqrt()), 1e-5);
        }
        assert_eq!(normals.element_count(), result.mesh.points.len(), "one normal per point where nothing is sharp, {scheme:?}");
    }
}

#[test]
fn sharp_edges_split_normals() {
    let mesh = cube();
    // All twelve edges infinitely sharp: the cube stays, with three normals at each of its corners.
    let mut creases = Creases::default();
    for quad in mesh.corners.chunks(4) {
        creases.crease_indices.extend_from_slice(quad);
        creases.crease_indices.push(quad[0]);
        creases.crease_lengths.push(5);
        creases.crease_sharpnesses.push(10.0);
    }
    let result = refined(&mesh, &creases, limit(2));
    let facets = crate::facet_normals(&mesh);
    let normals = result.normals.unwrap();
    for (face, range) in result.mesh.usable_faces() {
        for corner in range {
            assert_close(normals.at(corner).unwrap(), &facets[result.face_of[face as usize] as usize], 1e-5);
        }
    }
    let extent = result.mesh.points.iter().flatten().fold(0.0f32, |most, x| most.max(x.abs()));
    assert_eq!(extent, 1.0);
}

#[test]
fn left_handed_normals_face_the_other_way() {
    let mesh = PolygonMesh { left_handed: true, ..grid(2, 2) };
    let normals = refined(&mesh, &Creases::default(), limit(1)).normals.unwrap();
    for normal in normals.values.as_chunks::<3>().0 {
        assert_close(normal, &[0.0, 0.0, -1.0], 1e-6);
    }
}
