//! Putting scenes together.

use gonio::scene::{
    Camera, Channel, Closure, Emission, Graph, Input, Instances, Light, LightShape, Material, Mesh, Operation, Origin, Scene, Texture,
    TextureFilter, TextureSource, Transform, WrapMode,
};
use std::sync::Arc;

/// Adds a mesh of one material, placed once.
pub(crate) fn place(scene: &mut Scene, mesh: Mesh, material: Material, transform: Transform) {
    let mesh = scene.add_mesh(mesh);
    let material = scene.add_material(material);
    scene.instances.push(Instances::new(Origin::new("bench"), mesh, vec![material], vec![transform]));
}

/// A layered surface with some parameters set.
pub(super) fn layered(colour: [f32; 3], parameters: &[(&str, f32)]) -> Material {
    let mut closure = Closure::default();
    closure.set_colour("base_color", colour);
    parameters.iter().for_each(|(name, value)| closure.set(name, *value));
    Material::of(Origin::new("bench"), closure)
}

/// A layered surface whose base colour is an image over `repeats` times the texture coordinates' unit.
pub(super) fn textured(
    scene: &mut Scene,
    size: u32,
    repeats: f32,
    texel: impl Fn(f32, f32) -> [f32; 3],
    parameters: &[(&str, f32)],
) -> Material {
    let source = pixels(size, size, texel);
    let texture = scene.add_texture(Texture { origin: Origin::new("bench"), source, colour_space: "raw".into() });
    let mut graph = Graph::default();
    let st = graph.add(Operation::Primvar { name: "st".into(), fallback: [0.0; 4] }, Vec::new());
    let place = Operation::Transform2d { scale: [repeats; 2], rotation_deg: 0.0, translation: [0.0; 2] };
    let place = graph.add(place, vec![Input::Node(st, Channel::Rgb)]);
    let image = Operation::Image {
        texture,
        wrap: [WrapMode::Repeat; 2],
        filter: TextureFilter::Linear,
        scale: [1.0; 4],
        bias: [0.0; 4],
        fallback: [0.5; 4],
    };
    let image = graph.add(image, vec![Input::Node(place, Channel::Rgb)]);
    let mut material = layered([0.5; 3], parameters);
    material.graph = graph;
    material.closures[0].set_input("base_color", Input::Node(image, Channel::Rgb));
    material
}

/// An image by a function of the unit square, rows from the top.
pub(super) fn pixels(width: u32, height: u32, texel: impl Fn(f32, f32) -> [f32; 3]) -> TextureSource {
    let mut rgba = Vec::with_capacity((width * height * 4) as usize);
    for y in 0..height {
        for x in 0..width {
            let [r, g, b] = texel((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
            rgba.extend([r, g, b, 1.0]);
        }
    }
    TextureSource::Pixels { width, height, rgba: Arc::from(rgba) }
}

/// A place whose −z axis points at a target, y as near to up as can be.
pub(crate) fn aimed(from: [f64; 3], at: [f64; 3]) -> Transform {
    let unit = |v: [f64; 3]| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt());
    let cross = |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let back = unit([0, 1, 2].map(|axis| from[axis] - at[axis]));
    let up = if back[1].abs() > 0.99 { [0.0, 0.0, -1.0] } else { [0.0, 1.0, 0.0] };
    let side = unit(cross(up, back));
    Transform { columns: [side, cross(back, side), back, from] }
}

/// A white light of a radiance in cd/m² (cd for points).
pub(crate) fn light(shape: LightShape, radiance: f32, transform: Transform) -> Light {
    Light { emission: Emission { radiance: [radiance; 3], ..Emission::default() }, ..Light::new(Origin::new("bench"), shape, transform) }
}

/// Looks from a point to another with a square picture.
pub(super) fn look(scene: &mut Scene, from: [f64; 3], at: [f64; 3], field_of_view_deg: f64) {
    scene.cameras.push(Camera::perspective(Origin::new("bench"), aimed(from, at), field_of_view_deg, 1.0));
}
