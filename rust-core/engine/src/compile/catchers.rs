//! Shadow catchers: which lights belong to the objects whose absence they are compared with.

use crate::{
    geometry::{GeometryTable, NONE},
    scene::Scene,
};

/// 1 for the lights that are triangles of other meshes than catchers, else 0; empty where there are no catchers or no such lights.
pub(super) fn object_lights(scene: &Scene, geometry: &GeometryTable, triangle_lights: &[u32], lights: usize) -> Vec<u32> {
    let mut of_objects = vec![0; lights];
    let mut any = false;
    for (instance, first) in triangle_lights.iter().enumerate().filter(|(_, first)| **first != NONE) {
        let row = &geometry.instances[instance];
        let mesh = &scene.meshes[row.mesh as usize];
        if geometry.set_catcher.get(row.set as usize) == Some(&0) {
            of_objects[*first as usize..*first as usize + mesh.triangles.len()].fill(1);
            any = true;
        }
    }
    if any { of_objects } else { Vec::new() }
}
