//! The pass of motion vectors: where the camera, instances and geometry were at the frame before and will be at the next one.
//!
//! Keys of motion at times 0 and 1 are those frames, as nothing is blurred while the pass is shown.

use super::{
    cut::Cut,
    geometry::CompiledGeometry,
    instances::{rebased, rows},
    times::{blurs, shows_vectors},
};
use crate::{
    camera::CameraTable,
    error::{Diagnostic, Result},
    scene::{Aov, Camera, Instances, Mesh, Origin, Scene, Settings, Transform, key_problem},
    transport::{MotionCameras, NeighbourFrames, NeighbourMaps},
};
use std::sync::Arc;

/// Says why the pass is empty, where something moves and it is.
pub(super) fn report(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    let moves = scene.cameras.iter().any(|camera| !camera.motion.is_empty())
        || scene.instances.iter().any(|group| !group.motion.is_empty())
        || scene.meshes.iter().any(|mesh| !mesh.motion.is_empty())
        || scene.curves.iter().any(|curves| !curves.motion.is_empty())
        || scene.points.iter().any(|points| !points.motion.is_empty());
    if moves && scene.settings.aovs.contains(&Aov::Motion) && blurs(&scene.settings) {
        let message = "motion vectors and motion blur exclude each other: the pass 'motion' is empty while what moves is blurred";
        diagnostics.push(Diagnostic::warning(&Origin::new("settings"), message));
    }
}

/// The camera at the frame and at both ends, with all that it may have a picture of; `laid_out` makes a camera's table.
pub(super) fn cameras(
    camera: &Camera,
    settings: &Settings,
    laid_out: impl Fn(&Camera) -> Result<CameraTable>,
) -> Result<Option<Arc<MotionCameras>>> {
    if !shows_vectors(settings) {
        return Ok(None);
    }
    let table = |transform: &Transform| -> Result<CameraTable> {
        let placed = Camera { transform: *transform, clipping: [0.0, f64::from(f32::MAX)], clipping_planes: Vec::new(), ..camera.clone() };
        laid_out(&placed)
    };
    let keys: Vec<Vec<Transform>> = camera.motion.iter().map(|key| vec![*key]).collect();
    let usable = key_problem(&keys, 1).is_none();
    let end = |key: Option<&Transform>| table(key.filter(|_| usable).unwrap_or(&camera.transform));
    let ends = [end(camera.motion.first())?, end(camera.motion.last())?];
    Ok(Some(Arc::new(MotionCameras { now: table(&camera.transform)?, ends })))
}

/// Where everything is at both ends, if the pass is shown.
pub(super) fn neighbours(
    scene: &Scene,
    cuts: &[Cut],
    geometry: &CompiledGeometry,
    origin: [f64; 3],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<NeighbourFrames> {
    if !shows_vectors(&scene.settings) {
        return None;
    }
    let mut frames = NeighbourFrames::default();
    scene.meshes.iter().for_each(|mesh| append_form(mesh, &mut frames));
    cuts.iter().for_each(|cut| append_cut(cut, &mut frames));
    let known: Vec<bool> = scene.instances.iter().map(|group| has_keys(group, diagnostics)).collect();
    frames.placements = vec![None; geometry.first_light as usize];
    for (row, placement) in geometry.table.instances.iter().zip(&mut frames.placements) {
        let (group, number) = (&scene.instances[row.set as usize], row.number as usize);
        let changes = frames.forms.get(row.mesh as usize).is_some_and(Option::is_some);
        if known[row.set as usize] || changes {
            *placement = maps(group, number, known[row.set as usize], origin);
        }
    }
    Some(frames)
}

/// Whether a set has keys that can be used and differ.
fn has_keys(group: &Instances, diagnostics: &mut Vec<Diagnostic>) -> bool {
    if let Some(problem) = key_problem(&group.motion, group.transforms.len()) {
        diagnostics.push(Diagnostic::warning(&group.origin, format!("{problem}; its motion vectors are those of something at rest")));
        return false;
    }
    group.motion.iter().any(|key| *key != group.transforms)
}

fn maps(group: &Instances, number: usize, moves: bool, origin: [f64; 3]) -> Option<NeighbourMaps> {
    let now = rebased(&group.transforms[number], origin);
    let at = |key: Option<&Vec<Transform>>| key.filter(|_| moves).map_or(now, |key| rebased(&key[number], origin));
    let to_world = [rows(&at(group.motion.first())), rows(&at(group.motion.last()))];
    Some(NeighbourMaps { to_object: rows(&now.inverse()?), to_world })
}

/// Appends how far a mesh's points are off at both ends.
fn append_form(mesh: &Mesh, frames: &mut NeighbourFrames) {
    let (Some(first), Some(last), None) = (mesh.motion.first(), mesh.motion.last(), mesh.key_problem()) else {
        frames.forms.push(None);
        return;
    };
    frames.forms.push(Some((frames.displacements.len(), mesh.points.len())));
    for key in [first, last] {
        let off = key.points.as_flattened().iter().zip(mesh.points.as_flattened());
        frames.displacements.extend(off.map(|(there, here)| there - here));
    }
}

/// The same for curves and points.
fn append_cut(cut: &Cut, frames: &mut NeighbourFrames) {
    let (Some(first), Some(last)) = (cut.keys.first(), cut.keys.last()) else {
        frames.forms.push(None);
        return;
    };
    frames.forms.push(Some((frames.displacements.len(), cut.points.len())));
    for key in [first, last] {
        for (there, here) in key.iter().zip(&cut.points) {
            frames.displacements.extend((0..3).map(|axis| there[axis] - here[axis]));
        }
    }
}
