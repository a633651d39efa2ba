//! Shapes and beams of lights, and panoramas, with closed-form answers.

use gonio::scene::{Aov, Camera, DomeFormat, Light, LightShape, Origin, Projection, Scene, Settings, Spot, Transform};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{camera_from_above, facing_down, floor, light},
};
use std::f64::consts::PI;

/// Illuminance of a floor's point a given height below a light.
fn below(lamp: Light, samples: u32) -> f64 {
    let mut scene = floor(0.0);
    scene.cameras.push(camera_from_above([0.0, 0.1, 0.0], 1e-3));
    scene.lights.push(lamp);
    let image = render(&compiled(&scene), &settings(16, samples, &[Aov::Illuminance]), Execution::best());
    mean(&image, Aov::Illuminance, 0)
}

fn lamp(shape: LightShape, height: f64) -> Light {
    light(shape, facing_down([0.0, height, 0.0]), [1.0; 3])
}

fn check(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} instead of {expected}");
}

#[test]
fn a_disk_that_faces_the_point() {
    // E = π r² / (r² + h²), from outside and from inside the sphere it turns in.
    for height in [2.0, 0.7, 0.3] {
        check(below(lamp(LightShape::FacingDisk { radius: 0.5 }, height), 64), PI * 0.25 / (0.25 + height * height), 3e-3);
    }
}

#[test]
fn a_point_and_its_cone() {
    check(below(lamp(LightShape::Point, 2.0), 4), 0.25, 1e-4);
    let spot = |angle_deg| Some(Spot { angle_deg, blend: 0.5, stretch: [1.0; 2] });
    check(below(Light { spot: spot(60.0), ..lamp(LightShape::Point, 2.0) }, 4), 0.25, 1e-4);
    // Beside the cone.
    let tilted = Light {
        transform: Transform { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 2.0, 0.0]] },
        spot: spot(60.0),
        ..lamp(LightShape::Point, 2.0)
    };
    assert_eq!(below(tilted, 4), 0.0);
}

#[test]
fn an_ellipse_from_afar() {
    check(below(lamp(LightShape::Ellipse { width: 0.2, height: 0.1 }, 4.0), 16), PI * 0.1 * 0.05 / 16.0, 2e-3);
}

#[test]
fn a_beam_that_spreads_little_lights_like_an_endless_plane() {
    for shape in [LightShape::Rectangle { width: 2.0, height: 2.0 }, LightShape::Disk { radius: 1.0 }] {
        for spread_deg in [60.0, 20.0, 2.0] {
            check(below(Light { spread_deg, ..lamp(shape, 0.5) }, 64), PI, 5e-3);
        }
    }
}

#[test]
fn portals_leave_the_sky_as_it_is() {
    let mut scene = floor(0.0);
    scene.cameras.push(camera_from_above([0.0, 0.1, 0.0], 1e-3));
    scene.lights.push(light(LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY, [1.0; 3]));
    scene.lights.push(Light { portal: true, ..lamp(LightShape::Rectangle { width: 1.0, height: 2.0 }, 1.0) });
    let image = render(&compiled(&scene), &settings(16, 256, &[Aov::Illuminance]), Execution::best());
    check(mean(&image, Aov::Illuminance, 0), PI, 5e-3);
}

#[test]
fn fisheyes_see_a_round_picture() {
    let mut scene = Scene::default();
    scene.lights.push(Light::new(Origin::new("sky"), LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY));
    let projections = [
        (Projection::FisheyeEquidistant { fov_deg: 180.0 }, PI / 4.0),
        (Projection::FisheyeEquisolid { focal_length: 10.0, fov_deg: 120.0, sensor: [20.0; 2] }, PI / 4.0),
        (Projection::Equirectangular { longitude: [-PI, PI], latitude: [-0.5 * PI, 0.5 * PI] }, 1.0),
    ];
    for (projection, share) in projections {
        scene.cameras = vec![Camera::panorama(Origin::new("panorama"), Transform::IDENTITY, projection)];
        let settings = Settings { resolution: [64, 64], ..settings(64, 16, &[Aov::Color]) };
        let image = render(&compiled(&scene), &settings, Execution::best());
        check(mean(&image, Aov::Color, 0), share, 5e-3);
    }
}
