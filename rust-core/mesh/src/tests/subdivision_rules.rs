//! Creases, boundaries, holes and primvars under subdivision.

use super::{Random, assert_close, cube, grid, primvar};
use crate::refine::*;
use crate::{Interpolation, MeshProblem, PolygonMesh};
use std::sync::atomic::AtomicBool;

fn control(level: u32) -> RefineOptions {
    RefineOptions { level, to_limit: false, ..RefineOptions::default() }
}

/// A bumpy 4 × 4 grid.
fn bumpy() -> PolygonMesh {
    let mut random = Random(3);
    let mut mesh = grid(4, 4);
    for point in &mut mesh.points {
        *point = point.map(|x| x + 0.5 * random.float());
    }
    mesh
}

/// A crease through the middle of the grid, one sharpness for the chain or one per edge.
fn middle(sharpnesses: &[f32]) -> Creases {
    Creases {
        crease_indices: vec![10, 11, 12, 13, 14],
        crease_lengths: vec![5],
        crease_sharpnesses: sharpnesses.to_vec(),
        ..Creases::default()
    }
}

fn points(creases: &Creases, level: u32) -> Vec<f32> {
    refine(&bumpy(), creases, &control(level), None).unwrap().mesh.points.into_flattened()
}

fn mean(a: &[f32], b: &[f32]) -> Vec<f32> {
    a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()
}

#[test]
fn fractional_sharpness_blends_the_neighbouring_levels() {
    let (smooth, one) = (points(&middle(&[0.0]), 1), points(&middle(&[1.0]), 1));
    assert!(smooth != one);
    assert_close(&points(&middle(&[0.5]), 1), &mean(&smooth, &one), 1e-5);
    assert_close(&points(&middle(&[1.0]), 1), &points(&middle(&[10.0]), 1), 0.0);
    let (one, two) = (points(&middle(&[1.0]), 2), points(&middle(&[2.0]), 2));
    assert_close(&points(&middle(&[1.5]), 2), &mean(&one, &two), 1e-5);
    assert_close(&points(&middle(&[3.0]), 3), &points(&middle(&[10.0]), 3), 0.0);
}

#[test]
fn sharpness_per_edge_or_per_chain() {
    assert_close(&points(&middle(&[1.3; 4]), 2), &points(&middle(&[1.3]), 2), 0.0);
    let result = refine(&bumpy(), &middle(&[1.0, 2.0]), &control(1), None).unwrap();
    assert_eq!(result.problems.len(), 1);
    assert_eq!(result.problems[0].to_string(), "2 crease sharpnesses, expected 1 (per crease) or 4 (per edge)");
}

#[test]
fn creases_off_the_mesh_are_ignored_and_reported() {
    let creases =
        Creases { crease_indices: vec![0, 24, 25, 1], crease_lengths: vec![4], crease_sharpnesses: vec![3.0], ..Creases::default() };
    let result = refine(&bumpy(), &creases, &control(1), None).unwrap();
    assert_eq!(result.problems, [MeshProblem::Crease { message: "3 crease edges are no edges of the mesh and are ignored".into() }]);
}

#[test]
fn sharp_corners_stay() {
    let corner = |sharpness| Creases { corner_indices: vec![12], corner_sharpnesses: vec![sharpness], ..Creases::default() };
    let at = |sharpness, level| points(&corner(sharpness), level)[36..39].to_vec();
    assert_close(&at(10.0, 3), &bumpy().points[12], 0.0);
    assert_close(&at(0.5, 1), &mean(&at(0.0, 1), &at(1.0, 1)), 1e-6);
}

#[test]
fn boundary_rules() {
    let mesh = grid(3, 3);
    let at =
        |boundary| refine(&mesh, &Creases::default(), &RefineOptions { boundary, level: 2, ..RefineOptions::default() }, None).unwrap();
    let none = at(BoundaryInterpolation::None);
    assert_eq!(none.mesh.hole_faces.len(), 8 * 16);
    assert!(none.face_of.iter().enumerate().all(|(face, &parent)| none.mesh.hole_faces.contains(&(face as u32)) == (parent != 4)));
    assert_close(&at(BoundaryInterpolation::EdgeOnly).mesh.points[0], &[1.0 / 6.0, 1.0 / 6.0, 0.0], 1e-6);
    assert_close(&at(BoundaryInterpolation::EdgeAndCorner).mesh.points[0], &[0.0; 3], 0.0);
    let sharp = Creases {
        crease_indices: vec![0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4, 0],
        crease_lengths: vec![13],
        crease_sharpnesses: vec![10.0],
        ..Creases::default()
    };
    let kept = refine(&mesh, &sharp, &RefineOptions { boundary: BoundaryInterpolation::None, ..control(1) }, None).unwrap();
    assert!(kept.mesh.hole_faces.is_empty());
}

#[test]
fn holes_and_parents_are_carried() {
    let mut mesh = cube();
    mesh.hole_faces = vec![2];
    let result = refine(&mesh, &Creases::default(), &control(2), None).unwrap();
    assert_eq!(result.face_of.len(), 96);
    assert!((0..6).all(|face| result.face_of.iter().filter(|&&parent| parent == face).count() == 16));
    assert_eq!(result.mesh.hole_faces.len(), 16);
    assert_eq!(crate::triangulate(&result.mesh).triangles.len(), 160);
}

#[test]
fn a_linear_boundary_point_needs_no_neighbours() {
    let options = RefineOptions { scheme: Scheme::Bilinear, level: 3, boundary: BoundaryInterpolation::None, ..RefineOptions::default() };
    let result = refine(&grid(1, 1), &Creases::default(), &options, None).unwrap();
    assert_eq!((result.mesh.points.len(), result.mesh.hole_faces.len()), (81, 0));
    assert!(result.mesh.points.iter().flatten().all(|x| (x * 8.0).fract() == 0.0));
}

#[test]
fn primvars_follow_their_interpolation() {
    let mut mesh = bumpy();
    let flat = mesh.points.as_flattened().to_vec();
    let five: Vec<f32> = mesh.points.iter().flat_map(|p| [p[0], p[1], p[2], p[0], p[1]]).collect();
    let corner_st: Vec<f32> = mesh.corners.iter().flat_map(|&v| mesh.points[v as usize][..2].to_vec()).collect();
    mesh.primvars = vec![
        primvar("vertex", Interpolation::Vertex, 3, flat.clone(), None),
        primvar("five", Interpolation::Vertex, 5, five, None),
        primvar("varying", Interpolation::Varying, 3, flat, Some((0..25).collect())),
        primvar("uniform", Interpolation::Uniform, 1, (0..16).map(|i| i as f32).collect(), None),
        primvar("constant", Interpolation::Constant, 2, vec![1.0, 2.0], None),
        primvar("corner", Interpolation::FaceVarying, 2, corner_st, None),
    ];
    for to_limit in [false, true] {
        let options = RefineOptions {
            face_varying: FaceVaryingInterpolation::None,
            boundary: BoundaryInterpolation::EdgeOnly,
            to_limit,
            ..control(2)
        };
        let result = refine(&mesh, &middle(&[1.4]), &options, None).unwrap();
        assert_eq!(result.mesh.validate(), []);
        let by_name = |name: &str| result.mesh.primvars.iter().find(|primvar| primvar.name == name).unwrap();
        assert_eq!(by_name("vertex").values, result.mesh.points.as_flattened());
        let five = &by_name("five").values;
        assert!(result.mesh.points.iter().zip(five.chunks(5)).all(|(p, v)| v == [p[0], p[1], p[2], p[0], p[1]]));
        let linear = RefineOptions { scheme: Scheme::Bilinear, ..control(2) };
        let linear = refine(&mesh, &Creases::default(), &linear, None).unwrap();
        assert_eq!(by_name("varying").values, linear.mesh.points.as_flattened());
        for (face, range) in result.mesh.usable_faces() {
            assert_eq!(by_name("uniform").at(face as usize).unwrap(), [result.face_of[face as usize] as f32]);
            for corner in range {
                // Continuous values without linear corners are smoothed exactly as the points are.
                assert_close(by_name("corner").at(corner).unwrap(), &result.mesh.points[result.mesh.corners[corner] as usize][..2], 1e-5);
            }
        }
    }
}

/// A 4 × 2 grid cut by a seam in the middle, and the values at the middle point of the seam.
fn seam_values(face_varying: FaceVaryingInterpolation) -> Vec<[f32; 2]> {
    let mut mesh = grid(4, 2);
    let st = |face: usize, vertex: u32| {
        let [x, y, _] = mesh.points[vertex as usize];
        [if face % 4 < 2 { x } else { x + 10.0 }, y * y]
    };
    let values: Vec<f32> = mesh.corners.iter().enumerate().flat_map(|(corner, &vertex)| st(corner / 4, vertex)).collect();
    mesh.primvars = vec![primvar("st", Interpolation::FaceVarying, 2, values, None)];
    let result = refine(&mesh, &Creases::default(), &RefineOptions { face_varying, ..control(1) }, None).unwrap();
    let at = |vertex: u32, side: f32| {
        let corner = (0..result.mesh.corners.len()).find(|&corner| {
            let st = result.mesh.primvars[0].at(corner).unwrap();
            result.mesh.corners[corner] == vertex && (st[0] > 7.0) == (side > 0.0)
        });
        result.mesh.primvars[0].at(corner.unwrap()).unwrap().try_into().unwrap()
    };
    vec![at(7, -1.0), at(7, 1.0), at(2, -1.0), at(2, 1.0)]
}

#[test]
fn seams_are_creases_of_the_values() {
    // Along the seam t is 0, 1, 4: the crease rule gives 0.75 × 1 + 0.125 × (0 + 4); s stays on either side.
    let smooth = seam_values(FaceVaryingInterpolation::CornersPlus1);
    assert_eq!(smooth[..2], [[2.0, 1.25], [12.0, 1.25]]);
    let linear = seam_values(FaceVaryingInterpolation::Boundaries);
    assert_eq!(linear[..2], [[2.0, 1.0], [12.0, 1.0]]);
    assert_eq!(linear[2..], [[2.0, 0.0], [12.0, 0.0]]);
    // Where the seam meets the boundary each side has a corner of one face.
    assert_eq!(smooth[2..], [[2.0, 0.0], [12.0, 0.0]]);
    let round = seam_values(FaceVaryingInterpolation::None);
    assert_eq!(round[2..], [[1.875, 0.125], [12.125, 0.125]]);
}

#[test]
fn separate_faces_keep_their_unit_squares() {
    let mesh = crate::quadrics::cube(2.0);
    let result = refine(&mesh, &Creases::default(), &control(3), None).unwrap();
    let st = result.mesh.primvars.iter().find(|primvar| primvar.name == "st").unwrap();
    for range in result.mesh.usable_faces().map(|(_, range)| range) {
        let corners: Vec<[f32; 2]> = range.map(|corner| st.at(corner).unwrap().try_into().unwrap()).collect();
        let area: f32 = (0..4).map(|i| corners[i][0] * corners[(i + 1) % 4][1] - corners[(i + 1) % 4][0] * corners[i][1]).sum();
        assert!((0.5 * area - 1.0 / 64.0).abs() < 1e-6, "{corners:?}");
    }
}

#[test]
fn loop_takes_quads_by_cutting_them() {
    let result = refine(&cube(), &Creases::default(), &RefineOptions { scheme: Scheme::Loop, ..control(1) }, None).unwrap();
    assert_eq!(result.face_of.len(), 48);
    assert!((0..6).all(|face| result.face_of.iter().filter(|&&parent| parent == face).count() == 8));
}

#[test]
fn levels_are_bounded_and_cancelled() {
    let options = RefineOptions { level: 40, max_faces: 1000, ..control(40) };
    let result = refine(&cube(), &Creases::default(), &options, None).unwrap();
    assert_eq!((result.level, result.mesh.face_counts.len()), (3, 384));
    assert_eq!(result.problems, [MeshProblem::LevelReduced { asked: 40, given: 3, max_faces: 1000 }]);
    assert_eq!(refine(&cube(), &Creases::default(), &control(2), Some(&AtomicBool::new(true))), Err(RefineError::Cancelled));
    let unchanged = refine(&cube(), &Creases::default(), &control(0), None).unwrap();
    assert_eq!((unchanged.level, unchanged.mesh), (0, cube()));
}
