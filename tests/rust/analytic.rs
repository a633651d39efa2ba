//! Pictures with closed-form answers.

use gonio::scene::{Aov, LightShape, Scene, Settings};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{camera_from_above, facing_down, floor, light},
};

/// Illuminance of a horizontal point under the middle of a parallel square of side `a` at height `h` and luminance 1:
/// E = 4 · (x / √(1 + x²)) · atan(x / √(1 + x²)), x = a / 2h (view factor of a rectangle from a point under its corner, four times).
fn under_square(a: f64, h: f64) -> f64 {
    let x = a / (2.0 * h);
    let s = (1.0 + x * x).sqrt();
    4.0 * (x / s) * (x / s).atan()
}

fn illuminance(scene: &Scene, settings: &Settings) -> f64 {
    mean(&render(&compiled(scene), settings, Execution::best()), Aov::Illuminance, 0)
}

fn tiny_view(mut scene: Scene) -> Scene {
    scene.cameras.push(camera_from_above([0.0, 1.0, 0.0], 1e-3));
    scene
}

#[test]
fn square_light_over_a_point() {
    let mut scene = tiny_view(floor(0.0));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.0, 2.0, 0.0]), [1.0; 3]));
    let found = illuminance(&scene, &settings(16, 64, &[Aov::Illuminance]));
    let expected = under_square(1.0, 2.0);
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} instead of {expected}");
}

#[test]
fn disk_light_over_a_point() {
    // E = π r² / (r² + h²) for luminance 1.
    let mut scene = tiny_view(floor(0.0));
    scene.lights.push(light(LightShape::Disk { radius: 0.5 }, facing_down([0.0, 1.5, 0.0]), [1.0; 3]));
    let found = illuminance(&scene, &settings(16, 64, &[Aov::Illuminance]));
    let expected = std::f64::consts::PI * 0.25 / (0.25 + 2.25);
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} instead of {expected}");
}

#[test]
fn sphere_light_over_a_point() {
    // E = π (r / d)² for luminance 1.
    let mut scene = tiny_view(floor(0.0));
    scene.lights.push(light(LightShape::Sphere { radius: 0.5 }, facing_down([0.0, 2.0, 0.0]), [1.0; 3]));
    let found = illuminance(&scene, &settings(16, 64, &[Aov::Illuminance]));
    let expected = std::f64::consts::PI / 16.0;
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} instead of {expected}");
}

#[test]
fn constant_dome_over_a_floor() {
    // E = π L; a white floor under a white sky shines like the sky.
    let mut scene = tiny_view(floor(1.0));
    let dome = LightShape::Dome { format: gonio::scene::DomeFormat::Automatic };
    scene.lights.push(light(dome, gonio::scene::Transform::IDENTITY, [1.0; 3]));
    let image = render(&compiled(&scene), &settings(16, 64, &[Aov::Color, Aov::Luminance, Aov::Illuminance]), Execution::best());
    let found = [mean(&image, Aov::Illuminance, 0), mean(&image, Aov::Luminance, 0), mean(&image, Aov::Color, 3)];
    let expected = [std::f64::consts::PI, 1.0, 1.0];
    for (found_one, (expected, tolerance)) in found.iter().zip(expected.iter().zip([5e-3, 2e-3, 1e-6])) {
        assert!((found_one - expected).abs() < tolerance, "{found:?}");
    }
}
