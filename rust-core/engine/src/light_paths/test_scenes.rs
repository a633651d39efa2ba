//! Parts of scenes that tests measure.

use crate::scene::{Instances, Material, Mesh, Origin, Scene, Transform};
use std::sync::Arc;

/// Adds a mesh with one material at the world's origin.
pub(crate) fn add(scene: &mut Scene, points: &[[f32; 3]], triangles: &[[u32; 3]], material: Material) {
    let mesh = scene.add_mesh(Mesh { points: Arc::from(points), triangles: Arc::from(triangles), ..Mesh::default() });
    let material = scene.add_material(material);
    scene.instances.push(Instances::new(Origin::new("part"), mesh, vec![material], vec![Transform::IDENTITY]));
}
