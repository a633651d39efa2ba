//! Sets of instances in the flat tables.

use super::{
    bounds::Bounds,
    primvars::{Elements, append, column, problem},
};
use crate::{
    accel::{Geometry, Instance},
    error::Diagnostic,
    geometry::{GeometryTable, InstanceRow, NONE, PrimvarRef},
    scene::{Instances, Transform},
    transport::{MaterialTable, ray_mask},
};

/// Puts a set into the tables; `slots` are the material slots of its mesh, whose part of the instances' rows is `mesh`.
#[expect(clippy::too_many_arguments, reason = "a set of instances goes to several tables")]
pub(super) fn append_instances(
    group: &Instances,
    set: u32,
    slots: usize,
    mesh: InstanceRow,
    names: &[String],
    materials: &MaterialTable,
    origin: [f64; 3],
    table: &mut GeometryTable,
    instances: &mut Vec<Instance>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let first_material = table.materials.len() as u32;
    // The default material stands behind all others.
    let default = materials.numbers.len() - 1;
    let known = |slot: usize| group.materials.get(slot).map(|id| id.index()).filter(|id| *id < default);
    let number = |slot: usize| materials.number(known(slot).unwrap_or(default));
    table.materials.extend((0..slots).map(number));
    let transparent = (0..slots).any(|slot| materials.lets_light_pass(number(slot)));
    let first_primvar = append_own_primvars(group, names, table, diagnostics);
    let row = InstanceRow { first_primvar, first_material, set, ..mesh };
    let mask = [
        (group.visibility.camera, ray_mask::CAMERA),
        (group.visibility.shadow, ray_mask::SHADOW),
        (group.visibility.diffuse, ray_mask::DIFFUSE),
        (group.visibility.glossy, ray_mask::GLOSSY),
        (group.visibility.transmission, ray_mask::TRANSMISSION),
        (group.visibility.volume, ray_mask::VOLUME),
        (group.shadow_catcher && group.visibility.shadow, ray_mask::CATCHER_SHADOW),
        (group.shadow_catcher && group.visibility.scattered(), ray_mask::CATCHER_SCATTERED),
    ];
    let mask = mask.iter().map(|(seen, bit)| if *seen { *bit } else { 0 }).sum();
    for (number, transform) in group.transforms.iter().enumerate() {
        let rebased = rebased(transform, origin);
        table.instances.push(InstanceRow { number: number as u32, ..row });
        table.instance_transform.extend(rebased.columns.iter().flatten().map(|x| *x as f32));
        instances.push(Instance { geometry: Geometry::Mesh(mesh.mesh), object_to_world: rows(&rebased), mask, transparent });
    }
}

/// Coordinates beyond this many metres are not traced: single precision has nothing left for the picture.
const FARTHEST: f64 = 1e12;

/// Says how many placements the tree leaves out.
pub(super) fn report_unplaceable(local: &Bounds, group: &Instances, diagnostics: &mut Vec<Diagnostic>) {
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
