//! Layouts, figures and files; what lights give is in the tests of physics.

use super::*;
use crate::scene::{Grid, GridArea, Mesh, MeshId, Origin, Transform};
use std::sync::Arc;

/// A scene of one mesh, and a grid on it.
fn floor(points: &[[f32; 3]], triangles: &[[u32; 3]], transform: Transform) -> (Scene, Grid) {
    let mut scene = Scene::default();
    let mesh = scene.add_mesh(Mesh { points: Arc::from(points), triangles: Arc::from(triangles), ..Mesh::default() });
    let grid = Grid { origin: Origin::new("work plane"), area: GridArea::Mesh { mesh, transform }, spacing: 0.1, ..Grid::default() };
    (scene, grid)
}

/// An L of three square metres.
fn corner_room() -> (Scene, Grid) {
    let points = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
    ];
    floor(&points, &[[0, 7, 3], [0, 3, 6], [7, 1, 2], [7, 2, 3], [6, 3, 4], [6, 4, 5]], Transform::IDENTITY)
}

#[test]
fn rectangles_keep_their_margin_and_fill_evenly() {
    let area = GridArea::Rectangle { corner: [1.0, 2.0, 0.0], edges: [[4.0, 0.0, 0.0], [0.0, 3.0, 0.0]] };
    let grid = Grid { area, spacing: 0.45, margin: 0.5, height: 0.75, ..Grid::default() };
    let points = GridPoints::new(&Scene::default(), &grid).expect("a grid");
    assert_eq!(points.size, [7, 4]);
    assert!((points.spacing[0] - 3.0 / 7.0).abs() < 1e-12 && (points.spacing[1] - 0.5).abs() < 1e-12);
    let first = points.positions[0].expect("a point");
    let last = points.positions[27].expect("a point");
    for (found, expected) in first.iter().chain(&last).zip([1.5 + 1.5 / 7.0, 2.75, 0.75, 4.5 - 1.5 / 7.0, 4.25, 0.75]) {
        assert!((found - expected).abs() < 1e-12, "{first:?} {last:?}");
    }
}

#[test]
fn spacing_without_a_wish_is_the_standards() {
    // EN 12464-1's table: 0.6 m to 0.2 m, 2 m to 0.3 m, 10 m to 1 m (before rounding to whole numbers of points).
    for (side, most) in [(1.0, 0.2), (2.0, 0.33), (10.0, 1.0)] {
        let area = GridArea::Rectangle { corner: [0.0; 3], edges: [[side, 0.0, 0.0], [0.0, side, 0.0]] };
        let points = GridPoints::new(&Scene::default(), &Grid { area, ..Grid::default() }).expect("a grid");
        assert!((points.spacing[0] / most - 1.0).abs() < 0.06, "{side}: {}", points.spacing[0]);
    }
}

#[test]
fn the_first_sides_whole_points_decide_the_others() {
    let area = GridArea::Rectangle { corner: [0.0; 3], edges: [[4.0, 0.0, 0.0], [0.0, 9.7, 0.0]] };
    let points = GridPoints::new(&Scene::default(), &Grid { area, ..Grid::default() }).expect("a grid");
    // d = 4 m: p = 0.527 m, 8 points of 0.5 m, and 9.7 m / 0.5 m next to 19.
    assert_eq!(points.size, [8, 19]);
}

#[test]
fn grids_on_meshes_follow_the_outline() {
    let (scene, grid) = corner_room();
    let grid = Grid { spacing: 0.25, height: 0.8, ..grid };
    let points = GridPoints::new(&scene, &grid).expect("a grid");
    assert_eq!(points.size, [8, 8]);
    assert_eq!(points.known().count(), 48);
    assert!(points.known().all(|[x, y, z]| (x < 1.0 || y < 1.0) && (z - 0.8).abs() < 1e-9));
    let narrow = GridPoints::new(&scene, &Grid { margin: 0.25, ..grid }).expect("a grid");
    // Away from the outer walls by the margin, and from the inner corner by its circle.
    assert!(narrow.known().all(|[x, y, _]| x > 0.249 && y > 0.249 && (x < 0.751 || y < 0.751 || (x - 1.0).hypot(y - 1.0) >= 0.249)));
}

#[test]
fn margins_hold_far_from_the_origin() {
    // 0.4 m wide, and where single precision counts by half a metre.
    let (scene, grid) = corner_room();
    let placed = |origin: [f64; 3]| {
        let transform = Transform { columns: [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2], origin] };
        let area = GridArea::Mesh { mesh: MeshId(0), transform };
        GridPoints::new(&scene, &Grid { area, spacing: 0.05, margin: 0.04, ..grid.clone() }).expect("a grid")
    };
    let far = [500_000.0, 5_400_000.0, 300.0];
    let (here, there) = (placed([0.0; 3]), placed(far));
    assert_eq!((here.size, here.known().count()), (there.size, there.known().count()));
    for (a, b) in here.known().zip(there.known()) {
        assert!((0..3).all(|k| (a[k] + far[k] - b[k]).abs() < 1e-6), "{a:?} {b:?}");
    }
}

#[test]
fn mirrored_placements_keep_their_face() {
    let mirrored = Transform { columns: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]] };
    let (scene, grid) = floor(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]], mirrored);
    let points = GridPoints::new(&scene, &grid).expect("a grid");
    assert_eq!(points.normal, [0.0, 0.0, 1.0]);
}

#[test]
fn areas_without_a_side_are_errors_that_name_the_grid() {
    let (there_and_back, mut grid) =
        floor(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2], [0, 2, 1]], Transform::IDENTITY);
    let mut complain = |change: &dyn Fn(&mut Grid)| {
        change(&mut grid);
        GridPoints::new(&there_and_back, &grid).expect_err("no grid").to_string()
    };
    assert!(complain(&|_| {}).contains("work plane"));
    assert!(complain(&|grid| grid.area = GridArea::Mesh { mesh: MeshId(7), transform: Transform::IDENTITY }).contains("mesh 7"));
    assert!(complain(&|grid| (grid.area, grid.margin) = (Grid::default().area, 0.5)).contains("nothing to measure"));
}

#[test]
fn figures_are_those_of_the_points() {
    let reading = |value| Reading { value, standard_error: 3.0 }.into();
    let points = GridPoints {
        facings: Vec::new(),
        size: [3, 1],
        spacing: [1.0; 2],
        positions: vec![Some([0.0; 3]), None, Some([2.0, 0.0, 0.0])],
        normal: [0.0, 0.0, 1.0],
        area: 3.0,
    };
    let grid = GridReading::new(&Grid::default(), points, &[reading(100.0), reading(300.0)]);
    assert_eq!((grid.summary.average.value, grid.summary.min.value, grid.summary.max.value), (200.0, 100.0, 300.0));
    assert_eq!((grid.summary.uniformity(), grid.summary.diversity()), (0.5, 1.0 / 3.0));
    assert!((grid.summary.average.standard_error - 3.0 / 2f64.sqrt()).abs() < 1e-12);
    assert!(grid.values()[1].is_nan());
    let text = csv(&Measurements { grids: vec![grid], ..Measurements::default() });
    assert_eq!(text.lines().count(), 3);
    assert!(text.contains(",0,2,2.000000,0.000000,0.000000,illuminance,300.000000,3.000000,lx"), "{text}");
}

#[test]
fn parts_tell_the_standard_error() {
    let reading = Reading::of_parts([1.0, 2.0, 3.0, 4.0].into_iter());
    assert!((reading.value - 2.5).abs() < 1e-12);
    // √(5/3) / √4.
    assert!((reading.standard_error - (5.0f64 / 12.0).sqrt()).abs() < 1e-12);
}
