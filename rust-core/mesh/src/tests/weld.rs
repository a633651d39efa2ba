//! Places of points, and normals that are made again.

use crate::{Smoothing, Weld};

/// Two squares that meet in an edge whose points are there twice, the second turned up by an angle.
fn folded(angle: f32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (sin, cos) = angle.sin_cos();
    let points = vec![
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [-0.0, 0.0, 0.0],
        [cos, 0.0, sin],
        [cos, 1.0, sin],
        [0.0, 1.0, -0.0],
    ];
    (points, vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
}

#[test]
fn points_of_one_place_are_found_and_share_a_normal() {
    let (points, triangles) = folded(0.5);
    let mut weld = Weld::new(&points);
    assert_eq!(weld.place, [0, 1, 2, 3, 1, 4, 5, 2]);
    let normals = weld.normals(&points, &triangles, None);
    assert_eq!(weld.count, 6);
    let half = [-(0.25_f32.sin()), 0.0, 0.25_f32.cos()];
    assert!((0..3).all(|k| (normals[1][k] - half[k]).abs() < 1e-6), "{normals:?}");
}

#[test]
fn sheets_back_to_back_stay_apart() {
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut weld = Weld::new(&points);
    let normals = weld.normals(&points, &[[0, 1, 2], [3, 5, 4]], None);
    let of = |point: usize| normals[weld.place[point] as usize][2];
    assert_eq!([of(0), of(1), of(3), of(4)], [1.0, 1.0, -1.0, -1.0]);
}

#[test]
fn what_was_smooth_is_made_smooth_and_what_was_sharp_sharp() {
    let (flat, triangles) = folded(0.0);
    let (points, _) = folded(0.5);
    let weld = Weld::new(&flat);
    let smooth = Smoothing::new(&weld, &triangles, &|_| [0.0, 0.0, 2.0]);
    assert_eq!((smooth.normals.len(), smooth.group[1], smooth.group[2]), (6, smooth.group[6], smooth.group[11]));
    let normal = smooth.remade(&points, &triangles)[smooth.group[1] as usize];
    assert!((normal[0] + 0.25_f32.sin()).abs() < 1e-6, "{normal:?}");
    let sharp = Smoothing::new(&weld, &triangles, &|corner| if corner < 6 { [0.0, 0.0, 1.0] } else { [0.0, 0.6, 0.8] });
    assert_eq!(sharp.normals.len(), 8);
    let normal = sharp.remade(&points, &triangles)[sharp.group[1] as usize];
    assert_eq!(normal, [0.0, 0.0, 1.0]);
}

#[test]
fn triangles_without_area_and_points_that_are_no_numbers_have_normals() {
    let points = vec![[f32::NAN; 3], [0.0; 3], [0.0; 3], [f32::INFINITY, 0.0, 0.0]];
    let mut weld = Weld::new(&points);
    let triangles = [[0, 1, 2], [1, 2, 2], [3, 1, 2]];
    let normals = weld.normals(&points, &triangles, None);
    assert!(normals.iter().flatten().all(|x| x.is_finite()));
    let smoothing = Smoothing::new(&weld, &triangles, &|_| [f32::NAN; 3]);
    assert_eq!(smoothing.remade(&points, &triangles).len(), smoothing.normals.len());
}
