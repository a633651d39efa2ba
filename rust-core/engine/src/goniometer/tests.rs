//! Whole measurements of luminaires whose light is known in closed form; their sources are rays.

use super::{Angles, Frame, Options, Progress, Rays, Reading, Screen, Stop, direction_of, measure};
use crate::light_paths::test_scenes::add;
use crate::{
    error::{Error, Result},
    scene::{Closure, Material, Origin, Scene},
};
use gonio_simd::Execution;
use std::{f64::consts::PI, sync::atomic::AtomicBool};

/// Rays of a source; the same number of them is traced, so that none counts twice.
const COUNT: usize = 1 << 18;

fn options(rays: Rays) -> Options {
    Options {
        frame: Frame::default(),
        angles: Angles::regular(45.0, 15.0).expect("steps that fit"),
        stop: Stop { error: 0.0, rays: COUNT as u64, time: None },
        symmetry: None,
        rays: vec![rays],
        screen: None,
        seed: 1,
        threads: 2,
    }
}

fn measured(scene: &Scene, options: &Options) -> Result<Reading> {
    measure(scene, options, Execution::best(), &AtomicBool::new(false), &mut |_: &Progress| true)
}

/// Rays from a point in directions that fill a band of cosines evenly, 100 cd of them.
fn point(cosines: [f64; 2]) -> Rays {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let direction = |i: usize| {
        let z = cosines[0] + (cosines[1] - cosines[0]) * (i as f64 + 0.5) / COUNT as f64;
        let (sin, azimuth) = ((1.0 - z * z).sqrt(), 2.0 * PI * (i as f64 * golden).fract());
        [sin * azimuth.cos(), sin * azimuth.sin(), z]
    };
    let flux = 100.0 * 2.0 * PI * (cosines[1] - cosines[0]) / COUNT as f64;
    Rays {
        name: "point".into(),
        origins: vec![[0.0; 3]; COUNT],
        directions: (0..COUNT).map(direction).collect(),
        flux: vec![[flux; 3]; COUNT],
    }
}

/// A sphere that faces outwards, or inwards.
fn sphere(scene: &mut Scene, radius: f64, inwards: bool, material: Material) {
    const ROWS: u32 = 64;
    let place = |row: u32, column: u32| {
        let place = direction_of(180.0 * f64::from(column) / f64::from(ROWS), 180.0 * f64::from(row) / f64::from(ROWS));
        place.map(|x| (radius * x) as f32)
    };
    let points: Vec<[f32; 3]> = (0..=ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| place(row, column))).collect();
    let number = |row: u32, column: u32| row * 2 * ROWS + column % (2 * ROWS);
    let mut triangles = Vec::new();
    for row in 0..ROWS {
        for column in 0..2 * ROWS {
            let [a, b, c, d] = [number(row, column), number(row, column + 1), number(row + 1, column + 1), number(row + 1, column)];
            triangles.extend([[a, b, c], [a, c, d]].map(|[i, j, k]| if inwards { [i, k, j] } else { [i, j, k] }));
        }
    }
    add(scene, &points, &triangles, material);
}

fn material(parameters: &[(&str, f32)]) -> Material {
    let mut closure = Closure::default();
    closure.set_colour("base_color", [1.0; 3]);
    parameters.iter().for_each(|(name, value)| closure.set(name, *value));
    Material::of(Origin::new("material"), closure)
}

fn glass() -> Material {
    material(&[("transmission_weight", 1.0), ("specular_roughness", 0.0), ("specular_ior", 1.5)])
}

fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} instead of {expected}");
}

#[test]
fn a_point_shines_the_same_everywhere() {
    let reading = measured(&Scene::default(), &options(point([-1.0, 1.0]))).expect("a reading");
    let (escaped, emitted) = (reading.fluxes.escaped, reading.fluxes.emitted);
    near(escaped.value, 400.0 * PI, 1e-5);
    near(emitted.value, 400.0 * PI, 1e-5);
    for (place, intensity) in reading.intensities.iter().enumerate() {
        near(*intensity, 100.0, 0.01);
        // A cell at γ = 15° gets 1100 rays: 3 cd, which 64 batches tell within a few tenths.
        assert!(reading.errors[place] < 4.5, "{:?}", reading.direction(place));
    }
    assert_eq!(reading.opening.size(), [0.0; 3]);
    assert!(reading.diagnostics.is_empty(), "{:?}", reading.diagnostics);
    // All planes share the poles.
    assert_eq!(reading.intensities[0], reading.intensities[13]);
}

#[test]
fn a_glass_shell_sends_back_what_it_mirrors() {
    // What leaves the middle upwards passes by T = (1 − R) / (1 + R) and is mirrored by 1 − T, back through the middle, again and again.
    let mut scene = Scene::default();
    sphere(&mut scene, 0.1, true, glass());
    sphere(&mut scene, 0.11, false, glass());
    // Two cells, which are the halves of the sphere.
    let angles = Angles { c: vec![0.0], gamma: vec![45.0, 135.0] };
    let reading = measured(&scene, &Options { angles, ..options(point([0.0, 1.0])) }).expect("a reading");
    let passed = (1.0 - 0.04) / (1.0 + 0.04);
    let [up, down] = [1.0 / (2.0 - passed), (1.0 - passed) / (2.0 - passed)];
    near(reading.intensities[1], 100.0 * up, 5e-3);
    near(reading.intensities[0], 100.0 * down, 0.03);
    near(reading.fluxes.escaped.value, 200.0 * PI, 1e-3);
    assert!(reading.fluxes.absorbed.value.abs() < 0.5, "{:?}", reading.fluxes);
    let size = reading.opening.size();
    assert!(reading.opening.is_round() && (size[0] / 0.22 - 1.0).abs() < 0.05, "{:?}", reading.opening);
}

#[test]
fn a_closed_box_keeps_all() {
    let mut scene = Scene::default();
    sphere(&mut scene, 1.0, true, Material::diffuse(Origin::new("black"), [0.0; 3]));
    let reading = measured(&scene, &options(point([-1.0, 1.0]))).expect("a reading");
    assert_eq!(reading.fluxes.escaped.value, 0.0);
    near(reading.fluxes.absorbed.value, 400.0 * PI, 1e-5);
    assert!(reading.diagnostics[0].message.contains("1256.6 of 1256.6 lm never leave"), "{:?}", reading.diagnostics);
}

#[test]
fn a_mirror_turns_light_round() {
    let mut scene = Scene::default();
    let points = [[-9.0, -9.0, -0.1], [9.0, -9.0, -0.1], [9.0, 9.0, -0.1], [-9.0, 9.0, -0.1]];
    let mut mirror = Closure::default();
    mirror.set_colour("base_color", [0.8; 3]);
    mirror.set_colour("specular_color", [0.8; 3]);
    mirror.set("metalness", 1.0);
    mirror.set("specular_roughness", 0.0);
    add(&mut scene, &points, &[[0, 1, 2], [0, 2, 3]], Material::of(Origin::new("mirror"), mirror));
    // A cone of 15° straight down.
    let cone = 15.0_f64.to_radians().cos();
    let reading = measured(&scene, &options(point([-1.0, -cone]))).expect("a reading");
    let gammas = reading.angles.gamma.len();
    near(reading.intensities[gammas - 1], 80.0, 0.01);
    near(reading.fluxes.escaped.value, 0.8 * reading.fluxes.emitted.value, 0.01);
    assert_eq!(reading.intensities[0], 0.0);
}

#[test]
fn a_screen_below_has_its_illuminance() {
    let mut options = options(point([-1.0, 1.0]));
    options.screen = Some(Screen::below(2.0, [1.0, 1.0], [2, 2]));
    let reading = measured(&Scene::default(), &options).expect("a reading");
    let screen = reading.screen.expect("a screen");
    // I times the solid angle of a quarter, a rectangle of a × a at distance d from one corner: atan(a² / (d √(d² + 2 a²))).
    let solid = (0.25 / (2.0 * (4.0_f64 + 0.5).sqrt())).atan();
    for value in screen.illuminance {
        near(value, 100.0 * solid / 0.25, 0.03);
    }
}

#[test]
fn readings_are_the_same_on_any_number_of_threads() {
    let mut scene = Scene::default();
    sphere(&mut scene, 0.1, true, glass());
    sphere(&mut scene, 0.11, false, glass());
    let bits = |threads| {
        let reading = measured(&scene, &Options { threads, ..options(point([-1.0, 1.0])) }).expect("a reading");
        let values = reading.intensities.iter().chain(&reading.errors).chain([&reading.fluxes.absorbed.value]);
        (values.map(|value| value.to_bits()).collect::<Vec<_>>(), reading.opening.clone())
    };
    assert_eq!(bits(1), bits(2));
}

#[test]
fn the_rule_stops_when_it_is_exact_enough() {
    let mut options = options(point([-1.0, 1.0]));
    options.stop = Stop { error: 0.05, rays: 1 << 30, time: None };
    let reading = measured(&Scene::default(), &options).expect("a reading");
    assert!(reading.converged && reading.paths < 1 << 24 && reading.peak.relative_error() <= 0.05);
}

#[test]
fn what_cannot_be_measured_is_told() {
    let none = Options { rays: Vec::new(), ..options(Rays::default()) };
    let error = measured(&Scene::default(), &none).expect_err("no light");
    assert!(error.to_string().contains("no light"), "{error}");
    assert!(measured(&Scene::default(), &options(Rays::default())).is_err());
    let mut endless = options(point([-1.0, 1.0]));
    endless.stop.rays = 1 << 36;
    let stopped = measure(&Scene::default(), &endless, Execution::best(), &AtomicBool::new(false), &mut |progress| progress.paths == 0);
    assert!(matches!(stopped, Err(Error::Cancelled)), "{stopped:?}");
}
