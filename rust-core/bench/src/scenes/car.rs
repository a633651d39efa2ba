//! A coated body with glass on wheels, in a studio under a sky: 141 thousand triangles.

use super::{
    build::{aimed, layered, light, look, pixels, place},
    shapes::{patch, superellipsoid, torus},
};
use gonio::scene::{Closure, DomeFormat, Light, LightShape, Material, Origin, Scene, Texture, TextureSource, Transform};

/// Three lights of the studio and an environment image.
pub(crate) fn car() -> Scene {
    let mut scene = Scene::default();
    let floor = patch(100, 100, |u, v| [20.0 * (u - 0.5), 0.01 * (40.0 * u).sin() * (31.0 * v).sin(), -20.0 * (v - 0.5)]);
    place(&mut scene, floor, layered([0.3; 3], &[("specular_roughness", 0.35)]), Transform::IDENTITY);
    let paint =
        layered([0.5, 0.02, 0.03], &[("metalness", 0.2), ("specular_roughness", 0.4), ("coat_weight", 1.0), ("coat_roughness", 0.03)]);
    let body = superellipsoid(200, 150, [2.2, 0.45, 0.9], [0.6, 0.5]);
    place(&mut scene, body, paint, Transform::translation([0.0, 0.75, 0.0]));
    let cabin = superellipsoid(128, 96, [1.2, 0.55, 0.75], [0.9, 0.7]);
    place(&mut scene, cabin, window(), Transform::translation([-0.2, 1.15, 0.0]));
    for (x, z) in [(-1.4, 0.85), (1.4, 0.85), (-1.4, -0.85), (1.4, -0.85)] {
        let rubber = layered([0.03; 3], &[("specular_roughness", 0.6)]);
        place(&mut scene, torus(96, 48, 0.28, 0.11), rubber, Transform::translation([x, 0.39, z]));
    }
    let softbox = LightShape::Rectangle { width: 3.0, height: 1.5 };
    scene.lights.push(light(softbox, 30.0, aimed([3.0, 4.0, 4.0], [0.0, 0.5, 0.0])));
    scene.lights.push(light(softbox, 20.0, aimed([-4.0, 3.5, 3.0], [0.0, 0.5, 0.0])));
    scene.lights.push(light(LightShape::Disk { radius: 0.6 }, 60.0, aimed([0.0, 4.5, -4.0], [0.0, 0.5, 0.0])));
    let dome = environment(&mut scene);
    scene.lights.push(dome);
    look(&mut scene, [4.2, 1.9, 5.0], [0.0, 0.65, 0.0], 34.0);
    scene
}

/// A thin pane.
fn window() -> Material {
    let mut closure = Closure { thin_walled: true, ..Closure::default() };
    closure.set_colour("base_color", [0.8; 3]);
    closure.set("transmission_weight", 1.0);
    closure.set("specular_roughness", 0.0);
    Material::of(Origin::new("window"), closure)
}

/// A dome with the image of a sky.
fn environment(scene: &mut Scene) -> Light {
    let texture = scene.add_texture(Texture { origin: Origin::new("sky"), source: sky(256, 128), colour_space: "raw".into() });
    let dome = light(LightShape::Dome { format: DomeFormat::LatLong }, 1.0, Transform::IDENTITY);
    Light { texture: Some(texture), ..dome }
}

/// A sky with a bright patch over a darker ground, latitude–longitude.
pub(crate) fn sky(width: u32, height: u32) -> TextureSource {
    pixels(width, height, |u, v| {
        let blue = 0.6 + 0.8 * (0.5 - v).max(0.0);
        let away = ((u - 0.3) * (u - 0.3) * 4.0 + (v - 0.3) * (v - 0.3)).sqrt();
        let sun = 200.0 * (-(away / 0.02) * (away / 0.02)).exp();
        if v > 0.5 { [0.25, 0.22, 0.2] } else { [0.7 * blue + sun, 0.85 * blue + sun, 1.2 * blue + 0.9 * sun] }
    })
}
