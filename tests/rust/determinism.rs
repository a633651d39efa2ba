//! The same bits for any number of threads, the same picture at every SIMD level.

use gonio::scene::{Aov, Integrator, LightShape, Settings};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{camera_from_above, facing_down, floor, light},
};

fn scene() -> gonio::scene::Scene {
    let mut scene = floor(0.8);
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 4.0));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.0, 2.0, 0.0]), [1.0; 3]));
    scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, facing_down([1.0, 1.0, 0.0]), [4.0; 3]));
    scene
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = compiled(&scene());
    let base = settings(130, 20, &[Aov::Color, Aov::Illuminance]);
    let one = render(&scene, &Settings { threads: 1, ..base.clone() }, Execution::best());
    let two = render(&scene, &Settings { threads: 2, ..base }, Execution::best());
    assert!(one == two);
}

/// Workers leave their workspaces for the next render of a scene, at whatever level and with whatever passes that is.
#[test]
fn renders_leave_no_trace_in_the_next() {
    let scene = compiled(&scene());
    let passes = [Aov::Color, Aov::Illuminance, Aov::Normal, Aov::Depth, Aov::Albedo];
    let wanted = settings(70, 6, &passes);
    let alone = render(&scene, &wanted, Execution::best());
    for execution in Execution::all() {
        let other = Settings { integrator: Integrator::Whitted, ..settings(64, 3, &[Aov::Color]) };
        render(&scene, &settings(64, 3, &[Aov::Color]), execution);
        render(&scene, &other, execution);
        assert!(render(&scene, &wanted, Execution::best()) == alone, "{}", execution.name());
    }
}

#[test]
fn levels_agree_in_the_mean() {
    let scene = compiled(&scene());
    let settings = settings(64, 16, &[Aov::Color, Aov::Illuminance]);
    let best = mean(&render(&scene, &settings, Execution::best()), Aov::Illuminance, 0);
    for execution in Execution::all() {
        let found = mean(&render(&scene, &settings, execution), Aov::Illuminance, 0);
        assert!((found / best - 1.0).abs() < 1e-4, "{}: {found} instead of {best}", execution.name());
    }
}
