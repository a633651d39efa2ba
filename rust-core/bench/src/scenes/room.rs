//! A furnished room under nine lights of several kinds: 12 thousand triangles.

use super::{
    build::{aimed, layered, light, look, place},
    shapes::{quad, superellipsoid, torus},
};
use gonio::scene::{Light, LightShape, Scene, Spot, Transform};

/// Width and depth, and height, in metres.
const SIZE: [f64; 2] = [6.0, 3.0];

/// Walls, eight boxy and round things, three rings.
pub(crate) fn room() -> Scene {
    let mut scene = Scene::default();
    walls(&mut scene);
    for i in 0..8u16 {
        let turn = f64::from(i) * 0.785;
        let (x, z) = (2.0 * turn.cos(), 1.6 * turn.sin());
        let boxy = if i % 2 == 0 { 1.0 } else { 0.3 };
        let colour = [0.3 + 0.06 * f32::from(i), 0.5, 0.8 - 0.06 * f32::from(i)];
        let thing = superellipsoid(32, 16, [0.3, 0.3 + 0.03 * f32::from(i), 0.3], [boxy; 2]);
        let material = layered(colour, &[("specular_roughness", 0.15 + 0.1 * f32::from(i % 4))]);
        place(&mut scene, thing, material, Transform::translation([x, 0.55, z]));
    }
    for i in 0..3u16 {
        let ring = torus(40, 16, 0.35, 0.1);
        let metal = layered([0.8, 0.7, 0.5], &[("metalness", 1.0), ("specular_roughness", 0.25)]);
        place(&mut scene, ring, metal, Transform::translation([-0.8 + 0.8 * f64::from(i), 0.6, -0.2]));
    }
    lights(&mut scene);
    look(&mut scene, [0.4, 1.6, 2.8], [0.0, 0.9, 0.0], 60.0);
    scene
}

/// Floor, ceiling and four sides, seen from inside.
fn walls(scene: &mut Scene) {
    let [half, height] = [SIZE[0] as f32 * 0.5, SIZE[1] as f32];
    let side = 2.0 * half;
    let sides = [
        ([-half, 0.0, half], [side, 0.0, 0.0], [0.0, 0.0, -side], [0.5, 0.45, 0.4]),
        ([-half, height, -half], [side, 0.0, 0.0], [0.0, 0.0, side], [0.8; 3]),
        ([-half, 0.0, -half], [side, 0.0, 0.0], [0.0, height, 0.0], [0.7, 0.7, 0.65]),
        ([half, 0.0, half], [-side, 0.0, 0.0], [0.0, height, 0.0], [0.7; 3]),
        ([-half, 0.0, half], [0.0, 0.0, -side], [0.0, height, 0.0], [0.6, 0.3, 0.25]),
        ([half, 0.0, -half], [0.0, 0.0, side], [0.0, height, 0.0], [0.3, 0.5, 0.3]),
    ];
    for (corner, u, v, colour) in sides {
        place(scene, quad(corner, u, v), layered(colour, &[("specular_weight", 0.0)]), Transform::IDENTITY);
    }
}

/// Three panels, two downlights, two bulbs, a tube and a spot.
fn lights(scene: &mut Scene) {
    let down = |x: f64, z: f64| aimed([x, SIZE[1] - 0.02, z], [x, 0.0, z]);
    for x in [-1.5, 0.0, 1.5] {
        scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 0.3 }, 12.0, down(x, 0.0)));
    }
    for x in [-2.2, 2.2] {
        scene.lights.push(light(LightShape::Disk { radius: 0.12 }, 60.0, down(x, 1.5)));
        scene.lights.push(light(LightShape::Sphere { radius: 0.08 }, 50.0, Transform::translation([x, 1.4, -2.4])));
    }
    let tube = Transform::translation([0.0, 2.4, -2.9]);
    scene.lights.push(light(LightShape::Cylinder { radius: 0.02, length: 2.0 }, 40.0, tube));
    let spot = Spot { angle_deg: 50.0, blend: 0.3, stretch: [1.0; 2] };
    scene.lights.push(Light { spot: Some(spot), ..light(LightShape::Point, 20.0, aimed([2.5, 2.5, -2.0], [0.0, 0.5, 0.0])) });
}
