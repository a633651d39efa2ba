//! Trees of rays against closed forms and paths; the same bits for any number of threads.

use gonio::scene::{Aov, DomeFormat, Emission, Filter, Integrator, Light, LightShape, Origin, Scene, Settings, Transform};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{add_quad, camera_from_above, cut_out, facing_down, floor, layered, light, varied},
};
use std::f64::consts::PI;

/// Settings for one sample a pixel of a tree.
fn whitted(pixels: u32) -> Settings {
    Settings { integrator: Integrator::Whitted, filter: Filter::Box, filter_width: 1.0, ..settings(pixels, 1, &[Aov::Color]) }
}

#[test]
fn a_point_light_has_its_closed_form() {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Point, facing_down([0.0, 2.0, 0.0]), [100.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 0.01));
    let found = mean(&render(&compiled(&scene), &whitted(8), Execution::best()), Aov::Color, 1);
    let expected = 100.0 / 4.0 * 0.5 / PI;
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} instead of {expected}");
}

#[test]
fn a_panels_samples_stand_for_its_light() {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 0.6 }, facing_down([0.3, 1.5, 0.0]), [10.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 4.0));
    let scene = compiled(&scene);
    let path = Settings { integrator: Integrator::Direct, ..settings(32, 256, &[Aov::Color]) };
    let [found, expected] = [whitted(32), path].map(|with| mean(&render(&scene, &with, Execution::best()), Aov::Color, 0));
    // 16 fixed samples of a smooth integrand over a panel as near as its size.
    assert!((found / expected - 1.0).abs() < 5e-3, "{found} instead of {expected}");
}

#[test]
fn clear_things_in_a_furnace_vanish() {
    let mut scene = Scene::default();
    let glass = layered([1.0; 3], &[("transmission_weight", 1.0), ("specular_roughness", 0.0)]);
    for height in 0..3u16 {
        add_quad(&mut scene, [-5.0, f32::from(height), 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], glass.clone());
    }
    let emission = Emission { radiance: [2.0; 3], ..Emission::default() };
    let dome = Light::new(Origin::new("dome"), LightShape::Dome { format: DomeFormat::LatLong }, Transform::IDENTITY);
    scene.lights.push(Light { emission, ..dome });
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 1.0));
    let found = mean(&render(&compiled(&scene), &whitted(16), Execution::best()), Aov::Color, 0);
    // What is cut off has been reflected twice at four per cent and more.
    assert!((found / 2.0 - 1.0).abs() < 0.02, "{found}");
}

#[test]
fn what_opacity_leaves_open_counts_by_its_share() {
    let image = render(&compiled(&cut_out(0.3)), &whitted(16), Execution::best());
    let coverage = mean(&image, Aov::Color, 3);
    assert!((coverage - 0.3).abs() < 1e-5, "{coverage}");
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = compiled(&varied());
    let base = Settings { aovs: vec![Aov::Color, Aov::Normal, Aov::Illuminance], samples: 3, ..whitted(130) };
    let [one, three] = [1, 3].map(|threads| render(&scene, &Settings { threads, ..base.clone() }, Execution::best()));
    assert!(one == three);
}

#[test]
fn levels_agree() {
    let scene = compiled(&varied());
    let best = mean(&render(&scene, &whitted(64), Execution::best()), Aov::Color, 0);
    for execution in Execution::all() {
        let found = mean(&render(&scene, &whitted(64), execution), Aov::Color, 0);
        assert!((found / best - 1.0).abs() < 1e-3, "{}: {found} instead of {best}", execution.name());
    }
}
