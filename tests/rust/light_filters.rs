//! Filters before lights: illuminances against quadrature over the light's points.

use gonio::{
    measure::{Watch, measure},
    scene::{Light, LightFilter, LightShape, Measurand, Meter, Origin, Scene, Slide, Transform},
};
use gonio_simd::Execution;
use std::sync::{Arc, atomic::AtomicBool};

const SIDE: f64 = 0.4;
const HEIGHT: f64 = 2.0;
/// Points of the light each way in quadrature.
const POINTS: usize = 200;

/// A square lamp that looks down from [`HEIGHT`].
fn lamp(filters: Vec<LightFilter>) -> Light {
    let place = Transform::translation([0.0, 0.0, HEIGHT]);
    let shape = LightShape::Rectangle { width: SIDE, height: SIDE };
    Light { filters, ..Light::new(Origin::new("lamp"), shape, place) }
}

/// A filter of half size that stands a metre below the lamp, turned by a right angle.
fn filter(slide: Slide) -> LightFilter {
    let columns = [[0.0, 0.5, 0.0], [-0.5, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, -1.0]];
    LightFilter { to_light: Transform { columns }, slide, missed: [0.0; 3], inverted: false, factor: [1.0; 3], density: 1.0 }
}

/// Lux on the floor.
fn illuminances(light: Light, places: &[[f64; 2]]) -> Vec<f64> {
    let mut scene = Scene { lights: vec![light], ..Scene::default() };
    scene.settings.samples = 1 << 16;
    let meter = |place: &[f64; 2]| Meter {
        position: [place[0], place[1], 0.0],
        normal: [0.0, 0.0, 1.0],
        measurand: Measurand::Illuminance,
        ..Meter::default()
    };
    scene.meters = places.iter().map(meter).collect();
    let mut watch = Watch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let found = measure(&scene, Execution::best(), &mut watch).expect("readings");
    found.meters.iter().map(|meter| meter.reading.value).collect()
}

/// The same by quadrature; `passes` is what goes through at a place of the filter's plane.
fn expected([x, y]: [f64; 2], passes: impl Fn([f64; 2]) -> f64) -> f64 {
    let mut sum = 0.0;
    for i in 0..POINTS * POINTS {
        let on = [i % POINTS, i / POINTS].map(|k| ((k as f64 + 0.5) / POINTS as f64 - 0.5) * SIDE);
        let squared = (x - on[0]).powi(2) + (y - on[1]).powi(2) + HEIGHT * HEIGHT;
        let [u, v] = [0.5 * (x + on[0]), 0.5 * (y + on[1])];
        // Turned and of half size.
        sum += HEIGHT * HEIGHT / (squared * squared) * passes([2.0 * v, -2.0 * u]);
    }
    sum * (SIDE / POINTS as f64).powi(2)
}

const PLACES: [[f64; 2]; 8] = [[0.0, 0.0], [0.9, 0.0], [1.0, 0.1], [1.1, -0.2], [0.2, 0.5], [0.1, 0.62], [-1.05, -0.55], [1.4, 0.0]];

#[track_caller]
fn assert_close(slide: Slide, passes: impl Fn([f64; 2]) -> f64 + Copy) {
    let found = illuminances(lamp(vec![filter(slide)]), &PLACES);
    let bare = expected([0.0; 2], |_| 1.0);
    for (place, found) in PLACES.into_iter().zip(found) {
        let expected = expected(place, passes);
        assert!((found - expected).abs() < 0.004 * bare, "{place:?}: {found} {expected}");
    }
}

#[test]
fn barn_doors_throw_half_shadows() {
    let slide = Slide::Opening { low: [-0.6, -1.0], high: [0.5, 1.0], radius: 0.0, edge: 0.0 };
    assert_close(slide, |[x, y]| f64::from(u8::from((-0.6..=0.5).contains(&x) && y.abs() <= 1.0)));
}

#[test]
fn a_slide_is_blurred_by_the_light_s_size() {
    // A ramp to the right, twice in the frame; black beyond it.
    let rgb: Vec<f32> = (0..64).flat_map(|column| [(column as f32 + 0.5) / 64.0; 3]).collect();
    let slide = Slide::Picture {
        width: 64,
        height: 1,
        rgb: Arc::from(rgb),
        size: [2.0, 1.5],
        fill: Some([0.0; 3]),
        repeats: false,
        to_texture: [[0.5, 0.25], [1.0, 0.0]],
    };
    let passes = |[x, y]: [f64; 2]| if x.abs() <= 1.0 && y.abs() <= 0.75 { 0.5 * (x / 2.0 + 0.5) + 0.25 } else { 0.0 };
    assert_close(slide, passes);
}

#[test]
fn without_filters_lights_are_as_they_were() {
    let found = illuminances(lamp(Vec::new()), &PLACES);
    for (place, found) in PLACES.into_iter().zip(found) {
        let expected = expected(place, |_| 1.0);
        assert!((found / expected - 1.0).abs() < 2e-3, "{place:?}: {found} {expected}");
    }
}
