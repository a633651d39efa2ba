//! Rooms about a place, by their walls.

use gonio::{
    compile::{CompiledScene, compile},
    measure::Room,
    scene::{Material, Origin, Scene},
};
use gonio_tests::scenes::{add_quad, add_triangles};
use std::sync::atomic::AtomicBool;

const UP: [f64; 3] = [0.0, 1.0, 0.0];
const HEIGHT: f32 = 2.8;

fn grey() -> Material {
    Material::diffuse(Origin::new("grey"), [0.5; 3])
}

/// Walls along a closed line of corners, floor and ceiling over all of it.
fn prism(corners: &[[f32; 2]]) -> Scene {
    let mut scene = Scene::default();
    for (k, [x, z]) in corners.iter().enumerate() {
        let [to_x, to_z] = corners[(k + 1) % corners.len()];
        add_quad(&mut scene, [*x, 0.0, *z], [to_x - x, 0.0, to_z - z], [0.0, HEIGHT, 0.0], grey());
    }
    for y in [0.0, HEIGHT] {
        add_quad(&mut scene, [-20.0, y, -20.0], [40.0, 0.0, 0.0], [0.0, 0.0, 40.0], grey());
    }
    scene
}

fn compiled(scene: &Scene) -> CompiledScene {
    compile(scene, None, &AtomicBool::new(false)).expect("a scene")
}

fn room(scene: &Scene, place: [f64; 3]) -> Room {
    Room::about(&compiled(scene), place, UP).expect("a room")
}

#[test]
fn rectangles_have_their_area_to_rounding() {
    let scene = prism(&[[0.0, 0.0], [6.0, 0.0], [6.0, 4.53], [0.0, 4.53]]);
    let found = room(&scene, [2.3, 0.75, 1.17]);
    assert!((found.area / (6.0 * 4.53) - 1.0).abs() < 1e-4, "{}", found.area);
    assert!((found.height - 2.05).abs() < 1e-5);
    assert!(found.contains([5.9, 2.79, 4.4]) && found.contains([6.0, 2.0, 1.0]));
    assert!(!found.contains([6.2, 2.79, 2.0]) && !found.contains([3.0, 2.79, 4.8]) && !found.contains([3.0, 5.6, 2.0]));
}

#[test]
fn corners_columns_and_slanted_walls_count() {
    // An L of 5 by 5 m without 3 by 2 m, seen from its arm.
    let l = prism(&[[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [2.0, 3.0], [2.0, 5.0], [0.0, 5.0]]);
    let found = room(&l, [1.0, 0.75, 4.5]);
    assert!((found.area - 19.0).abs() < 0.02, "{}", found.area);
    assert!(found.contains([4.9, 2.7, 0.1]) && !found.contains([4.0, 2.7, 4.0]));
    let mut column = prism(&[[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]]);
    for (corner, side) in [
        ([2.0, 0.0, 1.0], [0.5, 0.0, 0.0]),
        ([2.0, 0.0, 1.5], [0.5, 0.0, 0.0]),
        ([2.0, 0.0, 1.0], [0.0, 0.0, 0.5]),
        ([2.5, 0.0, 1.0], [0.0, 0.0, 0.5]),
    ] {
        add_quad(&mut column, corner, side, [0.0, HEIGHT, 0.0], grey());
    }
    assert!((room(&column, [4.0, 0.75, 3.0]).area - 23.75).abs() < 0.02);
    // A square that stands on its corner.
    let slanted = prism(&[[0.0, -3.0], [3.0, 0.0], [0.0, 3.0], [-3.0, 0.0]]);
    let found = room(&slanted, [0.4, 0.75, 0.3]);
    assert!((found.area - 18.0).abs() < 0.1, "{}", found.area);
}

#[test]
fn doors_do_not_join_rooms_and_open_places_are_none() {
    // A lintel over the door, which the section meets.
    let mut scene = prism(&[[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]]);
    add_quad(&mut scene, [3.0, 0.0, 0.0], [0.0, 0.0, 3.0], [0.0, HEIGHT, 0.0], grey());
    add_quad(&mut scene, [3.0, 2.1, 3.0], [0.0, 0.0, 1.0], [0.0, HEIGHT - 2.1, 0.0], grey());
    assert!((room(&scene, [1.0, 0.75, 1.0]).area - 12.0).abs() < 0.02);
    let mut yard = Scene::default();
    add_quad(&mut yard, [-5.0, 0.0, -5.0], [0.0, 0.0, 10.0], [10.0, 0.0, 0.0], grey());
    assert!(Room::about(&compiled(&yard), [0.0, 1.0, 0.0], UP).is_none());
    // A roof on nothing.
    let roof = [[-5.0, 3.0, -5.0], [5.0, 3.0, -5.0], [0.0, 3.0, 5.0]];
    add_triangles(&mut yard, &roof, &[[0, 1, 2]], grey());
    assert!(Room::about(&compiled(&yard), [0.0, 1.0, 0.0], UP).is_none());
}
