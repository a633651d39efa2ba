//! Motion blur: the stage is read at several times of the camera's shutter, and what moved is put beside what stands at the frame.
//!
//! So everything that depends on time is blurred alike: transformations, point instancers with their velocities, skinned and sampled points.

use crate::prim::Prim;
use crate::volume::Exposure;
use gonio::Diagnostic;
use gonio::scene::{Field, FieldId, Instances, Lattice, Light, Mesh, MeshId, MeshKey, Origin, PointKey, Scene, Transform};
use pyo3::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Samples over the shutter where the stage names no number: turns are even between two of them.
const KEYS: usize = 3;
/// Most samples.
const MOST_KEYS: usize = 65;

/// When the shutter is open, and at how many times the stage is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shutter {
    frame: f64,
    /// From the frame on.
    open: f64,
    close: f64,
    keys: usize,
}

impl Shutter {
    /// The time codes of the keys.
    pub(crate) fn times(&self) -> Vec<f64> {
        let share = |key: usize| key as f64 / (self.keys - 1) as f64;
        (0..self.keys).map(|key| self.frame + self.open + share(key) * (self.close - self.open)).collect()
    }

    /// When it is open, seconds from the frame on.
    pub(crate) fn exposure(&self, codes_a_second: f64) -> Exposure {
        Exposure { open: self.open / codes_a_second, close: self.close / codes_a_second }
    }
}

/// The shutter of a camera at a frame; `None` where it opens and closes at once, or nothing of the stage flows or has samples in time.
pub(crate) fn shutter(stage: &Bound<'_, PyAny>, camera: &Prim<'_>, frame: f64, flows: bool) -> PyResult<Option<Shutter>> {
    let number = |name: &str| -> PyResult<f64> {
        let Some(attribute) = camera.attribute(name) else { return Ok(0.0) };
        let value = attribute.object().call_method1("Get", (frame,))?;
        Ok(value.extract::<f64>().ok().filter(|x| x.is_finite()).unwrap_or(0.0))
    };
    let (open, close) = (number("shutter:open")?, number("shutter:close")?);
    if close <= open || !(flows || is_sampled(stage)?) {
        return Ok(None);
    }
    let keys = camera.attribute("motion:nonlinearSampleCount").map(|attribute| attribute.object().call_method1("Get", (frame,)));
    let keys = keys.transpose()?.and_then(|count| count.extract::<usize>().ok()).unwrap_or(KEYS);
    Ok(Some(Shutter { frame, open, close, keys: keys.clamp(2, MOST_KEYS) }))
}

/// The frames before and after a time, in place of a shutter's opening and closing; `None` where nothing of the stage has samples in time.
pub(crate) fn neighbours(stage: &Bound<'_, PyAny>, time: &Bound<'_, PyAny>) -> PyResult<Option<Shutter>> {
    if !time.call_method0("IsNumeric")?.is_truthy()? || !is_sampled(stage)? {
        return Ok(None);
    }
    let frame: f64 = time.call_method0("GetValue")?.extract()?;
    Ok(Some(Shutter { frame, open: -1.0, close: 1.0, keys: 2 }))
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
        let like = |key: &Scene| key.lights.get(number).filter(|other| other.origin.name == light.origin.name).cloned();
        if let (Some(found), true) = (keys.iter().map(like).collect::<Option<Vec<Light>>>(), scene.settings.shutter.blur) {
            set_mean_strength(light, &found, &mut told);
        }
    }
    let volumes = volumes(scene);
    for (number, set) in scene.instances.iter_mut().enumerate() {
        let field = set
            .geometry
            .mesh()
            .and_then(|mesh| volumes.get(&mesh))
            .and_then(|id| scene.fields.get(id.index()).map(|field| (id.index(), field)));
        let like = |key: &Scene| {
            let other = key.instances.get(number)?;
            (other.origin.name == set.origin.name && other.transforms.len() == set.transforms.len()).then(|| other.transforms.clone())
        };
        if field.is_some_and(|(id, field)| keys.iter().any(|key| !key.fields.get(id).is_some_and(|other| is_like(field, other)))) {
            told.push(Diagnostic::warning(
                &set.origin,
                "the volume's grids are others at other times of the shutter; they are those of the frame, and are not blurred",
            ));
            continue;
        }
        match keys.iter().map(like).collect::<Option<Vec<Vec<Transform>>>>() {
            Some(found) if found.iter().all(|key| *key == found[0]) => {}
            Some(found) => set.motion = found,
            None => told.push(Diagnostic::warning(&set.origin, still)),
        }
    }
    for (number, mesh) in scene.meshes.iter_mut().enumerate().filter(|(number, _)| !volumes.contains_key(&MeshId(*number as u32))) {
        match keys.iter().map(|key| mesh_key(mesh, key.meshes.get(number)?)).collect::<Option<Vec<MeshKey>>>() {
            Some(found) if found.iter().any(|key| *key != found[0]) => mesh.motion = found,
            Some(_) => {}
            None => told.push(Diagnostic::warning(&mesh.origin, still)),
        }
    }
    for (number, curves) in scene.curves.iter_mut().enumerate() {
        let like = |key: &Scene| {
            let other = key.curves.get(number).filter(|other| other.origin.name == curves.origin.name)?;
            (other.points.len() == curves.points.len() && other.counts == curves.counts).then(|| PointKey { points: other.points.clone() })
        };
        let found = keys.iter().map(like).collect();
        curves.motion = moved_points(found, &curves.origin, still, &mut told);
    }
    for (number, points) in scene.points.iter_mut().enumerate() {
        let like = |key: &Scene| {
            let other = key.points.get(number).filter(|other| other.origin.name == points.origin.name)?;
            (other.points.len() == points.points.len()).then(|| PointKey { points: other.points.clone() })
        };
        let found = keys.iter().map(like).collect();
        points.motion = moved_points(found, &points.origin, still, &mut told);
    }
    told
}

/// The boxes of volumes, which keep their form, with their fields.
fn volumes(scene: &Scene) -> HashMap<MeshId, FieldId> {
    let field = |set: &Instances| {
        let mut materials = set.materials.iter().filter_map(|material| scene.materials.get(material.index()));
        Some((set.geometry.mesh()?, materials.find_map(|material| material.medium.field)?))
    };
    scene.instances.iter().filter_map(field).collect()
}

/// Whether two fields are of the same grid.
fn is_like(field: &Field, other: &Field) -> bool {
    let same = |a: &Lattice, b: &Lattice| {
        a.domain == b.domain && (Arc::ptr_eq(&a.values, &b.values) || (a.bricks == b.bricks && a.values == b.values))
    };
    field.lattices().count() == other.lattices().count() && field.lattices().zip(other.lattices()).all(|(a, b)| same(a, b))
}

/// Gives a light whose strength changes the mean of it over the shutter, which is right for what stands still.
fn set_mean_strength(light: &mut Light, keys: &[Light], told: &mut Vec<Diagnostic>) {
    if keys.iter().any(|key| key.shape != light.shape || key.quantity != light.quantity || key.shaping != light.shaping) {
        told.push(Diagnostic::warning(
            &light.origin,
            "its form or its photometry changes while the shutter is open; it is that of the frame",
        ));
    }
    if keys.iter().all(|key| key.emission.radiance == keys[0].emission.radiance) {
        return;
    }
    // The strength goes straight from key to key, so the first and the last count half.
    let weight = |key: usize| if key == 0 || key + 1 == keys.len() { 0.5 } else { 1.0 } / (keys.len() - 1) as f32;
    let mut mean = [0.0; 3];
    for (number, key) in keys.iter().enumerate() {
        for (mean, x) in mean.iter_mut().zip(key.emission.radiance) {
            *mean += weight(number) * x;
        }
    }
    light.emission.radiance = mean;
}

/// Points at the keys, none where they are all the same; told where they cannot be had.
fn moved_points(keys: Option<Vec<PointKey>>, origin: &Origin, still: &str, told: &mut Vec<Diagnostic>) -> Vec<PointKey> {
    match keys {
        Some(found) if found.iter().any(|key| *key != found[0]) => found,
        Some(_) => Vec::new(),
        None => {
            told.push(Diagnostic::warning(origin, still));
            Vec::new()
        }
    }
}

/// Maps at the keys, none where they are all the same or one is missing.
fn moved(keys: Vec<Option<Transform>>) -> Vec<Transform> {
    let keys: Vec<Transform> = keys.into_iter().collect::<Option<_>>().unwrap_or_default();
    if keys.iter().all(|key| *key == keys[0]) { Vec::new() } else { keys }
}

/// A mesh at another time, if it is the same but for its points and normals. Its triangles are those of the first: faces that bend may be cut in
/// another way at another time.
fn mesh_key(mesh: &Mesh, other: &Mesh) -> Option<MeshKey> {
    let same = mesh.origin.name == other.origin.name && mesh.points.len() == other.points.len() && has_same_faces(mesh, other);
    let values = |mesh: &Mesh| mesh.normals.as_ref().map(|normals| normals.values.clone());
    let normals = values(other).filter(|normals| Some(normals.len()) == values(mesh).map(|values| values.len()));
    same.then(|| MeshKey { points: other.points.clone(), normals })
}

/// Whether two meshes have the same faces over the same points, however these are cut into triangles.
fn has_same_faces(mesh: &Mesh, other: &Mesh) -> bool {
    if mesh.triangles == other.triangles {
        return true;
    }
    // Of faces in the order of their triangles' own numbers there is one triangle each.
    let face = |mesh: &Mesh, triangle: usize| mesh.faces.as_ref().map_or(triangle as u32, |faces| faces[triangle]);
    let count = mesh.triangles.len();
    if count != other.triangles.len() || !(0..count).all(|triangle| face(mesh, triangle) == face(other, triangle)) {
        return false;
    }
    let mut first = 0;
    while first < count {
        let end = (first..count).find(|triangle| face(mesh, *triangle) != face(mesh, first)).unwrap_or(count);
        if points_of(&mesh.triangles[first..end]) != points_of(&other.triangles[first..end]) {
            return false;
        }
        first = end;
    }
    true
}

/// The points of triangles, each once, in rising order.
fn points_of(triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut points: Vec<u32> = triangles.as_flattened().to_vec();
    points.sort_unstable();
    points.dedup();
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(triangles: [[u32; 3]; 2], faces: [u32; 2]) -> Mesh {
        Mesh { triangles: triangles.into(), faces: Some(faces.into()), points: vec![[0.0; 3]; 5].into(), ..Mesh::default() }
    }

    #[test]
    fn a_face_that_is_cut_in_another_way_is_the_same_face() {
        let mesh = quad([[0, 1, 2], [0, 2, 3]], [0, 0]);
        assert!(mesh_key(&mesh, &quad([[1, 2, 3], [1, 3, 0]], [0, 0])).is_some());
        assert!(mesh_key(&mesh, &quad([[1, 2, 4], [1, 4, 0]], [0, 0])).is_none(), "another point");
        assert!(mesh_key(&mesh, &quad([[1, 2, 3], [1, 3, 0]], [0, 1])).is_none(), "other faces");
    }
}
