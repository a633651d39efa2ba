//! Adaptive antialiasing: even pictures stay even, rays go where edges are, and the bits do not depend on threads.

use gonio::scene::{
    Antialiasing, Aov, Camera, Emission, Instances, Integrator, Light, LightShape, Mesh, Origin, Scene, Settings, Transform, Visibility,
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{add_triangles, camera_from_above, cut_out, facing_down, floor, layered, varied},
};
use std::sync::Arc;

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

/// Triangles of all sizes in a cube of side 2, drawn by a linear congruence.
fn splinters(count: usize) -> Mesh {
    let mut state = 1u32;
    let mut number = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let mut points = Vec::new();
    for _ in 0..count {
        let middle = [number(), number(), number()];
        // None so small that rays meet it beside itself, for rounding.
        let size = 0.01 + 0.5 * number().powi(4);
        (0..3).for_each(|_| points.push(middle.map(|x| x + size * number())));
    }
    let triangles: Vec<_> = (0..count as u32).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    Mesh { points: Arc::from(points), triangles: Arc::from(triangles), ..Mesh::default() }
}

/// Black things, of which only the map tells: splinters, mirrored ones, a floor that goes on behind the camera, a ball of a light, something that moves.
fn dark() -> Scene {
    let mut scene = Scene::default();
    let mesh = scene.add_mesh(splinters(300));
    let material = scene.add_material(layered([0.5; 3], &[]));
    let mirrored = Transform { columns: [[-0.4, 0.0, 0.0], [0.0, 0.3, 0.1], [0.0, 0.0, 0.4], [0.9, 0.6, -1.0]] };
    scene.instances.push(Instances::new(Origin::new("splinters"), mesh, vec![material], vec![Transform::IDENTITY, mirrored]));
    let [from, to] = [-1.0, -0.9].map(|x| vec![Transform { columns: [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2], [x, 0.9, 0.0]] }]);
    let still = Instances::new(Origin::new("moving"), mesh, vec![material], from.clone());
    scene.instances.push(Instances { motion: vec![from, to], ..still });
    let floor = [[-30.0, -0.8, 30.0], [30.0, -0.8, 30.0], [0.0, -0.8, -30.0]];
    add_triangles(&mut scene, &floor, &[[0, 1, 2]], layered([0.5; 3], &[]));
    let emission = Emission { radiance: [1e-9; 3], ..Emission::default() };
    let ball = Light::new(Origin::new("ball"), LightShape::Sphere { radius: 0.2 }, Transform::translation([-0.5, 0.2, 0.6]));
    scene.lights.push(Light { emission, visibility: Visibility::default(), ..ball });
    let eye = Transform { columns: [[0.96, 0.0, -0.28], [0.0, 1.0, 0.0], [0.28, 0.0, 0.96], [0.8, 0.1, 2.4]] };
    scene.cameras.push(Camera::perspective(Origin::new("camera"), eye, 60.0, 1.0));
    scene
}

#[test]
fn the_map_is_the_same_by_rasterisation_and_by_rays() {
    let rasterised = dark();
    let mut by_rays = rasterised.clone();
    // What no picture shows, but what rays alone know of.
    by_rays.cameras[0].clipping_planes.push([0.0, 0.0, 0.0, 1.0]);
    for antialiasing in [Antialiasing::Paper, Antialiasing::High] {
        let settings = Settings { aovs: vec![Aov::Color, Aov::SampleCount], ..antialiased(150, antialiasing) };
        for execution in Execution::all() {
            let counts = [&rasterised, &by_rays]
                .map(|scene| render(&compiled(scene), &settings, execution).layer(Aov::SampleCount).expect("counts").values.clone());
            let apart = counts[0].iter().zip(&counts[1]).filter(|(a, b)| a != b).count();
            let found = counts[1].iter().filter(|count| **count > 1.0).count();
            // Where a place lies on an edge to the last bits.
            assert!(found > 1000 && apart * 500 < found, "{antialiasing:?} {}: {apart} of {found} apart", execution.name());
        }
    }
}
