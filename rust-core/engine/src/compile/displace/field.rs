//! How far corners move: graphs run over chunks of them, and what they give carried to the mesh's space.

use super::super::{
    cancel::check,
    geometry::{append_mesh, pad},
    instances::append_instances,
    primvars::at_corner,
};
use super::{
    Laid,
    corners::{Asked, Entry, usable},
    recipe::{Recipe, SlotField},
};
use crate::{
    accel::Tlas,
    error::{Error, Result},
    geometry::{GeometryTable, InstanceRow},
    graph::{Around, CHUNK},
    mesh::Weld,
    scene::{DisplacementKind, Instances, Mesh, Primvar, PrimvarInterpolation, Transform},
    transport::{Corner, CornerRoom, CornerTables},
};
use gonio_simd::Execution;
use rayon::prelude::*;
use std::sync::{Arc, atomic::AtomicBool};

/// Corners that one task runs through.
const TASK: usize = 16 * CHUNK;

/// A mesh as it is at one time, ready to be asked.
pub(super) struct Field<'a> {
    mesh: &'a Mesh,
    recipe: &'a Recipe,
    laid: Laid<'a>,
    table: GeometryTable,
    row: InstanceRow,
    nothing: Tlas,
    /// Unit normals of the places, the mesh's space.
    normals: &'a [[f32; 3]],
    /// Unit tangents of the entries and whether coordinates are mirrored; empty where nothing asks.
    tangents: Vec<([f32; 3], f32)>,
    cancel: &'a AtomicBool,
}

impl<'a> Field<'a> {
    /// `mesh` has the points that are asked; of its places `normals` are the normals.
    pub(super) fn new(
        mesh: &'a Mesh,
        recipe: &'a Recipe,
        laid: Laid<'a>,
        asked: &Asked,
        normals: &'a [[f32; 3]],
        cancel: &'a AtomicBool,
    ) -> Result<Self> {
        let mut table = GeometryTable { columns: 1 + laid.names.len(), ..GeometryTable::default() };
        let bare = Mesh { normals: None, motion: Vec::new(), ..mesh.clone() };
        // What is wrong with primvars is told when the mesh is laid out.
        let row = append_mesh(&bare, laid.names, &mut table, &mut Vec::new())?;
        let nothing = Tlas::build(Vec::new(), &[], cancel).map_err(|_| Error::Cancelled)?;
        let along = recipe.fields().find(|field| field.displacement.kind == DisplacementKind::Tangent).and_then(|field| field.program.uv);
        let uv = along.and_then(|column| usable(mesh, laid.names.get(column - 1)?)).filter(|uv| uv.components >= 2);
        let tangents = uv.map_or_else(Vec::new, |uv| tangents(mesh, uv, asked));
        Ok(Self { mesh, recipe, laid, table, row, nothing, normals, tangents, cancel })
    }

    /// How far the entries move in the mesh's space, for one placement of a set; not finite where the graph gives nothing finite.
    pub(super) fn offsets(&mut self, entries: &[Entry], set: &Instances, placement: usize) -> Result<Vec<[f32; 3]>> {
        let transform = set.transforms[placement];
        let inverse = transform.inverse().unwrap_or_default();
        let origin = transform.columns[3];
        self.place(set, placement, origin);
        let tables = CornerTables {
            execution: Execution::detect(),
            geometry: &self.table,
            textures: &self.laid.textures.table,
            around: Around { bvh: &self.nothing, any_transparent: false },
            instance: 0,
            origin,
        };
        let mut offsets = vec![[0.0; 3]; entries.len()];
        for (slot, field) in self.recipe.slots.iter().enumerate() {
            let Some(field) = field else { continue };
            let chosen: Vec<u32> = (0..entries.len() as u32).filter(|entry| entries[*entry as usize].slot == slot as u32).collect();
            let task = |room: &mut CornerRoom, chosen: &[u32]| {
                check(self.cancel)?;
                let corner = |entry: &Entry| Corner { number: entry.corner, normal: self.world_normal(entry, &inverse) };
                let corners: Vec<Corner> = chosen.iter().map(|entry| corner(&entries[*entry as usize])).collect();
                let mut values = vec![[0.0; 3]; corners.len()];
                tables.values(&field.program, &corners, room, &mut values);
                let pairs = chosen.iter().zip(&mut values);
                pairs.for_each(|(entry, value)| *value = self.carried(field, *entry, &entries[*entry as usize], *value, &inverse));
                Ok(values)
            };
            let found: Vec<Vec<[f32; 3]>> = chosen.par_chunks(TASK).map_init(CornerRoom::default, task).collect::<Result<_>>()?;
            chosen.iter().zip(found.iter().flatten()).for_each(|(entry, offset)| offsets[*entry as usize] = *offset);
        }
        Ok(offsets)
    }

    /// Puts one placement into the table, in place of another.
    fn place(&mut self, set: &Instances, placement: usize, origin: [f64; 3]) {
        let table = &mut self.table;
        (table.instances, table.instance_transform, table.materials) = Default::default();
        table.instance_primvars.clear();
        let own = |primvar: &Primvar| match primvar.interpolation {
            PrimvarInterpolation::Uniform => only(primvar, placement),
            _ => Some(primvar.clone()),
        };
        let alone = Instances {
            transforms: vec![set.transforms[placement]],
            primvars: set.primvars.iter().filter_map(own).collect(),
            ..Instances::new(set.origin.clone(), set.geometry, set.materials.clone(), Vec::new())
        };
        let slots = super::super::geometry::slots_of(self.mesh);
        let (names, materials) = (self.laid.names, self.laid.materials);
        append_instances(&alone, 0, slots, self.row, names, materials, origin, table, &mut Vec::new(), &mut Vec::new());
        pad(table);
    }

    fn world_normal(&self, entry: &Entry, inverse: &Transform) -> [f32; 3] {
        let normal = self.normals[entry.place as usize].map(f64::from);
        let world = [0, 1, 2].map(|k| (0..3).map(|i| inverse.columns[k][i] * normal[i]).sum::<f64>());
        let length = world.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 { world.map(|x| (x / length) as f32) } else { [0.0, 0.0, 1.0] }
    }

    /// A graph's value as an offset in the mesh's space.
    fn carried(&self, field: &SlotField, number: u32, entry: &Entry, value: [f32; 3], inverse: &Transform) -> [f32; 3] {
        let displacement = &field.displacement;
        let [x, y, z] = value.map(|value| (value - displacement.midlevel) * displacement.scale);
        let normal = self.normals[entry.place as usize];
        match displacement.kind {
            DisplacementKind::Height => normal.map(|n| n * x),
            DisplacementKind::Object => [x, y, z],
            DisplacementKind::World => inverse.vector([x, y, z].map(f64::from)).map(|x| x as f32),
            DisplacementKind::Tangent => {
                let (sum, mirrored) = self.tangents.get(number as usize).copied().unwrap_or_default();
                let (along, across) = frame(sum, mirrored, normal);
                [0, 1, 2].map(|k| along[k] * x + across[k] * y + normal[k] * z)
            }
        }
    }
}

/// The value of one placement for all.
fn only(primvar: &Primvar, placement: usize) -> Option<Primvar> {
    let element = primvar.indices.as_ref().map_or(Some(placement), |indices| indices.get(placement).map(|index| *index as usize))?;
    let width = usize::from(primvar.components);
    let values = primvar.values.get(element * width..(element + 1) * width)?;
    Some(Primvar { interpolation: PrimvarInterpolation::Constant, values: Arc::from(values), indices: None, ..primvar.clone() })
}

/// Sums of the unit tangents of the triangles around entries, and how they are turned.
fn tangents(mesh: &Mesh, uv: &Primvar, asked: &Asked) -> Vec<([f32; 3], f32)> {
    let mut sums = vec![([0.0; 3], 0.0); asked.entries.len()];
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        let entries = &asked.entry_of[3 * number..3 * number + 3];
        let [a, b, c] = triangle.map(|point| mesh.points[point as usize]);
        let [p, q, r] = [0, 1, 2].map(|k| at_corner(uv, 3 * number + k, mesh));
        let (first, second) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
        let determinant = first[0] * second[1] - second[0] * first[1];
        let along = [0, 1, 2].map(|k| ((b[k] - a[k]) * second[1] - (c[k] - a[k]) * first[1]) * determinant.signum());
        let Some(along) = unit(along).filter(|_| determinant != 0.0) else { continue };
        for entry in entries {
            if let Some((sum, mirrored)) = sums.get_mut(*entry as usize) {
                (0..3).for_each(|k| sum[k] += along[k]);
                *mirrored += determinant.signum();
            }
        }
    }
    sums
}

/// Unit vectors along and across the texture, perpendicular to a normal.
fn frame(tangent: [f32; 3], mirrored: f32, n: [f32; 3]) -> ([f32; 3], [f32; 3]) {
    let dot: f32 = (0..3).map(|k| tangent[k] * n[k]).sum();
    let flat = unit([0, 1, 2].map(|k| tangent[k] - n[k] * dot));
    // Without a texture any direction is as good: the one nearest to x or y.
    let instead = if n[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let dot: f32 = (0..3).map(|k| instead[k] * n[k]).sum();
    let t = flat.or_else(|| unit([0, 1, 2].map(|k| instead[k] - n[k] * dot))).unwrap_or(instead);
    let turned = if mirrored < 0.0 { -1.0 } else { 1.0 };
    let across = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]];
    (t, across.map(|x| x * turned))
}

fn unit(v: [f32; 3]) -> Option<[f32; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}

/// The mean of what the entries of each place say, and how many places nothing finite moves. Those that no entry has stay.
pub(super) fn means(entries: &[Entry], offsets: &[[f32; 3]], weld: &Weld) -> (Vec<[f32; 3]>, usize) {
    let mut sums = vec![([0.0_f64; 3], 0.0_f64, false); weld.count];
    for (entry, offset) in entries.iter().zip(offsets) {
        let (sum, count, spoilt) = &mut sums[entry.place as usize];
        if offset.iter().all(|x| x.is_finite()) {
            (0..3).for_each(|k| sum[k] += f64::from(offset[k]));
            *count += 1.0;
        } else {
            *spoilt = true;
        }
    }
    let spoilt = sums.iter().filter(|(_, _, spoilt)| *spoilt).count();
    let mean = |(sum, count, _): ([f64; 3], f64, bool)| if count > 0.0 { sum.map(|x| (x / count) as f32) } else { [0.0; 3] };
    (sums.into_iter().map(mean).collect(), spoilt)
}
