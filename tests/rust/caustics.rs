//! Light that mirrors and clear glass throw onto surfaces, brought by light paths.

use gonio::{
    checkpoint::{Identity, merge, write_checkpoint},
    film::Image,
    render::Render,
    scene::{Aov, Caustics, LightPart, LightShape, Material, ScatteringKind, Scene, Settings, Transform},
};
use gonio_simd::Execution;
use gonio_tests::picture::{compiled, mean, render};
use gonio_tests::scenes::{add_quad, add_triangles, camera_from_above, facing_down, floor, layered, light};
use std::f64::consts::PI;

/// Reflectance of glass of index 1.5 at normal incidence.
const R: f64 = 0.04;

fn glass() -> Material {
    layered([1.0; 3], &[("transmission_weight", 1.0), ("specular_roughness", 0.0), ("specular_ior", 1.5)])
}

/// A sphere about `centre` in flat facets that face outward, or inward.
fn add_sphere(scene: &mut Scene, centre: [f32; 3], radius: f32, outward: bool, material: Material) {
    const RINGS: u32 = 48;
    const SECTORS: u32 = 96;
    let place = |ring: u32, sector: u32| {
        let (theta, phi) = (ring as f32 / RINGS as f32 * PI as f32, sector as f32 / SECTORS as f32 * 2.0 * PI as f32);
        [centre[0] + radius * theta.sin() * phi.cos(), centre[1] + radius * theta.cos(), centre[2] + radius * theta.sin() * phi.sin()]
    };
    let points: Vec<[f32; 3]> = (0..=RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| place(ring, sector))).collect();
    let mut triangles = Vec::new();
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let next = (sector + 1) % SECTORS;
            let [a, b, c, d] = [[ring, sector], [ring, next], [ring + 1, next], [ring + 1, sector]].map(|[r, s]| r * SECTORS + s);
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                triangles.push(if outward { [p, q, r] } else { [p, r, q] });
            }
        }
    }
    add_triangles(scene, &points, &triangles, material);
}

/// What a point in the middle of a shell sends out if a black ball about it takes what comes back: (1 − R) / (1 + R).
fn with_black_ball(mut scene: Scene) -> Scene {
    let black = Material::diffuse(gonio::scene::Origin::new("black"), [0.0; 3]);
    add_sphere(&mut scene, [0.0, 1.5, 0.0], 0.1, true, black);
    scene.lights[0] = light(
        LightShape::Sphere { radius: 0.1003 },
        Transform::translation([0.0, 1.5, 0.0]),
        [100.0 / (PI * 0.1003 * 0.1003); 3].map(|x| x as f32),
    );
    scene
}

/// A point of 100 cd at 1.5 m in the middle of a glass shell, over a floor of reflectance 0.5; seen is a patch beside it.
fn shell() -> Scene {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Point, Transform::translation([0.0, 1.5, 0.0]), [100.0; 3]));
    add_sphere(&mut scene, [0.0, 1.5, 0.0], 0.25, true, glass());
    add_sphere(&mut scene, [0.0, 1.5, 0.0], 0.2, false, glass());
    scene.cameras = vec![camera_from_above([1.5, 5.0, 0.0], 1.5)];
    scene
}

/// A sphere lamp beside a glass ball and a mirror, over a floor.
fn ball() -> Scene {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Sphere { radius: 0.3 }, Transform::translation([0.0, 2.0, 0.0]), [100.0, 60.0, 30.0]));
    add_sphere(&mut scene, [0.0, 0.7, 0.0], 0.4, true, glass());
    let mirror = layered([0.9; 3], &[("metalness", 1.0), ("specular_roughness", 0.0)]);
    add_quad(&mut scene, [0.8, 0.0, 0.5], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], mirror);
    scene.cameras = vec![camera_from_above([0.3, 0.25, 0.0], 0.4)];
    scene
}

fn settings(pixels: u32, samples: u32, caustics: Caustics, aovs: &[Aov]) -> Settings {
    Settings { caustics, threads: 2, ..gonio_tests::picture::settings(pixels, samples, aovs) }
}

fn picture(scene: &Scene, settings: &Settings) -> Image {
    render(&compiled(scene), settings, Execution::best())
}

#[test]
fn a_lamp_in_a_shell_of_glass_lights_the_floor() {
    // I cos θ / d²: of what arrives at the shell (1 − R) / (1 + R) passes, and the rest comes back through the middle to pass on the other side.
    let image = picture(&shell(), &settings(64, 512, Caustics::Auto, &[Aov::Color]));
    const STEPS: usize = 64;
    let at = |i: usize| ((i as f64 + 0.5) / STEPS as f64 - 0.5) * 1.5;
    let sum: f64 = (0..STEPS * STEPS).map(|i| 1.5 / ((1.5 + at(i % STEPS)).powi(2) + 1.5 * 1.5 + at(i / STEPS).powi(2)).powf(1.5)).sum();
    let expected = 0.5 / PI * 100.0 * sum / (STEPS * STEPS) as f64;
    let found = mean(&image, Aov::Color, 0);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} instead of {expected}");
    let absorbing = picture(&with_black_ball(shell()), &settings(64, 512, Caustics::Auto, &[Aov::Color]));
    let (found, expected) = (mean(&absorbing, Aov::Color, 0), expected * (1.0 - R) / (1.0 + R));
    assert!((found / expected - 1.0).abs() < 0.01, "{found} instead of {expected} around a black ball");
    let dark = picture(&shell(), &settings(32, 4, Caustics::Off, &[Aov::Color]));
    assert_eq!(mean(&dark, Aov::Color, 0), 0.0);
}

#[test]
fn the_sun_comes_through_a_pane_of_solid_glass() {
    let mut scene = floor(0.02);
    let sun = light(LightShape::Distant { angle_deg: 0.53 }, facing_down([0.0; 3]), [1.0e6; 3]);
    scene.lights.push(sun);
    let [low, high] = [1.0, 1.1];
    let corners = |y: f32| [[-1.0, y, 1.0], [1.0, y, 1.0], [1.0, y, -1.0], [-1.0, y, -1.0]];
    let points: Vec<[f32; 3]> = corners(high).into_iter().chain(corners(low)).collect();
    let mut sides = vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]];
    for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        sides.extend([[a, a + 4, b + 4], [a, b + 4, b]]);
    }
    add_triangles(&mut scene, &points, &sides, glass());
    scene.cameras = vec![camera_from_above([0.0, 0.5, 0.0], 1.4)];
    let found = mean(&picture(&scene, &settings(64, 256, Caustics::On, &[Aov::Color])), Aov::Color, 0);
    let half_angle = 0.265_f64.to_radians();
    let expected = 0.02 / PI * 1.0e6 * PI * half_angle.sin().powi(2) * (1.0 - R) / (1.0 + R);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} instead of {expected}");
}

#[test]
fn each_path_of_light_is_brought_once() {
    // A lamp that camera paths find too: both ways in the mean the same, with every pass.
    let direct = [ScatteringKind::Diffuse, ScatteringKind::Glossy].map(|kind| Aov::Light(kind, LightPart::Direct));
    let indirect = [ScatteringKind::Diffuse, ScatteringKind::Glossy].map(|kind| Aov::Light(kind, LightPart::Indirect));
    let aovs: Vec<Aov> = [Aov::Color, Aov::Luminance].into_iter().chain(direct).chain(indirect).collect();
    let [on, off] =
        [(Caustics::On, 256), (Caustics::Off, 4096)].map(|(caustics, samples)| picture(&ball(), &settings(32, samples, caustics, &aovs)));
    for (aov, channels, allowed) in [(Aov::Color, 3, 0.01), (Aov::Luminance, 1, 0.01), (aovs[4], 3, 0.01), (aovs[2], 3, 0.03)] {
        for channel in 0..channels {
            let (with, without) = (mean(&on, aov, channel), mean(&off, aov, channel));
            assert!((with / without - 1.0).abs() < allowed, "{aov:?} {channel}: {with} with light paths, {without} without");
        }
    }
}

#[test]
fn pictures_are_the_same_bits_for_any_threads_and_parts() {
    let scene = Scene { settings: settings(100, 32, Caustics::On, &[Aov::Color]), ..ball() };
    let compiled = compiled(&scene);
    let whole = render(&compiled, &scene.settings, Execution::best());
    let alone = render(&compiled, &Settings { threads: 1, ..scene.settings.clone() }, Execution::best());
    assert_eq!(whole, alone);
    let folder = std::env::temp_dir().join(format!("gonio-caustics-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut files = Vec::new();
    for (number, (tiles, samples)) in [([0, 1], [0, 32]), ([1, 4], [0, 16]), ([1, 4], [16, 32])].into_iter().enumerate() {
        let part = Settings { tile_range: Some(tiles), sample_range: Some(samples), ..scene.settings.clone() };
        let mut part_render = Render::start(compiled.clone(), &part, Execution::best()).expect("a render");
        part_render.finish().expect("an end");
        let path = folder.join(format!("{number}.gonio"));
        let identity = Identity::new(&Scene { settings: part, ..scene.clone() }, Execution::best(), Vec::new());
        write_checkpoint(&path, &identity, part_render.film()).expect("a file");
        files.push(path);
    }
    let merged = merge(&files).expect("a film").film.develop();
    std::fs::remove_dir_all(&folder).expect("gone");
    assert_eq!(merged, whole);
}

#[test]
fn what_the_camera_does_not_see_shows_no_caustics() {
    let mut scene = shell();
    scene.instances[0].visibility.camera = false;
    assert_eq!(mean(&picture(&scene, &settings(32, 8, Caustics::Auto, &[Aov::Color])), Aov::Color, 0), 0.0);
}

#[test]
fn a_floor_under_glass_is_as_bright_as_camera_paths_find_it() {
    // Photons within glass: radiance there is kept without the squared index.
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Sphere { radius: 0.4 }, Transform::translation([0.0, 2.0, 0.0]), [100.0; 3]));
    let corners = |y: f32| [[-1.0, y, 1.0], [1.0, y, 1.0], [1.0, y, -1.0], [-1.0, y, -1.0]];
    let points: Vec<[f32; 3]> = corners(0.3).into_iter().chain(corners(-0.1)).collect();
    let mut sides = vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]];
    for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        sides.extend([[a, a + 4, b + 4], [a, b + 4, b]]);
    }
    add_triangles(&mut scene, &points, &sides, glass());
    scene.cameras = vec![camera_from_above([0.0, 1.0, 0.0], 0.5)];
    let [on, off] = [(Caustics::On, 64), (Caustics::Off, 4096)]
        .map(|(caustics, samples)| mean(&picture(&scene, &settings(32, samples, caustics, &[Aov::Color])), Aov::Color, 0));
    assert!((on / off - 1.0).abs() < 0.02, "{on} with light paths, {off} without");
}
