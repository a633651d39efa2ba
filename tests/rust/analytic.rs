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

#[test]
fn a_scene_far_from_the_origin_keeps_its_precision() {
    let far = [4.0e6, -1.0e6, 7.0e6];
    let mut scene = tiny_view(floor(0.0));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.0, 2.0, 0.0]), [1.0; 3]));
    let moved = |transform: &mut gonio::scene::Transform| (0..3).for_each(|i| transform.columns[3][i] += far[i]);
    moved(&mut scene.instances[0].transforms[0]);
    moved(&mut scene.lights[0].transform);
    moved(&mut scene.cameras[0].transform);
    let found = illuminance(&scene, &settings(16, 64, &[Aov::Illuminance]));
    let expected = under_square(1.0, 2.0);
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} instead of {expected}");
}

#[test]
fn the_inside_of_a_shining_box_is_a_geometric_series() {
    // Every wall emits 1 and reflects a half: L = 1 + 1/2 + 1/4 … = 2 everywhere; a leak or a self-shadow would show as less.
    let mut scene = Scene::default();
    let corners: Vec<[f32; 3]> = (0..8u8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.5 } else { 1.5 })).collect();
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|q: &[u32; 4]| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    let mut material = gonio::scene::Material::diffuse(gonio::scene::Origin::new("wall"), [0.5; 3]);
    material.closures[0].set_colour("emission_color", [1.0; 3]);
    gonio_tests::scenes::add_triangles(&mut scene, &corners, &triangles, material);
    scene.cameras.push(camera_from_above([0.1, 1.2, 0.2], 2.0));
    let settings = Settings { max_bounces: 64, ..settings(32, 64, &[Aov::Luminance, Aov::Illuminance]) };
    let image = render(&compiled(&scene), &settings, Execution::best());
    // 65,536 paths with a standard deviation of about 0.7: five standard errors are 0.014.
    assert!((mean(&image, Aov::Luminance, 0) - 2.0).abs() < 0.014, "{}", mean(&image, Aov::Luminance, 0));
    let expected = 2.0 * std::f64::consts::PI;
    assert!((mean(&image, Aov::Illuminance, 0) - expected).abs() < 0.05, "{}", mean(&image, Aov::Illuminance, 0));
}

#[test]
fn absorbing_glass_dims_by_beer_and_lambert() {
    // A slab of 0.1 m that turns white to 0.5 in 0.1 m, seen straight through against a dome of 1: T² · 0.5 over its inner reflections.
    let mut scene = Scene::default();
    let mut glass = gonio::scene::Closure::default();
    glass.set("transmission_weight", 1.0);
    glass.set("specular_roughness", 0.0);
    glass.set_colour("transmission_color", [0.5; 3]);
    glass.set("transmission_depth", 0.1);
    let glass = gonio::scene::Material::of(gonio::scene::Origin::new("glass"), glass);
    gonio_tests::scenes::add_quad(&mut scene, [-5.0, 0.1, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], glass.clone());
    gonio_tests::scenes::add_quad(&mut scene, [-5.0, 0.0, -5.0], [10.0, 0.0, 0.0], [0.0, 0.0, 10.0], glass);
    let dome = LightShape::Dome { format: gonio::scene::DomeFormat::Automatic };
    scene.lights.push(light(dome, gonio::scene::Transform::IDENTITY, [1.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 1.0, 0.0], 1e-3));
    let settings = Settings { max_bounces: 64, ..settings(32, 64, &[Aov::Luminance]) };
    let found = mean(&render(&compiled(&scene), &settings, Execution::best()), Aov::Luminance, 0);
    let (reflected, passed) = (0.04_f64, 0.5_f64);
    let series = 1.0 / (1.0 - (reflected * passed).powi(2));
    let through = (1.0 - reflected) * (1.0 - reflected) * passed * series;
    let back = reflected + (1.0 - reflected) * (1.0 - reflected) * reflected * passed * passed * series;
    let expected = through + back;
    assert!((found / expected - 1.0).abs() < 0.01, "{found} instead of {expected}");
}
