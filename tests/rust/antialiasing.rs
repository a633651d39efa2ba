//! Adaptive antialiasing: even pictures stay even, rays go where edges are, and the bits do not depend on threads.

use gonio::scene::{Antialiasing, Aov, Emission, Integrator, Light, LightShape, Origin, Settings};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{camera_from_above, cut_out, facing_down, floor, varied},
};

/// Settings for a tree of rays, antialiased.
fn antialiased(pixels: u32, antialiasing: Antialiasing) -> Settings {
    let mut settings = Settings { integrator: Integrator::Whitted, noise_white: 1.0, ..settings(pixels, 1, &[Aov::Color]) };
    settings.set_antialiasing(antialiasing);
    settings
}

#[test]
fn what_opacity_leaves_open_counts_by_its_share() {
    let image = render(&compiled(&cut_out(0.3)), &antialiased(16, Antialiasing::Adaptive), Execution::best());
    let coverage = mean(&image, Aov::Color, 3);
    assert!((coverage - 0.3).abs() < 1e-5, "{coverage}");
}

#[test]
fn an_even_picture_stays_even() {
    let mut scene = floor(0.5);
    let emission = Emission { radiance: [1.0; 3], ..Emission::default() };
    scene.lights.push(Light { emission, ..Light::new(Origin::new("sun"), LightShape::Distant { angle_deg: 0.0 }, facing_down([0.0; 3])) });
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 3.0));
    let scene = compiled(&scene);
    for antialiasing in [Antialiasing::Adaptive, Antialiasing::High, Antialiasing::Paper, Antialiasing::Grid(3)] {
        let image = render(&scene, &antialiased(100, antialiasing), Execution::best());
        let values = &image.layer(Aov::Color).expect("colour").values;
        let first = values[0];
        assert!(first > 0.0 && values.chunks(4).all(|pixel| (pixel[0] / first - 1.0).abs() < 1e-5), "{antialiasing:?}");
    }
}

#[test]
fn rays_go_where_edges_are() {
    let settings = Settings { aovs: vec![Aov::Color, Aov::SampleCount], ..antialiased(128, Antialiasing::Adaptive) };
    let image = render(&compiled(&varied()), &settings, Execution::best());
    let counts = &image.layer(Aov::SampleCount).expect("counts").values;
    assert!(counts.iter().all(|count| [1.0, 5.0, 9.0, 13.0, 17.0, 21.0, 25.0].contains(count)));
    assert!(counts.contains(&1.0) && counts.iter().any(|count| *count > 5.0));
}

#[test]
fn adaptive_pictures_are_near_dense_grids() {
    let scene = compiled(&varied());
    let [dense, adaptive, single] = [Antialiasing::Grid(16), Antialiasing::Adaptive, Antialiasing::Grid(1)].map(|antialiasing| {
        render(&scene, &antialiased(96, antialiasing), Execution::best()).layer(Aov::Color).expect("colour").values.clone()
    });
    let distance =
        |a: &[f32]| a.iter().zip(&dense).map(|(a, b)| f64::from(a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).powi(2)).sum::<f64>().sqrt();
    assert!(distance(&adaptive) < 0.5 * distance(&single), "{} {}", distance(&adaptive), distance(&single));
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = compiled(&varied());
    for antialiasing in [Antialiasing::Adaptive, Antialiasing::Paper, Antialiasing::Grid(2)] {
        let base = Settings { aovs: vec![Aov::Color, Aov::SampleCount, Aov::Normal], ..antialiased(130, antialiasing) };
        let [one, three] = [1, 3].map(|threads| render(&scene, &Settings { threads, ..base.clone() }, Execution::best()));
        assert!(one == three, "{antialiasing:?}");
    }
}

#[test]
fn levels_agree() {
    let scene = compiled(&varied());
    let settings = Settings { aovs: vec![Aov::Color, Aov::SampleCount], ..antialiased(130, Antialiasing::Adaptive) };
    let pictures: Vec<_> = Execution::all().into_iter().map(|execution| (execution.name(), render(&scene, &settings, execution))).collect();
    // Levels without fused multiplication and addition round otherwise, which may tip a comparison.
    for (name, picture) in &pictures {
        for aov in [Aov::Color, Aov::SampleCount] {
            let (found, expected) = (mean(picture, aov, 0), mean(&pictures[0].1, aov, 0));
            assert!((found / expected - 1.0).abs() < 2e-3, "{name} {aov:?}: {found} instead of {expected}");
        }
    }
}

#[test]
fn settings_that_do_not_go_together_are_refused() {
    let scene = compiled(&varied());
    let refused = |settings: &Settings| gonio::render::Render::start(scene.clone(), settings, Execution::best()).is_err();
    assert!(refused(&Settings { integrator: Integrator::Path, ..antialiased(8, Antialiasing::Adaptive) }));
    assert!(refused(&Settings { samples: 4, ..antialiased(8, Antialiasing::Adaptive) }));
    assert!(refused(&Settings { samples: 5, ..antialiased(8, Antialiasing::Grid(2)) }));
    assert!(refused(&Settings { light_samples: 0, ..antialiased(8, Antialiasing::Grid(2)) }));
}
