//! Parts of scenes that tests measure.

use crate::scene::{Instances, Material, Mesh, Origin, Scene, Transform, Visibility};
use std::sync::Arc;

/// Adds a mesh with one material at the world's origin.
pub(crate) fn add(scene: &mut Scene, points: &[[f32; 3]], triangles: &[[u32; 3]], material: Material) {
    let mesh = scene.add_mesh(Mesh { points: Arc::from(points), triangles: Arc::from(triangles), ..Mesh::default() });
    let material = scene.add_material(material);
    scene.instances.push(Instances {
        origin: Origin::new("part"),
        geometry: mesh.into(),
        materials: vec![material],
        transforms: vec![Transform::IDENTITY],
        motion: Vec::new(),
        primvars: Vec::new(),
        visibility: Visibility::default(),
        holdout: false,
        shadow_catcher: false,
        pass_index: 0,
        light_group: String::new(),
        linking: Default::default(),
        matte_names: Vec::new(),
    });
}
