//! Small scenes built by hand.

use gonio::scene::{
    Camera, Closure, Emission, Geometry, Instances, Light, LightShape, Material, Mesh, Origin, Scene, Transform, Visibility,
};
use std::sync::Arc;

/// Adds a parallelogram from a corner and two edges, seen counter-clockwise from `u × v`.
pub fn add_quad(scene: &mut Scene, corner: [f32; 3], u: [f32; 3], v: [f32; 3], material: Material) {
    let add = |a: [f32; 3], b: [f32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let points = vec![corner, add(corner, u), add(add(corner, u), v), add(corner, v)];
    add_triangles(scene, &points, &[[0, 1, 2], [0, 2, 3]], material);
}

/// A floor of 10 m by 10 m that is there by a share, under a point light, seen from 5 m above.
pub fn cut_out(opacity: f32) -> Scene {
    let mut scene = Scene::default();
    let material = layered([0.5; 3], &[("geometry_opacity", opacity), ("specular_weight", 0.0)]);
    add_quad(&mut scene, [-5.0, 0.0, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], material);
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 1.0));
    scene.lights.push(light(LightShape::Point, facing_down([0.0, 2.0, 0.0]), [1.0; 3]));
    scene
}

/// Adds a mesh with one material at the world's origin.
pub fn add_triangles(scene: &mut Scene, points: &[[f32; 3]], triangles: &[[u32; 3]], material: Material) {
    let mesh = scene.add_mesh(Mesh { points: Arc::from(points), triangles: Arc::from(triangles), ..Mesh::default() });
    place(scene, mesh, material);
}

/// Places geometry as it is.
pub fn place(scene: &mut Scene, geometry: impl Into<Geometry>, material: Material) {
    let material = scene.add_material(material);
    scene.instances.push(Instances::new(Origin::new("test"), geometry, vec![material], vec![Transform::IDENTITY]));
}

/// A light of a shape with radiance 1 that the camera does not see.
pub fn light(shape: LightShape, transform: Transform, radiance: [f32; 3]) -> Light {
    Light {
        emission: Emission { radiance, ..Emission::default() },
        visibility: Visibility { camera: false, ..Visibility::default() },
        ..Light::new(Origin::new("light"), shape, transform)
    }
}

/// A camera at `eye` looking down along −y, up along −z, orthographic with the given width and height in metres.
pub fn camera_from_above(eye: [f64; 3], size: f64) -> Camera {
    let transform = Transform { columns: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], eye] };
    let mut camera = Camera::perspective(Origin::new("camera"), transform, 40.0, 1.0);
    camera.projection = gonio::scene::Projection::Orthographic;
    camera.aperture = [size, size];
    camera
}

/// A floor of 20 × 20 metres at y = 0.
pub fn floor(reflectance: f32) -> Scene {
    let mut scene = Scene::default();
    let material = Material::diffuse(Origin::new("floor"), [reflectance; 3]);
    add_quad(&mut scene, [-10.0, 0.0, 10.0], [20.0, 0.0, 0.0], [0.0, 0.0, -20.0], material);
    scene
}

/// Turns the local −z axis to point along −y: lights in the ceiling.
pub fn facing_down(position: [f64; 3]) -> Transform {
    Transform { columns: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], position] }
}

/// A layered surface with some parameters.
pub fn layered(colour: [f32; 3], parameters: &[(&str, f32)]) -> Material {
    let mut closure = Closure::default();
    closure.set_colour("base_color", colour);
    parameters.iter().for_each(|(name, value)| closure.set(name, *value));
    Material::of(Origin::new("test"), closure)
}

/// A floor with a leaning board, a mirror and a pane on it, lit by a point, a panel and a sphere.
pub fn varied() -> Scene {
    let mut scene = floor(0.6);
    add_quad(&mut scene, [-1.0, 0.3, 0.2], [1.3, 0.2, -0.4], [0.2, 0.1, -0.9], layered([0.7, 0.3, 0.2], &[("specular_roughness", 0.0)]));
    let mirror = layered([0.9; 3], &[("metalness", 1.0), ("specular_roughness", 0.0)]);
    add_quad(&mut scene, [0.2, 0.2, 1.1], [0.9, 0.1, 0.0], [0.1, 0.4, -0.8], mirror);
    let glass = layered([1.0; 3], &[("transmission_weight", 1.0), ("specular_roughness", 0.0)]);
    add_quad(&mut scene, [-0.9, 0.8, 1.2], [1.1, 0.0, 0.3], [0.0, 0.1, -1.0], glass);
    scene.lights.push(light(LightShape::Point, facing_down([0.8, 2.0, 0.9]), [2.0; 3]));
    scene.lights.push(light(LightShape::Rectangle { width: 0.5, height: 0.4 }, facing_down([-0.7, 2.2, 0.0]), [3.0; 3]));
    scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, facing_down([1.0, 1.5, -0.7]), [2.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 3.0));
    scene
}
