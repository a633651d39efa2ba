//! Textures that light is baked into, against closed forms and against pictures of the same surfaces.

use gonio::{
    accel::NONE,
    bake::{BakeTarget, ViewFrom, bake},
    film::Image,
    scene::{Aov, Closure, Filter, LightPart, LightShape, Material, Origin, ScatteringKind, Scene, Settings, Transform},
};
use gonio_simd::Execution;
use gonio_tests::picture::{compiled, mean, render, settings};
use gonio_tests::scenes::{add_quad, camera_from_above, facing_down, floor, layered, light};
use std::f64::consts::PI;

/// The texture of a parallelogram by `add_quad`, seen as from its front: `v` upwards.
fn texture(instance: u32, pixels: u32) -> BakeTarget {
    let step = 1.0 / pixels as f32;
    let mut target = BakeTarget { instance, size: [pixels; 2], ..BakeTarget::default() };
    for number in 0..pixels * pixels {
        let (s, t) = ((number % pixels) as f32 * step + 0.5 * step, 1.0 - (number / pixels) as f32 * step - 0.5 * step);
        let is_lower = s >= t;
        target.triangles.push(u32::from(!is_lower));
        target.places.push(if is_lower { [s - t, t] } else { [s, t - s] });
        target.steps.push(if is_lower { [[step, 0.0], [step, -step]] } else { [[step, -step], [0.0, -step]] });
    }
    target
}

fn baked(scene: &Scene, target: &BakeTarget, settings: &Settings) -> Image {
    let mut baking = bake(scene, compiled(scene), target, settings, Execution::best()).expect("it starts");
    baking.finish().expect("it ends well");
    baking.film().develop()
}

fn problem(scene: &Scene, target: &BakeTarget) -> String {
    let settings = settings(1, 1, &[Aov::Color]);
    bake(scene, compiled(scene), target, &settings, Execution::best()).expect_err("it fits nothing").to_string()
}

/// A closed room of 4 × 4 × 3 m, lit by a panel and seen from right below its ceiling.
fn room() -> Scene {
    let mut scene = Scene::default();
    let material = |name: &str, colour: [f32; 3]| Material::diffuse(Origin::new(name), colour);
    let (x, y, z) = ([4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]);
    let back = |v: [f32; 3]| v.map(|x| -x);
    add_quad(&mut scene, [-2.0, 0.0, 2.0], x, back(z), material("floor", [0.6, 0.5, 0.4]));
    add_quad(&mut scene, [-2.0, 3.0, -2.0], x, z, material("ceiling", [0.8; 3]));
    add_quad(&mut scene, [-2.0, 0.0, -2.0], x, y, material("back", [0.5; 3]));
    add_quad(&mut scene, [2.0, 0.0, 2.0], back(x), y, material("front", [0.5; 3]));
    add_quad(&mut scene, [-2.0, 0.0, 2.0], back(z), y, material("left", [0.7, 0.2, 0.2]));
    add_quad(&mut scene, [2.0, 0.0, -2.0], z, y, material("right", [0.2, 0.2, 0.7]));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 0.5 }, facing_down([0.5, 2.9, 0.3]), [100.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 2.95, 0.0], 4.0));
    scene
}

#[test]
fn a_point_source_lights_each_texel_by_the_inverse_square_law() {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Point, Transform::translation([0.3, 3.0, -0.4]), [1000.0; 3]));
    let target = BakeTarget { steps: Vec::new(), ..texture(0, 9) };
    let wanted = [Aov::Color, Aov::Illuminance, Aov::P, Aov::Normal, Aov::Alpha];
    let image = baked(&scene, &target, &Settings { max_bounces: 0, ..settings(1, 1, &wanted) });
    let [colour, illuminance, position, normal] =
        [Aov::Color, Aov::Illuminance, Aov::P, Aov::Normal].map(|aov| &image.layer(aov).expect("a pass").values);
    for texel in 0..81 {
        let place = |number: usize| -10.0 + 20.0 * (number as f64 + 0.5) / 9.0;
        let (x, z) = (place(texel % 9), place(texel / 9));
        let expected = 1000.0 * 3.0 / ((x - 0.3).powi(2) + 9.0 + (z + 0.4).powi(2)).powf(1.5);
        assert!((f64::from(illuminance[texel]) / expected - 1.0).abs() < 1e-4, "{} at {x} {z}: {expected}", illuminance[texel]);
        assert!((f64::from(colour[texel * 4]) / (0.5 * expected / PI) - 1.0).abs() < 1e-4);
        assert!((f64::from(position[texel * 3]) - x).abs() < 1e-5 && (f64::from(position[texel * 3 + 2]) - z).abs() < 1e-5);
        assert_eq!(normal[texel * 3..texel * 3 + 3], [0.0, 1.0, 0.0]);
    }
    assert_eq!(mean(&image, Aov::Alpha, 0), 1.0);
}

#[test]
fn a_lightmap_is_what_a_picture_of_its_surface_shows() {
    let scene = room();
    let wanted = [
        Aov::Color,
        Aov::Illuminance,
        Aov::Light(ScatteringKind::Diffuse, LightPart::Direct),
        Aov::Light(ScatteringKind::Diffuse, LightPart::Indirect),
        Aov::Light(ScatteringKind::Diffuse, LightPart::Color),
    ];
    let settings = Settings { filter: Filter::Box, filter_width: 1.0, ..settings(24, 512, &wanted) };
    let seen = render(&compiled(&scene), &settings, Execution::best());
    let image = baked(&scene, &texture(0, 24), &settings);
    for aov in wanted {
        let channels = image.layer(aov).expect("a pass").channels.min(3);
        for channel in 0..channels {
            let (found, expected) = (mean(&image, aov, channel), mean(&seen, aov, channel));
            assert!((found / expected - 1.0).abs() < 3e-3, "{aov:?}: {found} instead of {expected}");
        }
        let values = |image: &Image| image.layer(aov).expect("a pass").values.clone();
        let (found, expected) = (values(&image), values(&seen));
        let sum = |f: &dyn Fn(f32, f32) -> f32| found.iter().zip(&expected).map(|(a, b)| f64::from(f(*a, *b))).sum::<f64>();
        // The same light in each texel, but for the noise of both.
        let apart = (sum(&|a, b| (a - b) * (a - b)) / sum(&|_, b| b * b)).sqrt();
        assert!(apart < 0.03, "{aov:?}: {apart}");
    }
    // A Lambertian surface sends E ρ/π.
    let found = mean(&image, Aov::Color, 0) / mean(&image, Aov::Illuminance, 0);
    assert!((found / (0.6 / PI / luminance_per_red(&image)) - 1.0).abs() < 1e-2, "{found}");
}

/// Red over luminance of the light that arrives, from the demodulated passes.
fn luminance_per_red(image: &Image) -> f64 {
    let light = |channel| {
        let part = |part| mean(image, Aov::Light(ScatteringKind::Diffuse, part), channel);
        part(LightPart::Direct) + part(LightPart::Indirect)
    };
    (0.2126 * light(0) + 0.7152 * light(1) + 0.0722 * light(2)) / light(0)
}

#[test]
fn what_is_baked_is_the_same_bits_for_any_number_of_threads() {
    let scene = room();
    let settings = settings(1, 8, &[Aov::Color, Aov::Illuminance]);
    let values = |threads| {
        let image = baked(&scene, &texture(0, 96), &Settings { threads, ..settings.clone() });
        image.layers.iter().flat_map(|layer| layer.values.clone()).collect::<Vec<f32>>()
    };
    assert_eq!(values(1), values(3));
}

#[test]
fn illuminance_alone_is_that_of_mirrors_too() {
    let mut scene = Scene::default();
    let mirror = layered([1.0; 3], &[("metalness", 1.0), ("specular_roughness", 0.0)]);
    add_quad(&mut scene, [-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], mirror);
    scene.lights.push(light(LightShape::Point, Transform::translation([0.0, 2.0, 0.0]), [80.0; 3]));
    let target = BakeTarget { steps: Vec::new(), ..texture(0, 1) };
    let image = baked(&scene, &target, &settings(1, 4, &[Aov::Illuminance]));
    assert!((mean(&image, Aov::Illuminance, 0) / 20.0 - 1.0).abs() < 1e-5, "{}", mean(&image, Aov::Illuminance, 0));
}

#[test]
fn a_mirror_shows_the_camera_what_it_shows_in_pictures() {
    let mut scene = Scene::default();
    let mirror = layered([1.0; 3], &[("metalness", 1.0), ("specular_roughness", 0.0)]);
    add_quad(&mut scene, [-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], mirror);
    // A shining wall to the right, which is seen in the mirror from the left only.
    let mut shining = Closure::default();
    shining.set_colour("emission_color", [7.0; 3]);
    shining.set("specular_weight", 0.0);
    add_quad(&mut scene, [3.0, 0.0, -20.0], [0.0, 0.0, 40.0], [0.0, 40.0, 0.0], Material::of(Origin::new("shining"), shining));
    let mut camera = camera_from_above([-3.0, 2.0, 0.0], 1.0);
    camera.projection = gonio::scene::Projection::Perspective { focal_length: 1.0 };
    scene.cameras.push(camera);
    let wanted = settings(1, 4, &[Aov::Color]);
    let of = |view| mean(&baked(&scene, &BakeTarget { view, ..texture(0, 4) }, &wanted), Aov::Color, 0);
    assert_eq!(of(ViewFrom::Above), 0.0);
    assert!((of(ViewFrom::Camera) / 7.0 - 1.0).abs() < 1e-4, "{}", of(ViewFrom::Camera));
}

#[test]
fn pixels_without_a_place_stay_empty() {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Point, Transform::translation([0.0, 3.0, 0.0]), [1000.0; 3]));
    let mut target = texture(0, 2);
    target.triangles[1] = NONE;
    target.places[2] = [f32::NAN; 2];
    let image = baked(&scene, &target, &settings(1, 1, &[Aov::Alpha]));
    assert_eq!(image.layer(Aov::Alpha).expect("a pass").values, [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn targets_that_fit_nothing_are_told() {
    let scene = floor(0.5);
    let target = texture(0, 2);
    assert!(problem(&scene, &BakeTarget { instance: 3, ..target.clone() }).contains("instance"));
    assert!(problem(&scene, &BakeTarget { triangles: vec![7; 4], ..target.clone() }).contains("number 7"));
    assert!(problem(&scene, &BakeTarget { places: Vec::new(), ..target.clone() }).contains("places"));
    assert!(problem(&scene, &BakeTarget { size: [0, 2], ..target.clone() }).contains("resolution"));
    assert!(problem(&scene, &BakeTarget { view: ViewFrom::Camera, ..target }).contains("camera"));
}

/// A floor beside a mirror or something black, seen from above.
fn beside(wall: Material) -> Scene {
    let mut scene = Scene::default();
    add_quad(&mut scene, [-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], Material::diffuse(Origin::new("floor"), [0.5; 3]));
    add_quad(&mut scene, [1.0, 0.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0], wall);
    scene.lights.push(light(LightShape::Sphere { radius: 0.3 }, facing_down([-0.5, 1.5, 0.0]), [10.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 3.0, 0.0], 1.5));
    scene
}

#[test]
fn without_reflective_caustics_mirrors_throw_no_light() {
    let mirror = beside(layered([1.0; 3], &[("metalness", 1.0), ("specular_roughness", 0.0)]));
    let black = beside(Material::diffuse(Origin::new("black"), [0.0; 3]));
    let seen = |scene: &Scene, caustic_paths| {
        let settings = Settings { caustic_paths, ..settings(16, 1024, &[Aov::Color]) };
        mean(&render(&compiled(scene), &settings, Execution::best()), Aov::Color, 0)
    };
    let [with, without, none] = [seen(&mirror, [true; 2]), seen(&mirror, [false, true]), seen(&black, [true; 2])];
    assert!((without / none - 1.0).abs() < 2e-3 && with > 1.05 * none, "{with} {without} {none}");
}

#[test]
fn clear_glass_before_nothing_is_transparent() {
    let mut scene = Scene::default();
    let glass = layered([1.0; 3], &[("transmission_weight", 1.0), ("specular_roughness", 0.0), ("specular_ior", 1.5)]);
    // A slab: light passes both of its faces.
    add_quad(&mut scene, [-9.0, 0.1, 9.0], [18.0, 0.0, 0.0], [0.0, 0.0, -18.0], glass.clone());
    add_quad(&mut scene, [-9.0, 0.0, -9.0], [18.0, 0.0, 0.0], [0.0, 0.0, 18.0], glass);
    scene.cameras.push(camera_from_above([0.0, 3.0, 0.0], 1.0));
    let background = gonio::scene::Background::Transparent;
    let alpha = |clear_roughness| {
        let settings = Settings { background, clear_roughness, ..settings(16, 1024, &[Aov::Alpha]) };
        mean(&render(&compiled(&scene), &settings, Execution::best()), Aov::Alpha, 0)
    };
    assert_eq!(alpha(None), 1.0);
    // All reflections within the slab together pass (1 − R)/(1 + R), some of it upwards.
    let reflectance = 0.04_f64;
    let passed = (1.0 - reflectance) / (1.0 + reflectance);
    let found = alpha(Some(0.1));
    assert!((found - (1.0 - passed)).abs() < 0.01, "{found} instead of {}", 1.0 - passed);
}
