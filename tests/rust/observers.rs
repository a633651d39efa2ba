//! The glare of luminaires at observers' eyes against CIE 117 by hand.

use gonio::{
    measure::{Reading, Watch, measure},
    scene::{DomeFormat, Grid, GridArea, LightShape, Material, Measurand, Meter, Origin, Scene, Transform},
};
use gonio_simd::Execution;
use gonio_tests::scenes::{add_quad, facing_down, light};
use std::{f64::consts::PI, sync::atomic::AtomicBool};

const SKY: f64 = 30.0;

/// Luminaires under an even sky, which alone is the background: L_b = its luminance.
fn under_sky() -> Scene {
    let mut scene = Scene::default();
    scene.settings.samples = 4096;
    scene.settings.threads = 2;
    scene.lights.push(light(LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY, [SKY as f32; 3]));
    scene
}

/// An eye at the origin of a scene whose up is y, looking along −z.
fn eye() -> Meter {
    Meter { measurand: Measurand::Ugr, normal: [0.0, 1.0, 0.0], facing: [0.0, 0.0, -1.0], ..Meter::default() }
}

fn rated(scene: &Scene) -> Reading {
    let mut watch = Watch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let scene = Scene { meters: vec![eye()], ..scene.clone() };
    measure(&scene, Execution::best(), &mut watch).expect("a rating").meters[0].reading
}

/// Guth's index as CIE 117's references state it, of a place so far ahead, to the side and up.
fn guth(ahead: f64, side: f64, up: f64) -> f64 {
    let tau = side.abs().atan2(up).to_degrees();
    let sigma = side.hypot(up).atan2(ahead).to_degrees();
    let first = 35.2 - 0.31889 * tau - 1.22 * (-2.0 * tau / 9.0).exp();
    let second = 21.0 + 0.26667 * tau - 0.002963 * tau * tau;
    (first * 1e-3 * sigma + second * 1e-5 * sigma * sigma).exp()
}

fn assert_rated(found: Reading, sum: f64) {
    let expected = 8.0 * (0.25 / SKY * sum).log10();
    assert!(found.standard_error < 0.05, "{found:?}");
    assert!((found.value - expected).abs() < 5.0 * found.standard_error + 1e-3, "{found:?} instead of {expected}");
}

#[test]
fn flat_luminaires_glare_by_luminance_solid_angle_and_place() {
    let (radius, luminance) = (0.3, 4000.0);
    let places = [[0.0, 1.8, -3.0], [1.5, 1.8, -3.0], [-1.5, 1.8, -6.0]];
    let mut scene = under_sky();
    let lamp = |place| light(LightShape::Disk { radius }, facing_down(place), [luminance as f32; 3]);
    scene.lights.extend(places.map(lamp));
    // Behind the eye, and seen from above, which is its dark side.
    scene.lights.extend([lamp([0.0, 1.8, 3.0]), lamp([0.0, -1.0, -3.0])]);
    let term = |[x, y, z]: [f64; 3]| {
        let square = x * x + y * y + z * z;
        let solid_angle = PI * radius * radius * (y / square.sqrt()) / square;
        luminance * luminance * solid_angle / guth(-z, x, y).powi(2)
    };
    assert_rated(rated(&scene), places.map(term).iter().sum());
}

#[test]
fn small_sources_and_points_count_as_fifty_square_centimetres() {
    // 200 I² / (r² p²), 0.05 m above the eye's height.
    let place = [0.4, 0.9, -2.5];
    let [x, y, z] = place;
    let sum = 200.0 * 800f64.powi(2) / ((x * x + y * y + z * z) * guth(-z, x, y).powi(2));
    let mut scene = under_sky();
    scene.lights.push(light(LightShape::Point, Transform::translation(place), [800.0; 3]));
    assert_rated(rated(&scene), sum);
    let radius = 0.01;
    let luminance = 800.0 / (PI * radius * radius);
    scene.lights[1] = light(LightShape::Sphere { radius }, Transform::translation(place), [luminance as f32; 3]);
    assert_rated(rated(&scene), sum);
}

#[test]
fn what_is_not_seen_does_not_glare() {
    let mut scene = under_sky();
    scene.lights.push(light(LightShape::Sphere { radius: 0.1 }, Transform::translation([0.0, 0.5, -3.0]), [5000.0; 3]));
    assert!(rated(&scene).value > 10.0);
    add_quad(&mut scene, [-1.0, -1.0, -2.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], Material::diffuse(Origin::new("wall"), [0.5; 3]));
    assert_eq!(rated(&scene), Reading::default());
    scene.instances.clear();
    scene.lights.remove(0);
    assert_eq!(rated(&scene).value, f64::INFINITY);
}

#[test]
fn grids_rate_observers_all_over_and_eyes_want_a_way_up() {
    let mut scene = under_sky();
    scene.lights.push(light(LightShape::Disk { radius: 0.3 }, facing_down([0.0, 1.8, -2.0]), [4000.0; 3]));
    let area = GridArea::Rectangle { corner: [-2.0, 0.0, 2.0], edges: [[4.0, 0.0, 0.0], [0.0, 0.0, -4.0]] };
    scene.grids.push(Grid { area, spacing: 1.0, facing: [0.0, 0.0, -1.0], measurand: Measurand::Ugr, ..Grid::default() });
    let mut watch = Watch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let grid = measure(&scene, Execution::best(), &mut watch).expect("ratings").grids.remove(0);
    assert_eq!(grid.summary.points, 16);
    assert!(grid.summary.max.value > 15.0 && grid.summary.min.value >= 0.0, "{:?}", grid.summary);
    scene.grids.clear();
    scene.meters = vec![Meter { normal: [0.0, 0.0, 2.0], ..eye() }];
    let error = measure(&scene, Execution::best(), &mut watch).expect_err("no way up").to_string();
    assert!(error.contains("line of sight"), "{error}");
}
