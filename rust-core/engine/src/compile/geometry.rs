//! Meshes and instances as flat tables.

use super::{
    bounds::Bounds,
    cut::Cut,
    fill::{self, append_made, append_values},
    instances::{append_instances, report_unplaceable},
    motion,
    numbers::{geometry_number, named},
    primvars::{Elements, append, problem},
    smooth_tables,
};
use crate::{
    accel::{Instance, MovingInstance},
    error::{Diagnostic, Error, Result},
    geometry::{GeometryTable, InstanceRow, NONE, PrimvarKind, PrimvarRef},
    scene::{Instances, Mesh, Primvar, Scene},
    transport::MaterialTable,
};

/// What [`pad`] adds to a column at most.
const PADDED: usize = 12;

/// Flat tables, and what the top-level tree is built from.
#[derive(Debug)]
pub(super) struct CompiledGeometry {
    pub(super) table: GeometryTable,
    pub(super) instances: Vec<Instance>,
    /// Those that move, sorted by their numbers.
    pub(super) moving: Vec<MovingInstance>,
    pub(super) first_light: u32,
}

/// Lays meshes and instances out.
pub(super) fn tables(
    scene: &Scene,
    cuts: &mut [Cut],
    mesh_bounds: &[Bounds],
    names: &[String],
    materials: &MaterialTable,
    origin: [f64; 3],
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<CompiledGeometry> {
    let mut table = GeometryTable { columns: 1 + names.len(), ..GeometryTable::default() };
    motion::report_meshes(scene, diagnostics);
    reserve(scene, cuts, names, &mut table);
    let mut meshes = scene.meshes.iter().map(|mesh| append_mesh(mesh, names, &mut table, diagnostics)).collect::<Result<Vec<_>>>()?;
    meshes.extend(smooth_tables::append(scene, cuts, names, &mut table, diagnostics)?);
    motion::fill_keys(scene, cuts, &mut table);
    // Curves and points have one material.
    let slots: Vec<usize> = scene.meshes.iter().map(slots_of).chain(cuts.iter().map(|_| 1)).collect();
    let mut instances = Vec::new();
    let mut moving = Vec::new();
    for (set, group) in scene.instances.iter().enumerate() {
        let number = geometry_number(scene, group.geometry);
        let (Some(bounds), Some(slots)) = (mesh_bounds.get(number), slots.get(number)) else {
            diagnostics.push(Diagnostic::warning(&group.origin, format!("{} does not exist; left out", named(group.geometry))));
            continue;
        };
        report_unplaceable(bounds, group, diagnostics);
        let row = InstanceRow { mesh: number as u32, ..meshes[number] };
        let first = instances.len();
        let motions = motion::motions(group, &scene.settings, origin, diagnostics);
        moving.extend(motions.into_iter().map(|(number, motion)| MovingInstance { instance: (first + number) as u32, motion }));
        append_instances(group, set as u32, *slots, row, names, materials, origin, &mut table, &mut instances, diagnostics);
    }
    table.set_pass_index = scene.instances.iter().map(|group| group.pass_index).chain([0]).collect();
    if scene.instances.iter().any(|group| group.holdout) {
        table.set_holdout = scene.instances.iter().map(|group| u32::from(group.holdout)).chain([0]).collect();
    }
    let hidden = |group: &Instances| group.holdout || !group.visibility.camera;
    if scene.instances.iter().any(hidden) {
        table.set_hidden = scene.instances.iter().map(|group| u32::from(hidden(group))).chain([0]).collect();
    }
    if scene.instances.iter().any(|group| group.shadow_catcher) {
        table.set_catcher = scene.instances.iter().map(|group| u32::from(group.shadow_catcher)).chain([0]).collect();
    }
    if scene.instances.iter().any(|group| group.shadow_terminator > 0.0) {
        table.set_terminator = scene.instances.iter().map(|group| group.shadow_terminator.clamp(0.0, 1.0)).chain([0.0]).collect();
    }
    pad(&mut table);
    motion::fill(&mut table, &moving, instances.len());
    let first_light = instances.len() as u32;
    Ok(CompiledGeometry { table, instances, moving, first_light })
}

/// Makes room for all meshes, curves and points: tables that grow are moved again and again.
fn reserve(scene: &Scene, cuts: &[Cut], names: &[String], table: &mut GeometryTable) {
    let in_cuts: usize = cuts.iter().map(|cut| cut.points.len()).sum();
    let primvars = || scene.meshes.iter().flat_map(|mesh| names.iter().filter_map(move |name| mesh.primvar(name)).chain(&mesh.normals));
    fill::reserve(&mut table.points, scene.meshes.iter().map(|mesh| mesh.points.len() * 3).sum::<usize>() + 3 * in_cuts + PADDED);
    fill::reserve(&mut table.radii, in_cuts + PADDED);
    fill::reserve(&mut table.pieces, cuts.iter().map(|cut| cut.pieces.len()).sum::<usize>() + PADDED);
    fill::reserve(&mut table.corners, scene.meshes.iter().map(|mesh| mesh.triangles.len() * 3).sum::<usize>() + PADDED);
    fill::reserve(&mut table.values, primvars().map(|primvar| primvar.values.len()).sum::<usize>() + PADDED);
    fill::reserve(
        &mut table.value_indices,
        primvars().filter_map(|primvar| primvar.indices.as_ref()).map(|i| i.len()).sum::<usize>() + PADDED,
    );
}

/// Appends a mesh; gives its part of its instances' rows.
pub(super) fn append_mesh(
    mesh: &Mesh,
    names: &[String],
    table: &mut GeometryTable,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<InstanceRow> {
    let first_point = (table.points.len() / 3) as u64;
    if (first_point + mesh.points.len() as u64) * 3 >= i32::MAX as u64
        || (table.corners.len() + mesh.triangles.len() * 3) >= i32::MAX as usize
    {
        return Err(Error::scene(&mesh.origin, "the scene has more points or triangles than 2^31 table entries hold"));
    }
    let first_triangle = (table.corners.len() / 3) as u32;
    append_values(&mut table.points, mesh.points.as_flattened());
    append_made(&mut table.corners, mesh.triangles.as_flattened(), |index| index.saturating_add(first_point as u32));
    let first_slot = match &mesh.slots {
        Some(slots) if slots.len() == mesh.triangles.len() => {
            let first = table.slots.len() as u32;
            table.slots.extend(slots.iter().map(|slot| u32::from(*slot)));
            first
        }
        _ => NONE,
    };
    let elements = Elements { uniform: mesh.triangles.len(), points: mesh.points.len(), corners: mesh.triangles.len() * 3 };
    let normals = mesh.normals.as_ref().filter(|normals| normals.components == 3);
    table.any_normals |= append_checked(normals, elements, mesh, table, diagnostics);
    for name in names {
        append_checked(mesh.primvar(name), elements, mesh, table, diagnostics);
    }
    Ok(InstanceRow { first_triangle, first_point: first_point as u32, first_slot, ..InstanceRow::default() })
}

/// Material slots of a mesh.
pub(super) fn slots_of(mesh: &Mesh) -> usize {
    mesh.slots.as_ref().map_or(1, |slots| slots.iter().max().map_or(1, |most| usize::from(*most) + 1))
}

/// Appends a primvar, or that there is none; gives whether there is.
fn append_checked(
    primvar: Option<&Primvar>,
    elements: Elements,
    mesh: &Mesh,
    table: &mut GeometryTable,
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
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
    reference.kind != PrimvarKind::Absent
}

/// Room so that no gather finds an empty table, and reading a whole value never leaves it.
pub(super) fn pad(table: &mut GeometryTable) {
    table.points.extend([0.0; 12]);
    table.values.extend([0.0; 4]);
    table.radii.extend([0.0; 4]);
    table.pieces.extend([0; 4]);
    table.corners.extend([0; 4]);
    table.instance_transform.extend([0.0; 12]);
    let integers = [&mut table.slots, &mut table.value_indices, &mut table.primvars, &mut table.instance_primvars, &mut table.materials];
    integers.into_iter().for_each(|column| column.extend([0; 4]));
    table.instances.push(InstanceRow::default());
}
