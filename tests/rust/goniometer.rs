//! The virtual goniophotometer on lights whose intensities have closed forms.

use gonio::{
    goniometer::{Angles, Frame, Options, Progress, Reading, Stop, measure},
    scene::{LightShape, Material, Origin, Scene, Transform},
};
use gonio_simd::Execution;
use gonio_tests::scenes::{add_quad, light};
use std::{f64::consts::PI, sync::atomic::AtomicBool};

fn measured(scene: &Scene, options: &Options) -> Reading {
    let reading = measure(scene, options, Execution::best(), &AtomicBool::new(false), &mut |_: &Progress| true);
    reading.expect("the measurement ends well")
}

fn options(rays: u64) -> Options {
    Options {
        frame: Frame::default(),
        angles: Angles::regular(45.0, 15.0).expect("steps that fit"),
        stop: Stop { error: 0.0, rays, time: None },
        symmetry: None,
        rays: Vec::new(),
        screen: None,
        seed: 0,
        threads: 2,
    }
}

fn lamp(shape: LightShape, radiance: f32) -> Scene {
    let mut scene = Scene::default();
    scene.lights.push(light(shape, Transform::IDENTITY, [radiance; 3]));
    scene
}

/// Intensities against a closed form of γ in degrees, within a share of the peak.
fn check(reading: &Reading, expected: impl Fn(f64) -> f64, share: f64) {
    let peak = reading.angles.gamma.iter().map(|gamma| expected(*gamma)).fold(0.0, f64::max);
    for (place, found) in reading.intensities.iter().enumerate() {
        let [c, gamma] = reading.direction(place);
        assert!((found - expected(gamma)).abs() < share * peak, "C {c} γ {gamma}: {found} instead of {}", expected(gamma));
    }
}

#[test]
fn a_point_of_a_hundred_candela() {
    let reading = measured(&lamp(LightShape::Point, 100.0), &options(1 << 20));
    check(&reading, |_| 100.0, 0.01);
    for flux in [reading.fluxes.emitted, reading.fluxes.escaped] {
        assert!((flux.value / (400.0 * PI) - 1.0).abs() < 1e-3, "{flux:?}");
    }
    assert_eq!((reading.fluxes.cut_off.value, reading.opening.size()), (0.0, [0.0; 3]));
}

#[test]
fn a_disk_follows_lamberts_law() {
    // I0 = L A; the flux is π I0.
    let (radius, radiance) = (0.1, 1000.0);
    let mut fine = options(1 << 22);
    fine.angles = Angles::regular(90.0, 5.0).expect("steps that fit");
    let reading = measured(&lamp(LightShape::Disk { radius }, radiance), &fine);
    let peak = f64::from(radiance) * PI * radius * radius;
    check(&reading, |gamma| if gamma < 90.0 { peak * gamma.to_radians().cos() } else { 0.0 }, 0.012);
    assert!((reading.fluxes.escaped.value / (PI * peak) - 1.0).abs() < 1e-3);
    let size = reading.opening.size();
    assert!(reading.opening.is_round() && (size[0] / (2.0 * radius) - 1.0).abs() < 0.03 && size[2] == 0.0, "{:?}", reading.opening);
}

#[test]
fn a_box_without_a_way_out_keeps_all_light() {
    let mut scene = lamp(LightShape::Sphere { radius: 0.1 }, 1000.0);
    let black = || Material::diffuse(Origin::new("black"), [0.0; 3]);
    for side in [-1.0, 1.0] {
        add_quad(&mut scene, [side, -1.0, -1.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], black());
        add_quad(&mut scene, [-1.0, side, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], black());
        add_quad(&mut scene, [-1.0, -1.0, side], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], black());
    }
    let reading = measured(&scene, &options(1 << 18));
    let flux = 4.0 * PI * PI * 0.01 * 1000.0;
    assert_eq!(reading.fluxes.escaped.value, 0.0);
    assert!((reading.fluxes.absorbed.value / flux - 1.0).abs() < 2e-3, "{:?}", reading.fluxes);
    assert!(reading.diagnostics.iter().any(|diagnostic| diagnostic.message.contains("never leave")), "{:?}", reading.diagnostics);
}

#[test]
fn white_paper_above_a_lamp_adds_what_falls_on_it() {
    // Half of the light falls on an endless white plane: all of it goes down, with I0 cos γ of π I0 = 2 π · 100 on top of the lamp's own.
    let mut scene = lamp(LightShape::Point, 100.0);
    add_quad(&mut scene, [-500.0, -500.0, 0.05], [1000.0, 0.0, 0.0], [0.0, 1000.0, 0.0], Material::diffuse(Origin::new("paper"), [1.0; 3]));
    let reading = measured(&scene, &options(1 << 22));
    let below = reading.intensities.iter().enumerate().filter(|(place, _)| reading.direction(*place)[1] < 80.0);
    for (place, found) in below {
        let expected = 100.0 + 200.0 * reading.direction(place)[1].to_radians().cos();
        assert!((found / expected - 1.0).abs() < 0.02, "{:?}: {found} instead of {expected}", reading.direction(place));
    }
}

#[test]
fn the_same_bits_on_one_thread_and_two() {
    let mut scene = lamp(LightShape::Disk { radius: 0.1 }, 1000.0);
    add_quad(&mut scene, [-1.0, -1.0, -0.5], [1.5, 0.0, 0.0], [0.0, 1.5, 0.0], Material::diffuse(Origin::new("paper"), [0.7; 3]));
    let bits = |threads| {
        let reading = measured(&scene, &Options { threads, ..options(1 << 19) });
        reading.intensities.iter().chain(&reading.errors).map(|value| value.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(bits(1), bits(2));
}

#[test]
fn lights_at_infinity_are_no_part_of_a_luminaire() {
    let mut scene = lamp(LightShape::Point, 100.0);
    scene.lights.push(light(LightShape::Distant { angle_deg: 0.5 }, Transform::IDENTITY, [1.0; 3]));
    let reading = measured(&scene, &options(1 << 18));
    assert!((reading.fluxes.emitted.value / (400.0 * PI) - 1.0).abs() < 1e-3 && reading.diagnostics.len() == 1);
}
