//! Motion blur: the stage is read at several times of the camera's shutter, and what moved is put beside what stands at the frame.
//!
//! So everything that depends on time is blurred alike: transformations, point instancers with their velocities, skinned and sampled points.

use crate::prim::Prim;
use gonio::Diagnostic;
use gonio::scene::{Mesh, MeshKey, Scene, Transform};
use pyo3::prelude::*;

/// Samples over the shutter where the stage names no number: turns are even between two of them.
const KEYS: usize = 3;
/// Most samples.
const MOST_KEYS: usize = 65;

/// When the shutter is open, and at how many times the stage is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shutter {
    open: f64,
    close: f64,
    keys: usize,
}

impl Shutter {
    /// The time codes of the keys.
    pub(crate) fn times(&self) -> Vec<f64> {
        let share = |key: usize| key as f64 / (self.keys - 1) as f64;
        (0..self.keys).map(|key| self.open + share(key) * (self.close - self.open)).collect()
    }
}

/// The shutter of a camera at a frame; `None` where it opens and closes at once, or nothing of the stage has samples in time.
pub(crate) fn shutter(stage: &Bound<'_, PyAny>, camera: &Prim<'_>, frame: f64) -> PyResult<Option<Shutter>> {
    let number = |name: &str| -> PyResult<f64> {
        let Some(attribute) = camera.attribute(name) else { return Ok(0.0) };
        let value = attribute.object().call_method1("Get", (frame,))?;
        Ok(value.extract::<f64>().ok().filter(|x| x.is_finite()).unwrap_or(0.0))
    };
    let (open, close) = (number("shutter:open")?, number("shutter:close")?);
    if close <= open || !is_sampled(stage)? {
        return Ok(None);
    }
    let keys = camera.attribute("motion:nonlinearSampleCount").map(|attribute| attribute.object().call_method1("Get", (frame,)));
    let keys = keys.transpose()?.and_then(|count| count.extract::<usize>().ok()).unwrap_or(KEYS);
    Ok(Some(Shutter { open: frame + open, close: frame + close, keys: keys.clamp(2, MOST_KEYS) }))
}

/// Whether any layer of the stage has values that change.
fn is_sampled(stage: &Bound<'_, PyAny>) -> PyResult<bool> {
    for layer in stage.call_method0("GetUsedLayers")?.try_iter()? {
        if layer?.call_method0("ListAllTimeSamples")?.len()? > 0 {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Puts what the stage is at the keys beside what it is at the frame; gives what cannot be blurred.
pub(crate) fn put(scene: &mut Scene, keys: &[Scene]) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    let still = "there are other things, or another topology, at other times of the shutter; it is not blurred";
    for (number, camera) in scene.cameras.iter_mut().enumerate() {
        let at = |key: &Scene| key.cameras.get(number).filter(|other| other.origin.name == camera.origin.name).map(|other| other.transform);
        camera.motion = moved(keys.iter().map(at).collect());
    }
    for (number, light) in scene.lights.iter_mut().enumerate() {
        let at = |key: &Scene| key.lights.get(number).filter(|other| other.origin.name == light.origin.name).map(|other| other.transform);
        light.motion = moved(keys.iter().map(at).collect());
    }
    for (number, set) in scene.instances.iter_mut().enumerate() {
        let like = |key: &Scene| {
            let other = key.instances.get(number)?;
            (other.origin.name == set.origin.name && other.transforms.len() == set.transforms.len()).then(|| other.transforms.clone())
        };
        match keys.iter().map(like).collect::<Option<Vec<Vec<Transform>>>>() {
            Some(found) if found.iter().any(|key| *key != found[0]) => set.motion = found,
            Some(_) => {}
            None => told.push(Diagnostic::warning(&set.origin, still)),
        }
    }
    for (number, mesh) in scene.meshes.iter_mut().enumerate() {
        match keys.iter().map(|key| mesh_key(mesh, key.meshes.get(number)?)).collect::<Option<Vec<MeshKey>>>() {
            Some(found) if found.iter().any(|key| *key != found[0]) => mesh.motion = found,
            Some(_) => {}
            None => told.push(Diagnostic::warning(&mesh.origin, still)),
        }
    }
    let bends = "its points move while the shutter is open; curves and points keep their shape";
    for (number, curves) in scene.curves.iter().enumerate() {
        if keys.iter().any(|key| key.curves.get(number).is_some_and(|other| other.points != curves.points)) {
            told.push(Diagnostic::warning(&curves.origin, bends));
        }
    }
    for (number, points) in scene.points.iter().enumerate() {
        if keys.iter().any(|key| key.points.get(number).is_some_and(|other| other.points != points.points)) {
            told.push(Diagnostic::warning(&points.origin, bends));
        }
    }
    told
}

/// Maps at the keys, none where they are all the same or one is missing.
fn moved(keys: Vec<Option<Transform>>) -> Vec<Transform> {
    let keys: Vec<Transform> = keys.into_iter().collect::<Option<_>>().unwrap_or_default();
    if keys.iter().all(|key| *key == keys[0]) { Vec::new() } else { keys }
}

/// A mesh at another time, if it is the same but for its points and normals.
fn mesh_key(mesh: &Mesh, other: &Mesh) -> Option<MeshKey> {
    let same = mesh.origin.name == other.origin.name && mesh.points.len() == other.points.len() && mesh.triangles == other.triangles;
    let values = |mesh: &Mesh| mesh.normals.as_ref().map(|normals| normals.values.clone());
    let normals = values(other).filter(|normals| Some(normals.len()) == values(mesh).map(|values| values.len()));
    same.then(|| MeshKey { points: other.points.clone(), normals })
}
