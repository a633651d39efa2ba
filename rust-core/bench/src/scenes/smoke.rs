//! A room of haze with two spots, thin smoke over a lamp, and a dense cloud under an even sky: what media cost.

use super::build::{aimed, layered, light, look, place};
use super::shapes::quad;
use gonio::scene::{DomeFormat, Field, Lattice, LightShape, Medium, Origin, Scene, Spot, Transform};

/// Voxels along an edge.
const SIDE: usize = 96;

/// Haze in all of space, two spots and a floor.
pub(crate) fn haze() -> Scene {
    let mut scene = floor();
    scene.atmosphere = Medium::haze(0.05, [1.0; 3], 0.6);
    for x in [-1.0, 1.0] {
        let mut spot = light(LightShape::Sphere { radius: 0.02 }, 4000.0, aimed([x, 3.0, 0.5], [-0.5 * x, 0.0, 0.0]));
        spot.spot = Some(Spot { angle_deg: 20.0, blend: 0.2, stretch: [1.0; 2] });
        scene.lights.push(spot);
    }
    scene
}

/// Thin smoke about a lamp.
pub(crate) fn smoke() -> Scene {
    let mut scene = floor();
    scene.lights.push(light(LightShape::Sphere { radius: 0.1 }, 60.0, Transform::translation([0.2, 1.4, 0.0])));
    volume(&mut scene, |place, ragged| (ragged(place) - 0.9).max(0.0), Medium::haze(4.0, [0.8; 3], 0.2));
    scene
}

/// A dense cloud.
pub(crate) fn cloud() -> Scene {
    let mut scene = floor();
    scene.lights.push(light(LightShape::Distant { angle_deg: 0.53 }, 60000.0, aimed([2.0, 3.0, 1.0], [0.0; 3])));
    scene.lights.push(light(LightShape::Dome { format: DomeFormat::default() }, 1.0, Transform::IDENTITY));
    let density = |place: [f32; 3], ragged: &dyn Fn([f32; 3]) -> f32| {
        let distance = place.iter().map(|x| (x - 0.5).powi(2)).sum::<f32>().sqrt();
        ((0.42 - distance + 0.16 * (ragged(place) - 1.0)) / 0.04).clamp(0.0, 1.0)
    };
    volume(&mut scene, density, Medium::haze(40.0, [0.999; 3], 0.8));
    scene
}

fn floor() -> Scene {
    let mut scene = Scene::default();
    let grey = layered([0.3; 3], &[("specular_weight", 0.0)]);
    place(&mut scene, quad([-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0]), grey, Transform::IDENTITY);
    look(&mut scene, [0.0, 1.4, 4.6], [0.0, 1.2, 0.0], 36.0);
    scene.settings.max_bounces = 32;
    scene
}

/// A box of two metres over the floor, by a density at places from 0 to 1 that may ask for waves of four octaves.
fn volume(scene: &mut Scene, density: impl Fn([f32; 3], &dyn Fn([f32; 3]) -> f32) -> f32, medium: Medium) {
    let ragged = |place: [f32; 3]| -> f32 {
        let octave = |n: i32| {
            let scale = 9.0 * 2.1_f32.powi(n);
            let turned = [place[0] + 0.31 * place[2], place[1] - 0.27 * place[0], place[2] + 0.43 * place[1]];
            let waves: f32 = turned.iter().map(|x| (x * scale + n as f32).sin()).product();
            (0.5 + 0.5 * waves) * 0.5_f32.powi(n)
        };
        (0..4).map(octave).sum()
    };
    let middle = |n: usize| (n as f32 + 0.5) / SIDE as f32;
    let value = |n: usize| density([n / (SIDE * SIDE), n / SIDE % SIDE, n % SIDE].map(middle), &ragged);
    let values: Vec<f32> = (0..SIDE * SIDE * SIDE).map(value).collect();
    let density = Lattice::of_values(&values, [SIDE; 3]).expect("as many values as voxels");
    let edge = 2.0 / SIDE as f64;
    let to_world = Transform::translation([-1.0 + 0.5 * edge, 0.2 + 0.5 * edge, -1.0 + 0.5 * edge]).after(&Transform::scale(edge));
    scene.add_volume(Field { origin: Origin::new("smoke"), to_world, density, ..Field::default() }, medium);
}
