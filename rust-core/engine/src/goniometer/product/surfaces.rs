//! The meshes of a luminaire, in its frame.

use crate::{
    error::Diagnostic,
    scene::{Geometry, Instances, MaterialId, Mesh, Origin, Scene, Transform},
};
use gonio_formats::l3d::NewPart;
use std::sync::Arc;

/// A mesh at its places. Arrays are the scene's own.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    name: String,
    points: Arc<[[f32; 3]]>,
    triangles: Arc<[[u32; 3]]>,
    slots: Option<Arc<[u16]>>,
    /// Slots whose material shines.
    shining: Vec<u16>,
    /// From the mesh's space to the luminaire's frame, metres.
    places: Vec<Transform>,
}

/// All of them, and what is left out: each kind told once.
pub(super) fn all(scene: &Scene, from_world: &Transform) -> (Vec<Surface>, Vec<Diagnostic>) {
    let (mut surfaces, mut strands, mut shaped) = (Vec::new(), Vec::new(), Vec::new());
    let seen = |set: &&Instances| set.visibility.camera || set.visibility.scattered() || set.visibility.shadow;
    for set in scene.instances.iter().filter(seen) {
        let Geometry::Mesh(mesh) = set.geometry else {
            strands.push(&set.origin);
            continue;
        };
        let Some(mesh) = scene.meshes.get(mesh.index()).filter(|mesh| !mesh.triangles.is_empty()) else { continue };
        let displaced =
            |material: &MaterialId| scene.materials.get(material.index()).is_some_and(|material| material.displacement.is_some());
        if mesh.dicing.is_some() || set.materials.iter().any(displaced) {
            shaped.push(&set.origin);
        }
        surfaces.push(Surface::new(scene, set, mesh, from_world));
    }
    let left_out = [
        (strands, "curves and points are left out of the model in the file"),
        (shaped, "surfaces that are divided or displaced as they are traced are in the file's model as they were before"),
    ];
    (surfaces, left_out.iter().filter_map(|(origins, message)| told(origins, message)).collect())
}

/// What is said of prims, at the first of them.
fn told(origins: &[&Origin], message: &str) -> Option<Diagnostic> {
    let others = origins.len().checked_sub(1)?;
    let others = if others > 0 { format!(" ({others} more prims too)") } else { String::new() };
    Some(Diagnostic::warning(origins[0], format!("{message}{others}")))
}

impl Surface {
    fn new(scene: &Scene, set: &Instances, mesh: &Mesh, from_world: &Transform) -> Self {
        let shining = set.materials.iter().enumerate().filter(|(_, material)| scene.shines(**material));
        Self {
            name: set.origin.name.rsplit('/').next().unwrap_or_default().to_owned(),
            points: mesh.points.clone(),
            triangles: mesh.triangles.clone(),
            slots: mesh.slots.clone(),
            shining: shining.map(|(slot, _)| slot as u16).collect(),
            places: set.transforms.iter().map(|place| from_world.after(place)).collect(),
        }
    }

    /// A part for each place.
    pub(super) fn parts(&self) -> impl Iterator<Item = NewPart> + '_ {
        let shines = |triangle: &usize| self.shining.contains(&self.slots.as_ref().map_or(0, |slots| slots[*triangle]));
        let (shining, dark): (Vec<usize>, Vec<usize>) = (0..self.triangles.len()).partition(shines);
        let order: Vec<usize> = dark.into_iter().chain(shining.iter().copied()).collect();
        self.places.iter().map(move |place| {
            let mirrored = place.determinant() < 0.0;
            let triangle = |index: &usize| {
                let [a, b, c] = self.triangles[*index];
                if mirrored { [a, c, b] } else { [a, b, c] }
            };
            NewPart {
                name: self.name.clone(),
                points: self.points.iter().map(|point| place.point(point.map(f64::from)).map(|x| x as f32)).collect(),
                triangles: order.iter().map(triangle).collect(),
                shining: shining.len(),
            }
        })
    }
}
