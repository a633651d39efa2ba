//! Pictures by paths from the lights alone, beside path tracing.

use gonio::{
    Severity,
    compile::compile,
    film::Image,
    render::Render,
    scene::{
        Aov, Camera, Caustics, DomeFormat, Integrator, LightPart, LightShape, Material, Origin, Projection, ScatteringKind, Scene,
        Settings, Transform,
    },
};
use gonio_simd::Execution;
use gonio_tests::picture::{compiled, mean, render, settings};
use gonio_tests::scenes::{add_quad, camera_from_above, facing_down, floor, layered, light};
use std::sync::atomic::AtomicBool;

fn diffuse(reflectance: [f32; 3]) -> Material {
    Material::diffuse(Origin::new("wall"), reflectance)
}

/// A corner of two walls and a floor with a box's lid above it, lit by lamps of every finite shape and by the sun.
fn corner() -> Scene {
    let mut scene = floor(0.6);
    add_quad(&mut scene, [-2.0, 0.0, -1.5], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], diffuse([0.7, 0.3, 0.2]));
    add_quad(&mut scene, [-2.0, 0.0, 2.0], [0.0, 0.0, -3.5], [0.0, 3.0, 0.0], diffuse([0.2, 0.4, 0.7]));
    add_quad(&mut scene, [-0.5, 0.5, 0.6], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], layered([0.5; 3], &[("specular_roughness", 0.4)]));
    scene.lights.push(light(LightShape::Point, facing_down([0.8, 1.8, 0.9]), [3.0; 3]));
    scene.lights.push(light(LightShape::Rectangle { width: 0.5, height: 0.4 }, facing_down([-0.7, 2.2, 0.0]), [8.0, 6.0, 4.0]));
    scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, facing_down([1.0, 1.2, -0.7]), [3.0; 3]));
    scene.lights.push(light(LightShape::Cylinder { radius: 0.1, length: 0.6 }, facing_down([0.0, 1.6, 0.2]), [3.0; 3]));
    scene.lights.push(light(LightShape::Distant { angle_deg: 2.0 }, facing_down([0.0; 3]), [800.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 2.5));
    scene
}

/// Looks from the front into the corner.
fn standing() -> Camera {
    let transform = Transform { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5, 1.2, 3.5]] };
    Camera::perspective(Origin::new("camera"), transform, 40.0, 1.0)
}

fn picture(scene: &Scene, integrator: Integrator, samples: u32, aovs: &[Aov]) -> Image {
    render(&compiled(scene), &Settings { integrator, caustics: Caustics::Off, ..settings(32, samples, aovs) }, Execution::best())
}

/// Blocks of 8 × 8 pixels, relative: the largest difference between the two integrators.
fn differ(scene: &Scene, samples: [u32; 2], aov: Aov) -> [f64; 2] {
    let [by_light, by_path] = [(Integrator::Light, samples[0]), (Integrator::Path, samples[1])]
        .map(|(i, samples)| picture(scene, i, samples, &[Aov::Color, aov]));
    let mut worst = 0.0_f64;
    for block in 0..16 {
        let sum = |image: &Image| {
            let layer = image.layer(aov).expect("the pass");
            let pixel = |i: usize| (block / 4 * 8 + i / 8) * 32 + block % 4 * 8 + i % 8;
            (0..64).map(|i| f64::from(layer.values[pixel(i) * layer.channels + 1])).sum::<f64>()
        };
        let (found, expected) = (sum(&by_light), sum(&by_path));
        if expected > 0.0 {
            worst = worst.max((found / expected - 1.0).abs());
        }
    }
    [mean(&by_light, aov, 1) / mean(&by_path, aov, 1) - 1.0, worst]
}

#[test]
fn every_camera_sees_what_path_tracing_shows() {
    let around = Projection::Equirectangular { longitude: [-1.5, 1.5], latitude: [-1.2, 1.2] };
    let cameras = [
        camera_from_above([0.0, 5.0, 0.0], 2.5),
        standing(),
        Camera { lens_radius: 0.05, focus_distance: 4.0, ..standing() },
        Camera { projection: around, ..standing() },
        Camera { projection: Projection::FisheyeEquidistant { fov_deg: 180.0 }, ..standing() },
    ];
    for (number, camera) in cameras.into_iter().enumerate() {
        let scene = Scene { cameras: vec![camera], ..corner() };
        let [all, worst] = differ(&scene, [256, 256], Aov::Color);
        assert!(all.abs() < 0.01 && worst < 0.06, "camera {number}: {all:.4} in the mean, {worst:.4} in a block");
    }
}

#[test]
fn direct_and_indirect_light_go_into_their_passes() {
    // Of layered surfaces light paths part the kinds as the light sees them; these are diffuse.
    let mut scene = corner();
    scene.instances.truncate(3);
    for part in [LightPart::Direct, LightPart::Indirect] {
        let [all, worst] = differ(&scene, [512, 512], Aov::Light(ScatteringKind::Diffuse, part));
        assert!(all.abs() < 0.01 && worst < 0.06, "{part:?}: {all:.4}, {worst:.4}");
    }
}

#[test]
fn the_sky_and_rough_glass_are_brought_too() {
    let mut scene = corner();
    scene.lights = vec![light(LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY, [1.0; 3])];
    let [all, worst] = differ(&scene, [8192, 256], Aov::Color);
    assert!(all.abs() < 0.01 && worst < 0.06, "the sky: {all:.4}, {worst:.4}");
    // Frosted glass, a solid slab under the camera: light passes both of its sides. What such interfaces make up for by the angle that they are seen at
    // differs a little from both ends.
    let mut scene = corner();
    let frosted = [("transmission_weight", 1.0), ("specular_roughness", 0.5), ("specular_ior", 1.5)];
    for (height, up) in [(1.1, 1.0), (1.0, -1.0)] {
        add_quad(&mut scene, [-1.0, height, up], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0 * up], layered([1.0; 3], &frosted));
    }
    let [all, worst] = differ(&scene, [4096, 4096], Aov::Color);
    assert!(all.abs() < 0.03 && worst < 0.1, "rough glass: {all:.4}, {worst:.4}");
}

#[test]
fn pictures_are_the_same_bits_for_any_threads() {
    let scene = compiled(&corner());
    let settings = Settings { integrator: Integrator::Light, ..settings(80, 8, &[Aov::Color, Aov::Depth]) };
    let [one, two] = [1, 2].map(|threads| render(&scene, &Settings { threads, ..settings.clone() }, Execution::best()));
    assert_eq!(one, two);
}

#[test]
fn what_light_alone_does_not_show_is_told_once() {
    let mut scene = corner();
    // The mirrors would show the sun.
    scene.lights.truncate(4);
    let mirror = [("metalness", 1.0), ("specular_roughness", 0.0)];
    for x in [-0.5, 0.5] {
        add_quad(&mut scene, [x, 0.2, 0.9], [0.4, 0.0, 0.0], [0.0, 0.0, -0.4], layered([0.9; 3], &mirror));
    }
    let told = |integrator: Integrator| {
        let scene = Scene { settings: Settings { integrator, ..Settings::default() }, ..scene.clone() };
        let compiled = compile(&scene, None, &AtomicBool::new(false)).expect("it compiles");
        compiled.diagnostics.iter().filter(|d| d.severity == Severity::Warning).map(|d| d.message.clone()).collect::<Vec<_>>()
    };
    assert!(told(Integrator::Path).is_empty());
    assert!(matches!(&told(Integrator::Light)[..], [one] if one.contains("mirror")), "{:?}", told(Integrator::Light));
    // The room is not seen in the mirror, as no light path meets the camera there.
    let seen = picture(&scene, Integrator::Light, 16, &[Aov::Color, Aov::Depth]);
    let middle = |image: &Image, aov: Aov| {
        let layer = image.layer(aov).expect("the pass");
        // 0.7 m beside the middle and 0.7 m in front of it, of 2.5 m.
        layer.values[(25 * 32 + 25) * layer.channels]
    };
    assert_eq!(middle(&seen, Aov::Color), 0.0);
    assert!((middle(&seen, Aov::Depth) - 4.8).abs() < 0.01);
}

#[test]
fn what_has_no_light_paths_is_refused() {
    let refused = |scene: &Scene, changed: Settings| {
        let settings = Settings { integrator: Integrator::Light, ..changed };
        Render::start(compiled(scene), &settings, Execution::best()).expect_err("no light paths").to_string()
    };
    assert!(refused(&corner(), settings(8, 1, &[Aov::Illuminance])).contains("gonio map"));
    assert!(refused(&corner(), Settings { noise_threshold: 0.1, ..settings(8, 64, &[Aov::Color]) }).contains("noise threshold"));
    let mut caught = corner();
    caught.instances[0].shadow_catcher = true;
    assert!(refused(&caught, settings(8, 1, &[Aov::Color])).contains("shadow catchers"));
    // Without any light there is a black picture.
    let dark = Scene { lights: Vec::new(), ..corner() };
    assert_eq!(mean(&picture(&dark, Integrator::Light, 1, &[Aov::Color]), Aov::Color, 0), 0.0);
}
