//! Parameters out of range: nothing under a white sky of 1 is brighter than 1, and no pixel is without a number.

use gonio::{
    compile::{CompiledScene, compile},
    scene::{Aov, Channel, DomeFormat, Input, LightShape, Material, Operation, Origin, Scene, Transform},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{mean, render, settings},
    scenes::{add_quad, camera_from_above, layered, light},
};
use std::sync::{Arc, atomic::AtomicBool};

fn compiled(scene: &Scene) -> Arc<CompiledScene> {
    Arc::new(compile(scene, None, &AtomicBool::new(false)).expect("a scene"))
}

/// A floor under a sky of 1, seen from above.
fn under_sky(material: Material) -> Scene {
    let mut scene = Scene::default();
    add_quad(&mut scene, [-10.0, 0.0, 10.0], [20.0, 0.0, 0.0], [0.0, 0.0, -20.0], material);
    scene.cameras.push(camera_from_above([0.0, 1.0, 0.0], 1.0));
    scene.lights.push(light(LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY, [1.0; 3]));
    scene
}

/// The brightest pixel, and what was said.
fn seen(material: Material) -> (f64, Vec<String>) {
    let compiled = compiled(&under_sky(material));
    let image = render(&compiled, &settings(8, 64, &[Aov::Color, Aov::Luminance, Aov::Albedo]), Execution::best());
    let finite = image.layers.iter().all(|layer| layer.values.iter().all(|value| value.is_finite() && *value >= 0.0));
    assert!(finite, "{:?}", image.layers.iter().map(|layer| &layer.name).collect::<Vec<_>>());
    (mean(&image, Aov::Luminance, 0), compiled.diagnostics.iter().map(|found| found.message.clone()).collect())
}

#[test]
fn numbers_are_held_and_told_once() {
    for (name, value, told) in [
        ("coat_weight", 100.0, "'coat_weight' is 100, outside 0 to 1; 1 is used"),
        ("fuzz_weight", 1e38, "'fuzz_weight' is 1e38, outside 0 to 1; 1 is used"),
        ("geometry_opacity", 255.0, "'geometry_opacity' is 255, outside 0 to 1; 1 is used"),
        ("geometry_opacity", -3.0, "'geometry_opacity' is -3, outside 0 to 1; 0 is used"),
        ("metalness", f32::NAN, "'metalness' is NaN, outside 0 to 1; 0 is used"),
        ("specular_ior", f32::INFINITY, "'specular_ior' is inf, outside 0.001 to 1000; 1000 is used"),
        ("base_color", 80.0, "'base_color' is 80, outside 0 to 1; 1 is used"),
        ("transmission_weight", 255.0, "'transmission_weight' is 255"),
        ("subsurface_weight", -1e38, "'subsurface_weight' is -1e38"),
    ] {
        let (found, messages) = seen(layered([0.9; 3], &[(name, value)]));
        assert!(found < 1.02, "{name} {value}: {found}");
        assert_eq!(messages.iter().filter(|message| message.contains(told)).count(), 1, "{name} {value}: {messages:?}");
    }
    let (_, quiet) = seen(layered([0.9; 3], &[("coat_weight", 1.0), ("geometry_opacity", 0.5), ("specular_ior", 1.0)]));
    assert!(quiet.is_empty(), "{quiet:?}");
}

#[test]
fn what_graphs_give_is_held_too() {
    // From −5000 to 5000 over the picture, and no number where nothing is divided by nothing.
    for name in ["base_color", "coat_weight", "geometry_opacity", "metalness", "specular_ior", "fuzz_color", "thin_film_thickness"] {
        for operation in [Operation::Multiply, Operation::Divide] {
            let mut material = layered([0.9; 3], &[("specular_roughness", 0.3)]);
            let by = if operation == Operation::Multiply { 1e4 } else { 1e-38 };
            let position = material.graph.add(Operation::Position, vec![]);
            let wild = material.graph.add(operation, vec![Input::Node(position, Channel::Rgb), Input::Constant([by; 4])]);
            material.closures[0].set_input(name, Input::Node(wild, Channel::Rgb));
            let (found, _) = seen(material);
            assert!(found < 1.02, "{name}: {found}");
        }
    }
}

#[test]
fn weights_of_closures_are_held() {
    for weight in [5.0, 1e38, -1.0, f32::NAN, f32::INFINITY] {
        let mut material = Material::diffuse(Origin::new("floor"), [1.0; 3]);
        material.closures[0].weight = Input::Constant([weight; 4]);
        let (found, messages) = seen(material);
        assert!(found < 1.02, "{weight}: {found}");
        assert!(messages.iter().any(|message| message.contains("'weight'")), "{weight}: {messages:?}");
    }
}

#[test]
fn strengths_of_lights_end_where_sums_do() {
    let mut scene = under_sky(Material::diffuse(Origin::new("floor"), [1.0; 3]));
    for radiance in [f32::MAX, f32::INFINITY, f32::NAN] {
        scene.lights[0].emission.radiance = [radiance; 3];
        let compiled = compiled(&scene);
        let image = render(&compiled, &settings(8, 16, &[Aov::Color, Aov::Luminance, Aov::Illuminance]), Execution::best());
        assert!(image.layers.iter().flat_map(|layer| &layer.values).all(|value| value.is_finite()), "{radiance}");
        assert!(compiled.diagnostics.iter().any(|found| found.message.contains("strength")), "{radiance}: {:?}", compiled.diagnostics);
    }
}
