//! More lights than are weighed one by one, with a wall between them.

use gonio::scene::{Aov, LightShape, Material, Origin, Scene, Settings};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{add_quad, camera_from_above, facing_down, floor, light},
};

/// A hundred lamps over a floor, a wall through the middle, and a camera over one side.
fn scene() -> Scene {
    let mut scene = floor(0.5);
    add_quad(&mut scene, [0.3, 0.0, 10.0], [0.0, 0.0, -20.0], [0.0, 3.0, 0.0], Material::diffuse(Origin::new("wall"), [0.5; 3]));
    for i in 0..100 {
        let place = [f64::from(i % 10) * 2.0 - 9.0, 1.0, f64::from(i / 10) * 2.0 - 9.0];
        scene.lights.push(light(LightShape::Sphere { radius: 0.05 }, facing_down(place), [100.0; 3]));
    }
    scene.cameras.push(camera_from_above([3.0, 5.0, 0.0], 4.0));
    scene
}

#[test]
fn threads_do_not_change_a_bit_of_what_is_learned() {
    let scene = compiled(&scene());
    let base = settings(130, 20, &[Aov::Color, Aov::Illuminance]);
    let one = render(&scene, &Settings { threads: 1, ..base.clone() }, Execution::best());
    let two = render(&scene, &Settings { threads: 2, ..base }, Execution::best());
    assert!(one == two);
}

/// Mean illuminance over pictures with different seeds, and its standard error.
fn illuminance(samples: u32, pictures: u32) -> [f64; 2] {
    let scene = compiled(&scene());
    let one = |seed| {
        let settings = Settings { seed: 100 * samples + seed, ..settings(32, samples, &[Aov::Illuminance]) };
        mean(&render(&scene, &settings, Execution::best()), Aov::Illuminance, 0)
    };
    let found: Vec<f64> = (0..pictures).map(one).collect();
    let count = f64::from(pictures);
    let middle = found.iter().sum::<f64>() / count;
    let square: f64 = found.iter().map(|x| (x - middle).powi(2)).sum::<f64>() / (count - 1.0);
    [middle, (square / count).sqrt()]
}

/// Pictures of few samples learn nothing of the wall; 99.9999 % confidence for normal errors.
#[test]
fn what_is_learned_of_walls_changes_no_light() {
    let ([plain, plain_error], [learned, learned_error]) = (illuminance(8, 48), illuminance(16, 24));
    let error = plain_error.hypot(learned_error);
    assert!((plain - learned).abs() < 4.9 * error, "{learned} ± {learned_error} instead of {plain} ± {plain_error}");
    assert!(error < 0.01 * plain, "{error} of {plain}");
}
