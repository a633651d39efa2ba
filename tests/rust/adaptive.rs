//! Adaptive sampling: the same bits for any threads, the samples where the noise is, and nearly the mean of uniform sampling.

use gonio::{
    compile::CompiledScene,
    film::Image,
    scene::{Aov, LightShape, Material, Origin, Scene, Settings},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, render, settings},
    scenes::{add_quad, camera_from_above, facing_down, floor, light},
};
use std::sync::Arc;

const SIDE: usize = 64;
const ZONE: usize = 8;

/// A floor half of which lies in the smooth light of a large lamp; over the other half stands a wall that a small one shines on: hard shadows,
/// light that bounces, and edges.
fn scene() -> Arc<CompiledScene> {
    let mut scene: Scene = floor(0.8);
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 4.0));
    add_quad(&mut scene, [0.5, 0.5, -0.7], [0.9, 0.0, 0.0], [0.0, 0.0, 1.1], Material::diffuse(Origin::new("table"), [0.7, 0.3, 0.2]));
    scene.lights.push(light(LightShape::Sphere { radius: 0.05 }, facing_down([1.6, 0.3, 0.4]), [900.0; 3]));
    scene.lights.push(light(LightShape::Rectangle { width: 8.0, height: 8.0 }, facing_down([0.0, 9.0, 0.0]), [1.0; 3]));
    compiled(&scene)
}

fn adaptive(samples: u32, threshold: f32, seed: u32) -> Settings {
    Settings { noise_threshold: threshold, seed, ..settings(SIDE as u32, samples, &[Aov::Color, Aov::SampleCount]) }
}

/// Samples of each zone, and its mean luminance.
fn zones(image: &Image) -> Vec<(f32, f64)> {
    let (color, count) = (image.layer(Aov::Color).expect("asked for"), image.layer(Aov::SampleCount).expect("asked for"));
    let zone = |number: usize| {
        let pixels = (0..ZONE * ZONE).map(|i| (number / 8 * ZONE + i / ZONE) * SIDE + number % 8 * ZONE + i % ZONE);
        let luminance = |pixel: usize| {
            let at = |channel: usize| f64::from(color.values[4 * pixel + channel]);
            0.2126 * at(0) + 0.7152 * at(1) + 0.0722 * at(2)
        };
        (count.values[pixels.clone().next().unwrap_or(0)], pixels.map(luminance).sum::<f64>() / (ZONE * ZONE) as f64)
    };
    (0..(SIDE / ZONE).pow(2)).map(zone).collect()
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = scene();
    let with = |threads| render(&scene, &Settings { threads, ..adaptive(512, 0.02, 0) }, Execution::best());
    let one = with(1);
    assert!(one == with(2) && one == with(5));
    assert!(one.samples >= 50 && one.mean_samples < 500.0, "{} to {}", one.samples, one.mean_samples);
}

#[test]
fn a_zone_that_ends_has_the_bits_of_fewer_samples() {
    let scene = scene();
    let image = render(&scene, &adaptive(256, 0.03, 4), Execution::best());
    let counts: Vec<u32> = zones(&image).iter().map(|(count, _)| *count as u32).collect();
    let least = image.samples;
    assert!(counts.iter().any(|count| *count > least));
    let fewer = Settings { noise_threshold: 0.0, sample_range: Some([0, least]), ..adaptive(256, 0.0, 4) };
    let fewer = render(&scene, &fewer, Execution::best());
    let pairs = zones(&image).into_iter().zip(zones(&fewer)).filter(|(adaptive, _)| adaptive.0 as u32 == least);
    assert!(pairs.clone().count() > 0);
    assert!(pairs.into_iter().all(|(adaptive, uniform)| adaptive == uniform));
}

#[test]
fn an_end_before_the_first_look_changes_nothing() {
    let scene = scene();
    let uniform = render(&scene, &adaptive(32, 0.0, 0), Execution::best());
    assert!(uniform == render(&scene, &adaptive(32, 0.01, 0), Execution::best()));
}

#[test]
fn the_mean_over_seeds_is_nearly_that_of_uniform_sampling() {
    const SEEDS: u32 = 32;
    let scene = scene();
    let all = |threshold: f32, first: u32| -> Vec<Vec<(f32, f64)>> {
        (first..first + SEEDS)
            .map(|seed| zones(&render(&scene, &Settings { min_samples: 16, ..adaptive(128, threshold, seed) }, Execution::best())))
            .collect()
    };
    // A least number of samples that is small, and a threshold that stops many zones early: more bias than anybody would see otherwise.
    let (adaptive, uniform) = (all(0.08, 0), all(0.0, 1000));
    let samples = |runs: &[Vec<(f32, f64)>]| runs.iter().flatten().map(|(count, _)| f64::from(*count)).sum::<f64>();
    let share = samples(&adaptive) / samples(&uniform);
    assert!((0.2..0.8).contains(&share), "{share} of the samples");
    let (mut difference, mut brightness) = (0.0, 0.0);
    for zone in 0..64 {
        let statistics = |runs: &[Vec<(f32, f64)>]| {
            let mean = runs.iter().map(|run| run[zone].1).sum::<f64>() / f64::from(SEEDS);
            let variance = runs.iter().map(|run| (run[zone].1 - mean).powi(2)).sum::<f64>() / f64::from(SEEDS - 1);
            (mean, variance / f64::from(SEEDS))
        };
        let ((found, error), (expected, its_error)) = (statistics(&adaptive), statistics(&uniform));
        // Beyond four standard errors a zone that ended because it had missed bright samples is too dark by less than an eighth of the threshold.
        let sure = (found - expected).abs() - 4.0 * (error + its_error).sqrt();
        assert!(sure < 0.01 * expected, "zone {zone}: {found} for {expected}");
        difference += found - expected;
        brightness += expected;
    }
    assert!((difference / brightness).abs() < 1e-3, "{}", difference / brightness);
}
