//! The glare of luminaires at observers' eyes against CIE 117 by hand.

use gonio::{
    measure::{MeterReading, Reading, Watch, glare::cie_position_index, measure},
    scene::{DomeFormat, Grid, GridArea, LightShape, Material, Measurand, Medium, Meter, Origin, Scene, Transform},
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

fn found(scene: &Scene) -> MeterReading {
    let mut watch = Watch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let scene = Scene { meters: vec![eye()], ..scene.clone() };
    measure(&scene, Execution::best(), &mut watch).expect("a rating").meters.remove(0)
}

fn rated(scene: &Scene) -> Reading {
    found(scene).reading
}

/// 1 / p² of a place so far ahead, to the side and up; 0 where CIE 117's table has none.
fn weight(ahead: f64, side: f64, up: f64) -> f64 {
    cie_position_index([side, up, ahead]).map_or(0.0, |index| index.powi(-2))
}

/// By Σ L² ω / p² before the sky alone.
fn rating_of(sum: f64) -> f64 {
    8.0 * (0.25 / SKY * sum).log10()
}

fn assert_rated(found: Reading, sum: f64) {
    let expected = rating_of(sum);
    assert!(found.standard_error < 0.05, "{found:?}");
    assert!((found.value - expected).abs() < 5.0 * found.standard_error + 1e-3, "{found:?} instead of {expected}");
}

/// ∫ L² / p² dω of a level face below which the eye at the origin is, by the midpoint rule over its points.
fn of_face(luminance: f64, points: impl Iterator<Item = [f64; 3]>, area: f64) -> f64 {
    let part = |[x, y, z]: [f64; 3]| {
        let square = x * x + y * y + z * z;
        luminance * luminance * area * (y / square.sqrt()) / square * weight(-z, x, y)
    };
    points.map(part).sum()
}

/// Of a disk.
fn of_disk(luminance: f64, [x, y, z]: [f64; 3], radius: f64) -> f64 {
    const RINGS: usize = 100;
    let at = move |k: usize| {
        // Points of equal areas.
        let (r, angle) = (radius * ((k / RINGS) as f64 + 0.5).sqrt() / 10.0, (k % RINGS) as f64 * 2.0 * PI / RINGS as f64);
        [x + r * angle.cos(), y, z + r * angle.sin()]
    };
    of_face(luminance, (0..100 * RINGS).map(at), PI * radius * radius / (100 * RINGS) as f64)
}

/// Of a rectangle with these sides.
fn of_rectangle(luminance: f64, [x, y, z]: [f64; 3], [width, depth]: [f64; 2]) -> f64 {
    const SIDE: usize = 100;
    let share = |k: usize| (k as f64 + 0.5) / SIDE as f64 - 0.5;
    let points = (0..SIDE * SIDE).map(|k| [x + width * share(k % SIDE), y, z + depth * share(k / SIDE)]);
    of_face(luminance, points, width * depth / (SIDE * SIDE) as f64)
}

#[test]
fn glowing_haze_is_background() {
    // Haze without end that absorbs a and sends e a metre is as bright as e / a all around; nothing comes of the sky. Two metres of it take nothing away.
    let absorption = 1e-5;
    let mut scene = under_sky();
    scene.atmosphere = Medium { absorption: [absorption; 3], emission: [absorption * SKY as f32; 3], ..Medium::default() };
    let (radius, luminance, place) = (0.15, 40_000.0, [0.0, 1.2, -2.0]);
    scene.lights.push(light(LightShape::Disk { radius }, facing_down(place), [luminance as f32; 3]));
    assert_rated(rated(&scene), of_disk(luminance, place, radius));
}

#[test]
fn flat_luminaires_glare_by_luminance_solid_angle_and_place() {
    let (radius, luminance) = (0.15, 40_000.0);
    let places = [[0.0, 5.4, -9.0], [4.5, 5.4, -9.0], [-4.5, 5.4, -18.0]];
    let mut scene = under_sky();
    let lamp = |place| light(LightShape::Disk { radius }, facing_down(place), [luminance as f32; 3]);
    scene.lights.extend(places.map(lamp));
    // Behind the eye, and seen from above, which is its dark side.
    scene.lights.extend([lamp([0.0, 5.4, 9.0]), lamp([0.0, -1.0, -3.0])]);
    assert_rated(rated(&scene), places.map(|place| of_disk(luminance, place, radius)).iter().sum());
    let coverage = found(&scene).coverage.expect("what was rated");
    assert_eq!((coverage.sources, coverage.left_out(), coverage.note()), (3, 0, None));
}

#[test]
fn large_luminaires_glare_part_by_part() {
    let (luminance, place) = (4000.0, [0.5, 1.2, -1.5]);
    let mut scene = under_sky();
    let sides = [0.6, 1.2];
    let panel = LightShape::Rectangle { width: sides[0], height: sides[1] };
    scene.lights.push(light(panel, facing_down(place), [luminance as f32; 3]));
    assert_rated(rated(&scene), of_rectangle(luminance, place, sides));
    scene.lights[1] = light(LightShape::Disk { radius: 0.5 }, facing_down(place), [luminance as f32; 3]);
    assert_rated(rated(&scene), of_disk(luminance, place, 0.5));
    // Nearer, the first half of it is too high for a position index.
    let near = [0.0, 1.2, -0.7];
    scene.lights[1] = light(panel, facing_down(near), [luminance as f32; 3]);
    let (expected, whole) = (rating_of(of_rectangle(luminance, near, sides)), found(&scene));
    // The border falls between two of 16 rows of parts.
    assert!((whole.reading.value - expected).abs() < 0.3, "{whole:?} instead of {expected}");
    let coverage = whole.coverage.expect("what was rated");
    assert_eq!((coverage.sources, coverage.high), (1, 1));
    assert!(coverage.share_left_out() > 0.2 && coverage.share_left_out() < 0.8, "{coverage:?}");
    // Above the eye nothing of it is rated.
    scene.lights[1] = light(panel, facing_down([0.0, 1.2, 0.0]), [luminance as f32; 3]);
    assert_eq!(rated(&scene), Reading::default());
}

#[test]
fn luminaires_without_a_position_index_are_left_out_and_told() {
    let mut scene = under_sky();
    let lamp = |place| light(LightShape::Sphere { radius: 0.1 }, Transform::translation(place), [5000.0; 3]);
    scene.lights.push(lamp([0.4, 1.2, -2.0]));
    let alone = rated(&scene);
    // Too high, too far aside, below the line of sight, and behind, which is not told.
    scene.lights.extend([lamp([0.0, 2.0, -0.8]), lamp([3.5, 0.3, -1.0]), lamp([0.5, -0.6, -2.0]), lamp([0.0, 1.0, 2.0])]);
    let all = found(&scene);
    // Their light that the sky's background lets through differs by noise alone.
    assert!((all.reading.value - alone.value).abs() < 0.1, "{all:?} instead of {alone:?}");
    let coverage = all.coverage.expect("what was rated");
    assert_eq!((coverage.sources, coverage.high, coverage.aside, coverage.below), (4, 1, 1, 1));
    assert!(coverage.note().expect("a note").starts_with("3 of 4 sources left out"), "{coverage:?}");
}

#[test]
fn what_is_partly_hidden_glares_with_the_rest() {
    let (luminance, place, sides) = (4000.0, [0.0, 1.2, -2.0], [1.2, 0.6]);
    let mut scene = under_sky();
    let panel = LightShape::Rectangle { width: sides[0], height: sides[1] };
    scene.lights.push(light(panel, facing_down(place), [luminance as f32; 3]));
    let whole = of_rectangle(luminance, place, sides);
    assert_rated(rated(&scene), whole);
    // A black screen before the left half.
    add_quad(&mut scene, [-1.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], Material::diffuse(Origin::new("screen"), [0.0; 3]));
    let found = rated(&scene);
    // The screen takes of the sky what it covers: the background is what the eye has left.
    let (half, all) = (rating_of(whole / 2.0), rating_of(whole));
    assert!(found.value > half - 0.1 && found.value < all, "{found:?}: {half} to {all}");
    scene.lights[1].casts_shadow = false;
    assert!((rated(&scene).value - found.value - 8.0 * 2f64.log10()).abs() < 0.1);
}

#[test]
fn small_sources_and_points_count_as_fifty_square_centimetres() {
    // 200 I² / (r² p²), 0.05 m above the eye's height.
    let place = [0.4, 0.9, -2.5];
    let [x, y, z] = place;
    let sum = 200.0 * 800f64.powi(2) / (x * x + y * y + z * z) * weight(-z, x, y);
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
