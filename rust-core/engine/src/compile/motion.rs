//! What moves while the shutter is open: instances, cameras and lamps, from keys to the motions that kernels read.

use super::{
    cut::Cut,
    times::{blurs, shows_vectors},
};
use crate::{
    accel::MovingInstance,
    error::Diagnostic,
    geometry::{GeometryTable, MeshKeys, NONE},
    scene::{Camera, Instances, Light, LightShape, Mesh, Origin, Scene, Settings, Shutter, Transform, key_problem},
    transport::{Rolling, Shutter as ShutterTable, Tables},
};
use gonio_simd::motion::{Interpolation, Motion, Rows};
use std::sync::Arc;

/// Places at which a lamp that moves is laid out, each with its share of the light.
const LAMP_PLACES: usize = 32;

/// Steps of the inverse of a shutter's curve.
const CURVE_STEPS: usize = 256;

fn interpolation(shutter: &Shutter) -> Interpolation {
    if shutter.linear { Interpolation::Linear } else { Interpolation::Decomposed }
}

/// The rows of a map, its image moved so that `origin` becomes zero.
fn rows(map: &Transform, origin: [f64; 3]) -> Rows {
    let [x, y, z, place] = &map.columns;
    std::array::from_fn(|row| [x[row], y[row], z[row], place[row] - origin[row]])
}

/// Motions of the placements of a set, by their numbers in it; those that stand still are left out.
pub(super) fn motions(group: &Instances, settings: &Settings, origin: [f64; 3], diagnostics: &mut Vec<Diagnostic>) -> Vec<(usize, Motion)> {
    if group.motion.is_empty() || !blurs(settings) {
        return Vec::new();
    }
    if let Some(problem) = key_problem(&group.motion, group.transforms.len()) {
        diagnostics.push(Diagnostic::warning(&group.origin, format!("{problem}; it is not blurred")));
        return Vec::new();
    }
    let motion = |number: usize| {
        let keys: Vec<Rows> = group.motion.iter().map(|key| rows(&key[number], origin)).collect();
        Some((number, Motion::new(&keys, interpolation(&settings.shutter))?))
    };
    (0..group.transforms.len()).filter_map(motion).collect()
}

/// Whether the placements of a set move.
pub(super) fn moves(group: &Instances, settings: &Settings) -> bool {
    let still = |key: &Vec<Transform>| *key == group.motion[0];
    blurs(settings) && key_problem(&group.motion, group.transforms.len()).is_none() && !group.motion.iter().all(still)
}

/// Puts motions of instances, sorted by their numbers, where surface points look for them.
pub(super) fn fill(table: &mut GeometryTable, moving: &[MovingInstance], instances: usize) {
    if moving.is_empty() {
        return;
    }
    table.motion_of = vec![NONE; instances];
    for one in moving {
        table.motion_of[one.instance as usize] = table.motion.len() as u32;
        table.motion.push(one.motion.clone());
    }
}

/// Whether a mesh changes its form.
pub(super) fn deforms(mesh: &Mesh, settings: &Settings) -> bool {
    blurs(settings) && !mesh.motion.is_empty() && mesh.key_problem().is_none() && mesh.motion.iter().any(|key| *key != mesh.motion[0])
}

/// Says what keys of meshes cannot be used.
pub(super) fn report_meshes(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    for mesh in scene.meshes.iter().filter(|_| blurs(&scene.settings) || shows_vectors(&scene.settings)) {
        if let Some(problem) = mesh.key_problem() {
            diagnostics.push(Diagnostic::warning(&mesh.origin, format!("{problem}; its form is not blurred")));
        }
    }
}

/// Puts keys of meshes where surface points look for them.
pub(super) fn fill_keys(scene: &Scene, cuts: &[Cut], table: &mut GeometryTable) {
    let bends = blurs(&scene.settings) && cuts.iter().any(|cut| !cut.keys.is_empty());
    if !bends && !scene.meshes.iter().any(|mesh| deforms(mesh, &scene.settings)) {
        return;
    }
    for mesh in &scene.meshes {
        let mut keys = MeshKeys::default();
        if deforms(mesh, &scene.settings) {
            let has_normals = mesh.normals.is_some() && mesh.motion.iter().all(|key| key.normals.is_some());
            keys.segments = mesh.motion.len() as u32 - 1;
            (keys.first_point, keys.points) = (table.key_points.len() as u32, 3 * mesh.points.len() as u32);
            table.key_points.extend(mesh.motion.iter().flat_map(|key| key.points.as_flattened()));
            keys.first_normal = table.key_normals.len() as u32;
            if has_normals {
                keys.normals = mesh.normals.as_ref().map_or(0, |normals| normals.values.len() as u32);
                table.key_normals.extend(mesh.motion.iter().filter_map(|key| key.normals.as_deref()).flatten());
            }
        }
        table.mesh_keys.push(keys);
    }
    // Curves and points are numbered behind the meshes.
    for cut in cuts {
        let mut keys = MeshKeys::default();
        if bends && !cut.keys.is_empty() {
            keys.segments = cut.keys.len() as u32 - 1;
            (keys.first_point, keys.points) = (table.key_points.len() as u32, 3 * cut.points.len() as u32);
            cut.keys.iter().flatten().for_each(|point| table.key_points.extend_from_slice(&point[..3]));
        }
        table.mesh_keys.push(keys);
    }
}

/// How a camera moves in the rebased world.
pub(super) fn of_camera(camera: &Camera, settings: &Settings, origin: [f64; 3]) -> Option<Arc<Motion>> {
    let keys: Vec<Rows> = camera.motion.iter().map(|key| rows(key, origin)).collect();
    if blurs(settings) { Motion::new(&keys, interpolation(&settings.shutter)).map(Arc::new) } else { None }
}

/// Says what keys of cameras cannot be used.
pub(super) fn report_cameras(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    for camera in scene.cameras.iter().filter(|camera| !camera.motion.is_empty()) {
        let keys: Vec<Vec<Transform>> = camera.motion.iter().map(|key| vec![*key]).collect();
        if let Some(problem) = key_problem(&keys, 1) {
            diagnostics.push(Diagnostic::warning(&camera.origin, format!("{problem}; the camera stands still")));
        }
    }
}

/// The shutter of a view, if anything moves in it.
pub(super) fn shutter(tables: &Tables, camera: Option<&Motion>, settings: &Settings) -> Option<Arc<ShutterTable>> {
    let moves = tables.bvh.moves() || tables.materials.media.fields.moves() || camera.is_some();
    (blurs(settings) && moves).then(|| Arc::new(table(settings)))
}

fn table(settings: &Settings) -> ShutterTable {
    let Shutter { interval, curve, row_exposure, .. } = &settings.shutter;
    let usable = interval.iter().all(|x| x.is_finite());
    ShutterTable {
        interval: if usable { interval.map(|x| x.clamp(0.0, 1.0)) } else { [0.0, 1.0] },
        curve: inverse(curve),
        rolling: (*row_exposure < 1.0).then(|| Rolling { duration: row_exposure.max(0.0), rows: settings.resolution[1] }),
    }
}

/// The inverse of the sum of a curve's heights, at even steps; empty where it is even, or of no use.
fn inverse(curve: &[f32]) -> Vec<f32> {
    let heights: Vec<f64> = curve.iter().map(|height| f64::from(*height).max(0.0)).collect();
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(heights.windows(2).scan(0.0, |sum, pair| {
            *sum += 0.5 * (pair[0] + pair[1]);
            Some(*sum)
        }))
        .collect();
    let total = sums[sums.len() - 1];
    if !(total > 0.0 && total.is_finite()) || heights.iter().all(|height| *height == heights[0]) {
        return Vec::new();
    }
    let place = |step: usize| {
        let wanted = total * step as f64 / CURVE_STEPS as f64;
        let cell = sums.partition_point(|sum| *sum < wanted).clamp(1, sums.len() - 1) - 1;
        let [low, high] = [heights[cell], heights[cell + 1]];
        let rest = wanted - sums[cell];
        // Half of the slope, and the height, times the share of the cell, squared and plain.
        let root = (low * low + 2.0 * (high - low) * rest).max(0.0).sqrt();
        let share = if low + root > 0.0 { 2.0 * rest / (low + root) } else { 0.0 };
        ((cell as f64 + share.clamp(0.0, 1.0)) / (sums.len() - 1) as f64) as f32
    };
    (0..=CURVE_STEPS).map(place).collect()
}

/// A lamp at the places that it passes, each with its share of the light; itself where it stands still.
pub(super) fn lamps(light: &Light, settings: &Settings, diagnostics: &mut Vec<Diagnostic>) -> Vec<(Light, f32)> {
    let keys: Vec<Vec<Transform>> = light.motion.iter().map(|key| vec![*key]).collect();
    let whole = || vec![(light.clone(), 1.0)];
    if keys.is_empty() || !blurs(settings) {
        return whole();
    }
    if let Some(problem) = key_problem(&keys, 1) {
        diagnostics.push(Diagnostic::warning(&light.origin, format!("{problem}; the light stands still")));
        return whole();
    }
    let keys: Vec<Rows> = light.motion.iter().map(|key| rows(key, [0.0; 3])).collect();
    let Some(motion) = Motion::new(&keys, interpolation(&settings.shutter)) else { return whole() };
    if matches!(light.shape, LightShape::Dome { .. }) {
        diagnostics.push(Diagnostic::warning(&light.origin, "domes that move are not blurred"));
        return whole();
    }
    tell_lamp(&light.origin, diagnostics);
    let table = ShutterTable { rolling: None, ..table(settings) };
    let place = |number: usize| {
        let rows = motion.at(table.time((number as f32 + 0.5) / LAMP_PLACES as f32, 0));
        let columns = std::array::from_fn(|column| std::array::from_fn(|row| rows[row][column]));
        (Light { transform: Transform { columns }, ..light.clone() }, 1.0 / LAMP_PLACES as f32)
    };
    (0..LAMP_PLACES).map(place).collect()
}

fn tell_lamp(origin: &Origin, diagnostics: &mut Vec<Diagnostic>) {
    let message = format!("the light moves; it is laid out at {LAMP_PLACES} places, each with its share of the light");
    diagnostics.push(Diagnostic::info(origin, message));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_drawn_from_in_proportion() {
        // A triangle: a quarter of the light is in at √(1/8) of the time.
        let triangle = inverse(&[0.0, 1.0, 0.0]);
        assert!((triangle[CURVE_STEPS / 4] - 0.125f32.sqrt()).abs() < 1e-6, "{}", triangle[CURVE_STEPS / 4]);
        assert!((triangle[CURVE_STEPS / 2] - 0.5).abs() < 1e-6);
        let late = inverse(&[0.0, 0.0, 1.0, 1.0]);
        assert!((late[CURVE_STEPS / 3] - 2.0 / 3.0).abs() < 2e-3, "{}", late[CURVE_STEPS / 3]);
        for even in [&[][..], &[1.0], &[2.0, 2.0], &[0.0, 0.0], &[f32::NAN, 1.0, f32::INFINITY]] {
            assert!(inverse(even).is_empty(), "{even:?}");
        }
    }
}
