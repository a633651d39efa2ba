//! A mesh with points that have moved, at all its keys, and with the normals that follow from them.

use super::super::{
    motion,
    primvars::{at_corner, elements, problem},
};
use super::{
    Laid,
    corners::{Asked, Entry, slot_of},
    field::{Field, means},
    recipe::Recipe,
};
use crate::{
    error::{Diagnostic, Result},
    mesh::{Smoothing, Weld},
    scene::{Instances, Mesh, MeshKey, Primvar, PrimvarInterpolation, Scene},
};
use std::sync::{Arc, atomic::AtomicBool};

/// Placements at which it is looked whether they have one shape, and corners that are looked at.
const LOOKED_AT: usize = 8;
const CORNERS: usize = 1024;
/// The part of the longest way that rounding may make between placements.
const ALIKE: f32 = 1e-2;

/// A recipe's mesh, displaced within so many bytes, and what is to be said of it.
pub(super) fn displaced(scene: &Scene, recipe: &Recipe, laid: Laid<'_>, room: u64, cancel: &AtomicBool) -> Result<(Mesh, Vec<Diagnostic>)> {
    let mesh = &scene.meshes[recipe.mesh];
    let mut told = Vec::new();
    let mut say = |message: String| told.push(Diagnostic::warning(&mesh.origin, message));
    let sets: Vec<&Instances> = recipe.sets.iter().map(|set| &scene.instances[*set]).collect();
    let placements = sets.iter().flat_map(|set| (0..set.transforms.len()).map(move |number| (*set, number)));
    let mut placements = placements.filter(|(set, number)| set.transforms[*number].inverse().is_some());
    let is_whole = mesh.triangles.as_flattened().iter().all(|point| (*point as usize) < mesh.points.len());
    let Some(first) = placements.next().filter(|_| is_whole && !mesh.triangles.is_empty()) else {
        return Ok((mesh.clone(), told));
    };
    let needed = needed(mesh);
    if needed > room {
        say(format!(
            "displacing {} triangles takes {} MB, and {} MB are left of the limit of displacement; it keeps its shape",
            mesh.triangles.len(),
            needed.div_ceil(1 << 20),
            room >> 20
        ));
        return Ok((mesh.clone(), told));
    }
    let mut weld = Weld::new(&mesh.points);
    let corner_normals = corner_normals(mesh, mesh.normals.as_ref());
    let normals = weld.normals(&mesh.points, &mesh.triangles, corner_normals.as_deref());
    let asked = Asked::new(mesh, recipe, &weld, laid.names);
    let mut field = Field::new(mesh, recipe, laid, &asked, &normals, cancel)?;
    let offsets = field.offsets(&asked.entries, first.0, first.1)?;
    if sets.iter().any(|set| recipe.asks_for_placement(set)) && differs(&mut field, &asked, &offsets, placements.take(LOOKED_AT))? {
        say("displacement depends on where the mesh is placed; all placements have the shape of the first".into());
    }
    let (ways, spoilt) = means(&asked.entries, &offsets, &weld);
    if spoilt > 0 {
        say(format!("displacement is not a number at {spoilt} of {} points; they stay where they are", weld.count));
    }
    let points = moved(&mesh.points, &ways, &weld);
    let mut keys = Vec::new();
    if motion::deforms(mesh, &scene.settings) {
        for key in &mesh.motion {
            let at_key = Mesh { points: key.points.clone(), normals: key_normals(mesh, key), motion: Vec::new(), ..mesh.clone() };
            // Places are those of the mesh itself, so that seams stay closed at all times.
            let normals =
                weld.clone().normals(&key.points, &mesh.triangles, self::corner_normals(mesh, at_key.normals.as_ref()).as_deref());
            let offsets = Field::new(&at_key, recipe, laid, &asked, &normals, cancel)?.offsets(&asked.entries, first.0, first.1)?;
            keys.push(moved(&key.points, &means(&asked.entries, &offsets, &weld).0, &weld));
        }
    }
    Ok((finished(mesh, recipe, &weld, points, keys), told))
}

/// The mesh with its new points and keys.
fn finished(mesh: &Mesh, recipe: &Recipe, weld: &Weld, points: Vec<[f32; 3]>, keys: Vec<Vec<[f32; 3]>>) -> Mesh {
    let mut made = mesh.clone();
    if !keys.is_empty() {
        made.motion.iter_mut().zip(&keys).for_each(|(key, points)| key.points = Arc::from(points.as_slice()));
    }
    if let (Some(normals), Some(corner)) = (&mesh.normals, corner_normals(mesh, mesh.normals.as_ref())) {
        let smoothing = Smoothing::new(weld, &mesh.triangles, &*corner);
        let remade = remade(mesh, recipe, &smoothing);
        if remade.iter().any(|remade| *remade) {
            let chosen = |points: &[[f32; 3]], old: &dyn Fn(usize) -> [f32; 3]| chosen(mesh, &smoothing, &remade, points, old);
            let values = chosen(&points, &|group| smoothing.normals[group]);
            for (key, old) in made.motion.iter_mut().zip(&mesh.motion) {
                key.normals = old.normals.as_ref().map(|_| {
                    let old = key_groups(mesh, old, &smoothing);
                    chosen(&key.points, &|group| old[group])
                });
            }
            made.normals = Some(indexed(mesh, normals, &smoothing, values));
        }
    }
    made.points = Arc::from(points);
    made
}

/// Bytes of a displaced mesh, and of what is held while it is made.
fn needed(mesh: &Mesh) -> u64 {
    let (points, triangles) = (mesh.points.len() as u64, mesh.triangles.len() as u64);
    points * (12 * (2 + mesh.motion.len() as u64) + 80) + triangles * (3 * 12 + 2 * 12)
}

/// The normals of corners, if they are usable.
fn corner_normals<'a>(mesh: &'a Mesh, normals: Option<&'a Primvar>) -> Option<Box<dyn Fn(usize) -> [f32; 3] + 'a>> {
    let normals = normals.filter(|normals| normals.components == 3 && problem(normals, elements(mesh)).is_none())?;
    Some(Box::new(move |corner| {
        let value = at_corner(normals, corner, mesh);
        [value[0], value[1], value[2]]
    }))
}

/// The shading normals at a key.
fn key_normals(mesh: &Mesh, key: &MeshKey) -> Option<Primvar> {
    let values = key.normals.clone();
    mesh.normals.as_ref().map(|normals| Primvar { values: values.unwrap_or_else(|| normals.values.clone()), ..normals.clone() })
}

/// Of each group of corners a normal that it has at a key.
fn key_groups(mesh: &Mesh, key: &MeshKey, smoothing: &Smoothing) -> Vec<[f32; 3]> {
    let normals = key_normals(mesh, key);
    let mut old = smoothing.normals.clone();
    if let Some(normal) = corner_normals(mesh, normals.as_ref()) {
        smoothing.group.iter().enumerate().for_each(|(corner, group)| old[*group as usize] = normal(corner));
    }
    old
}

/// Which groups of corners have new normals: those of materials that displace, and that do not bend normals by themselves.
fn remade(mesh: &Mesh, recipe: &Recipe, smoothing: &Smoothing) -> Vec<bool> {
    let (mut moves, mut keeps) = (vec![false; smoothing.normals.len()], vec![false; smoothing.normals.len()]);
    for (corner, group) in smoothing.group.iter().enumerate() {
        if let Some(Some(field)) = recipe.slots.get(slot_of(mesh, corner / 3)) {
            (if field.displacement.keep_normals { &mut keeps } else { &mut moves })[*group as usize] = true;
        }
    }
    moves.iter().zip(keeps).map(|(moves, keeps)| *moves && !keeps).collect()
}

fn chosen(mesh: &Mesh, smoothing: &Smoothing, remade: &[bool], points: &[[f32; 3]], old: &dyn Fn(usize) -> [f32; 3]) -> Arc<[f32]> {
    let new = smoothing.remade(points, &mesh.triangles);
    new.iter().zip(remade).enumerate().flat_map(|(group, (new, remade))| if *remade { *new } else { old(group) }).collect()
}

/// Normals of groups as the primvar that the mesh had.
fn indexed(mesh: &Mesh, normals: &Primvar, smoothing: &Smoothing, values: Arc<[f32]>) -> Primvar {
    let indices = if normals.interpolation == PrimvarInterpolation::FaceVarying {
        Arc::from(smoothing.group.as_slice())
    } else {
        let mut of_point = vec![0; mesh.points.len()];
        mesh.triangles.as_flattened().iter().zip(&smoothing.group).for_each(|(point, group)| of_point[*point as usize] = *group);
        Arc::from(of_point)
    };
    Primvar { values, indices: Some(indices), ..normals.clone() }
}

/// Points of one place move to one place; those that would leave the numbers stay.
fn moved(points: &[[f32; 3]], ways: &[[f32; 3]], weld: &Weld) -> Vec<[f32; 3]> {
    let there = |(point, place): (&[f32; 3], &u32)| {
        let way = ways[*place as usize];
        let there = [point[0] + way[0], point[1] + way[1], point[2] + way[2]];
        if there.iter().all(|x| x.is_finite()) { there } else { *point }
    };
    points.iter().zip(&weld.place).map(there).collect()
}

/// Whether other placements would have another shape.
fn differs<'a>(
    field: &mut Field<'_>,
    asked: &Asked,
    offsets: &[[f32; 3]],
    others: impl Iterator<Item = (&'a Instances, usize)>,
) -> Result<bool> {
    let step = asked.entries.len().div_ceil(CORNERS).max(1);
    let looked: Vec<Entry> = asked.entries.iter().step_by(step).copied().collect();
    let expected: Vec<[f32; 3]> = offsets.iter().step_by(step).copied().collect();
    let longest = expected.as_flattened().iter().filter(|x| x.is_finite()).fold(0.0_f32, |most, x| most.max(x.abs()));
    for (set, placement) in others {
        let found = field.offsets(&looked, set, placement)?;
        if found.as_flattened().iter().zip(expected.as_flattened()).any(|(a, b)| (a - b).abs() > ALIKE * longest) {
            return Ok(true);
        }
    }
    Ok(false)
}
