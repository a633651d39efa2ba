//! Meshes and instances: trees and flat tables.

use super::{
    check,
    primvars::{Elements, append, column, problem},
};
use crate::{
    accel::{Blas, Geometry, Instance},
    error::{Diagnostic, Error, Result},
    geometry::{GeometryTable, NONE, PrimvarRef},
    integrator::{MaterialTable, ray_mask},
    scene::{Instances, Mesh, Primvar, Scene, Transform},
};
use std::sync::{Arc, atomic::AtomicBool};

/// A mesh's tree and the arrays it was built from.
#[derive(Clone, Debug)]
pub(super) struct KeptTree {
    points: Arc<[[f32; 3]]>,
    triangles: Arc<[[u32; 3]]>,
    pub(super) tree: Arc<Blas>,
}

/// Trees of all meshes; those whose arrays are the very same as before are kept.
pub(super) fn build_trees(
    scene: &Scene,
    previous: &[KeptTree],
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<KeptTree>> {
    let mut trees = Vec::with_capacity(scene.meshes.len());
    for mesh in &scene.meshes {
        check(cancel)?;
        let same = |kept: &&KeptTree| Arc::ptr_eq(&kept.points, &mesh.points) && Arc::ptr_eq(&kept.triangles, &mesh.triangles);
        if let Some(kept) = previous.iter().find(same) {
            trees.push(kept.clone());
            continue;
        }
        let usable = has_valid_triangles(mesh, diagnostics);
        let triangles: &[[u32; 3]] = if usable { &mesh.triangles } else { &[] };
        let tree = Blas::build(&mesh.points, triangles, cancel).map_err(|_| Error::Cancelled)?;
        trees.push(KeptTree { points: mesh.points.clone(), triangles: mesh.triangles.clone(), tree: Arc::new(tree) });
    }
    Ok(trees)
}

fn has_valid_triangles(mesh: &Mesh, diagnostics: &mut Vec<Diagnostic>) -> bool {
    let points = mesh.points.len() as u64;
    let wrong = mesh.triangles.iter().flatten().find(|index| u64::from(**index) >= points);
    if let Some(index) = wrong {
        let message = format!("triangle index {index} is out of range, the mesh has {points} points; the mesh is left out");
        diagnostics.push(Diagnostic::warning(&mesh.origin, message));
    }
    wrong.is_none()
}

/// Flat tables, and what the top-level tree is built from.
#[derive(Debug)]
pub(super) struct CompiledGeometry {
    pub(super) table: GeometryTable,
    pub(super) instances: Vec<Instance>,
    pub(super) first_light: u32,
}

/// Lays meshes and instances out.
pub(super) fn tables(
    scene: &Scene,
    names: &[String],
    materials: &MaterialTable,
    origin: [f64; 3],
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<CompiledGeometry> {
    let mut table = GeometryTable { columns: 1 + names.len(), ..GeometryTable::default() };
    for mesh in &scene.meshes {
        append_mesh(mesh, names, &mut table, diagnostics)?;
    }
    let mut instances = Vec::new();
    for (set, group) in scene.instances.iter().enumerate() {
        append_instances(scene, group, set as u32, names, materials, origin, &mut table, &mut instances, diagnostics);
    }
    table.set_pass_index = scene.instances.iter().map(|group| group.pass_index).chain([0]).collect();
    if scene.instances.iter().any(|group| group.holdout) {
        table.set_holdout = scene.instances.iter().map(|group| u32::from(group.holdout)).chain([0]).collect();
    }
    pad(&mut table);
    let first_light = instances.len() as u32;
    Ok(CompiledGeometry { table, instances, first_light })
}

fn append_mesh(mesh: &Mesh, names: &[String], table: &mut GeometryTable, diagnostics: &mut Vec<Diagnostic>) -> Result<()> {
    let first_point = (table.points.len() / 3) as u64;
    if (first_point + mesh.points.len() as u64) * 3 >= i32::MAX as u64
        || (table.corners.len() + mesh.triangles.len() * 3) >= i32::MAX as usize
    {
        return Err(Error::scene(&mesh.origin, "the scene has more points or triangles than 2^31 table entries hold"));
    }
    table.mesh_triangle.push((table.corners.len() / 3) as u32);
    table.mesh_point.push(first_point as u32);
    table.points.extend(mesh.points.iter().flatten());
    table.corners.extend(mesh.triangles.iter().flatten().map(|index| index.saturating_add(first_point as u32)));
    match &mesh.slots {
        Some(slots) if slots.len() == mesh.triangles.len() => {
            table.mesh_slot.push(table.slots.len() as u32);
            table.slots.extend(slots.iter().map(|slot| u32::from(*slot)));
        }
        _ => table.mesh_slot.push(NONE),
    }
    let elements = Elements { uniform: mesh.triangles.len(), points: mesh.points.len(), corners: mesh.triangles.len() * 3 };
    let normals = mesh.normals.as_ref().filter(|normals| normals.components == 3);
    append_checked(normals, elements, mesh, table, diagnostics);
    for name in names {
        append_checked(mesh.primvar(name), elements, mesh, table, diagnostics);
    }
    Ok(())
}

fn append_checked(
    primvar: Option<&Primvar>,
    elements: Elements,
    mesh: &Mesh,
    table: &mut GeometryTable,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let reference = match primvar {
        None => PrimvarRef::ABSENT,
        Some(primvar) => match problem(primvar, elements) {
            None => append(primvar, table),
            Some(message) => {
                diagnostics.push(Diagnostic::warning(&mesh.origin, format!("{message}; it is ignored")));
                PrimvarRef::ABSENT
            }
        },
    };
    table.primvars.extend(reference.words());
}

#[expect(clippy::too_many_arguments, reason = "a set of instances goes to several tables")]
fn append_instances(
    scene: &Scene,
    group: &Instances,
    set: u32,
    names: &[String],
    materials: &MaterialTable,
    origin: [f64; 3],
    table: &mut GeometryTable,
    instances: &mut Vec<Instance>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some(mesh) = scene.meshes.get(group.mesh.index()) else {
        diagnostics.push(Diagnostic::warning(&group.origin, format!("mesh {} does not exist; left out", group.mesh.0)));
        return;
    };
    let first_material = table.materials.len() as u32;
    let slots = mesh.slots.as_ref().map_or(1, |slots| slots.iter().max().map_or(1, |most| usize::from(*most) + 1));
    // The default material stands behind all others.
    let default = materials.numbers.len() - 1;
    let known = |slot: usize| group.materials.get(slot).map(|id| id.index()).filter(|id| *id < default);
    let number = |slot: usize| materials.number(known(slot).unwrap_or(default));
    table.materials.extend((0..slots).map(number));
    let transparent = (0..slots).any(|slot| materials.transparent(number(slot)));
    let first_primvar = append_own_primvars(group, names, table, diagnostics);
    report_unplaceable(mesh, group, diagnostics);
    let mask = [
        (group.visibility.camera, ray_mask::CAMERA),
        (group.visibility.shadow, ray_mask::SHADOW),
        (group.visibility.diffuse, ray_mask::DIFFUSE),
        (group.visibility.glossy, ray_mask::GLOSSY),
        (group.visibility.transmission, ray_mask::TRANSMISSION),
    ];
    let mask = mask.iter().map(|(seen, bit)| if *seen { *bit } else { 0 }).sum();
    for (number, transform) in group.transforms.iter().enumerate() {
        let rebased = rebased(transform, origin);
        table.instance_mesh.push(group.mesh.0);
        table.instance_material.push(first_material);
        table.instance_number.push(number as u32);
        table.instance_primvar.push(first_primvar);
        table.instance_set.push(set);
        table.instance_transform.extend(rebased.columns.iter().flatten().map(|x| *x as f32));
        instances.push(Instance { geometry: Geometry::Mesh(group.mesh.0), object_to_world: rows(&rebased), mask, transparent });
    }
}

/// Coordinates beyond this many metres are not traced: single precision has nothing left for the picture.
const FARTHEST: f64 = 1e12;

/// Says how many placements the tree leaves out.
fn report_unplaceable(mesh: &Mesh, group: &Instances, diagnostics: &mut Vec<Diagnostic>) {
    let local = super::bounds::of_mesh(mesh);
    let near = |bound: &[f64; 3]| bound.iter().all(|x| x.abs() <= FARTHEST);
    let placed = |transform: &Transform| {
        let world = local.transformed(transform);
        transform.inverse().is_some() && near(&world.min) && near(&world.max)
    };
    let hidden = group.transforms.iter().filter(|transform| !placed(transform)).count();
    if hidden > 0 && !local.is_empty() {
        let what = if group.transforms.len() == 1 { "it".to_owned() } else { format!("{hidden} of {} placements", group.transforms.len()) };
        let message = format!("the transform is singular or not finite, or coordinates lie beyond {FARTHEST:e} m; {what} cannot be shown");
        diagnostics.push(Diagnostic::warning(&group.origin, message));
    }
}

fn append_own_primvars(group: &Instances, names: &[String], table: &mut GeometryTable, diagnostics: &mut Vec<Diagnostic>) -> u32 {
    if !group.primvars.iter().any(|primvar| column(names, &primvar.name).is_some()) {
        return NONE;
    }
    let first = (table.instance_primvars.len() / 4) as u32;
    let elements = Elements { uniform: group.transforms.len(), points: 0, corners: 0 };
    table.instance_primvars.extend(PrimvarRef::ABSENT.words());
    for name in names {
        let own = group.primvars.iter().find(|primvar| primvar.name == *name);
        let reference = match own.map(|primvar| (primvar, problem(primvar, elements))) {
            Some((primvar, None)) => append(primvar, table),
            Some((_, Some(message))) => {
                diagnostics.push(Diagnostic::warning(&group.origin, format!("{message}; it is ignored")));
                PrimvarRef::ABSENT
            }
            None => PrimvarRef::ABSENT,
        };
        table.instance_primvars.extend(reference.words());
    }
    first
}

/// A map with its image moved so that `origin` becomes zero.
pub(super) fn rebased(transform: &Transform, origin: [f64; 3]) -> Transform {
    let mut moved = *transform;
    for (place, origin) in moved.columns[3].iter_mut().zip(origin) {
        *place -= origin;
    }
    moved
}

/// The rows of a map.
pub(super) fn rows(transform: &Transform) -> [[f64; 4]; 3] {
    std::array::from_fn(|row| std::array::from_fn(|column| transform.columns[column][row]))
}

/// Room so that no gather finds an empty table, and reading a whole value never leaves it.
fn pad(table: &mut GeometryTable) {
    table.points.extend([0.0; 12]);
    table.values.extend([0.0; 4]);
    table.corners.extend([0; 3]);
    table.instance_transform.extend([0.0; 12]);
    let integers = [
        &mut table.slots,
        &mut table.value_indices,
        &mut table.primvars,
        &mut table.instance_primvars,
        &mut table.mesh_triangle,
        &mut table.mesh_point,
        &mut table.mesh_slot,
        &mut table.materials,
    ];
    integers.into_iter().for_each(|column| column.extend([0; 4]));
    for column in [&mut table.instance_material, &mut table.instance_number, &mut table.instance_primvar, &mut table.instance_set] {
        column.push(0);
    }
    if table.instance_mesh.is_empty() {
        table.instance_mesh.push(0);
    }
}
