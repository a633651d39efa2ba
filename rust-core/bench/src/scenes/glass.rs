//! Goblets of solid glass on a textured table: 45 thousand triangles, two lights.

use super::{
    build::{aimed, layered, light, look, place, textured},
    shapes::{lathe, quad, superellipsoid},
};
use gonio::scene::{LightShape, Scene, Transform};

/// Goblets of five sizes, a metal ball, a table with the image of planks, and a wall with that of tiles.
pub(crate) fn glass() -> Scene {
    let mut scene = Scene::default();
    let planks = |u: f32, v: f32| {
        let grain = 0.5 + 0.5 * (60.0 * u + 3.0 * (20.0 * v).sin()).sin();
        let shade = 0.25 + 0.2 * grain + if (v * 8.0).fract() < 0.03 { -0.15 } else { 0.0 };
        [shade, 0.65 * shade, 0.4 * shade]
    };
    let table = textured(&mut scene, 512, 2.0, planks, &[("specular_roughness", 0.4)]);
    place(&mut scene, quad([-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]), table, Transform::IDENTITY);
    let tiles = |u: f32, v: f32| if ((u * 8.0).fract() < 0.5) == ((v * 8.0).fract() < 0.5) { [0.8, 0.78, 0.7] } else { [0.35, 0.4, 0.5] };
    let wall = textured(&mut scene, 512, 3.0, tiles, &[("specular_weight", 0.0)]);
    place(&mut scene, quad([-2.0, 0.0, -1.5], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]), wall, Transform::IDENTITY);
    for (i, (x, z)) in [(-0.55, 0.1), (-0.25, -0.3), (0.05, 0.2), (0.35, -0.25), (0.6, 0.15)].into_iter().enumerate() {
        let clear = layered(
            [1.0; 3],
            &[("transmission_weight", 1.0), ("specular_roughness", if i == 4 { 0.15 } else { 0.0 }), ("specular_ior", 1.5)],
        );
        let size = 0.8 + 0.1 * i as f64;
        let transform = Transform::translation([x, 0.002, z]).after(&Transform::scale(size));
        place(&mut scene, lathe(64, 64, goblet), clear, transform);
    }
    let metal = layered([0.95, 0.8, 0.5], &[("metalness", 1.0), ("specular_roughness", 0.2)]);
    place(&mut scene, superellipsoid(48, 40, [0.12; 3], [1.0; 2]), metal, Transform::translation([0.15, 0.122, 0.55]));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, 25.0, aimed([1.2, 2.2, 1.0], [0.0, 0.2, 0.0])));
    scene.lights.push(light(LightShape::Rectangle { width: 0.6, height: 1.2 }, 12.0, aimed([-1.5, 1.2, 0.6], [0.0, 0.3, 0.0])));
    look(&mut scene, [0.25, 0.75, 2.4], [0.05, 0.28, 0.0], 32.0);
    scene
}

/// A goblet's outline: foot, stem, bowl outside, then the bowl's inside down to the axis.
fn goblet(v: f32) -> [f32; 2] {
    const OUTLINE: [[f32; 2]; 10] = [
        [0.0, 0.0],
        [0.13, 0.0],
        [0.12, 0.012],
        [0.015, 0.03],
        [0.012, 0.2],
        [0.1, 0.28],
        [0.12, 0.45],
        [0.114, 0.45],
        [0.094, 0.285],
        [0.0, 0.225],
    ];
    let place = (v * 9.0).min(8.999);
    let (i, t) = (place as usize, place.fract());
    [0, 1].map(|axis| OUTLINE[i][axis] + t * (OUTLINE[i + 1][axis] - OUTLINE[i][axis]))
}
