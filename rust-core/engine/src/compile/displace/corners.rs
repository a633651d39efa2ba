//! The corners at which a displacement is asked: of each place those that differ in what graphs read there.

use super::super::primvars::{at_corner, elements, problem};
use super::recipe::Recipe;
use crate::{
    mesh::Weld,
    scene::{DisplacementKind, Mesh, Primvar, PrimvarInterpolation},
};

/// No entry.
const NONE: u32 = u32::MAX;
/// Corners of one place that are asked at most: bounds the cost of poles.
const MOST: usize = 64;

/// A corner that is asked, for the place where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) corner: u32,
    pub(super) place: u32,
    pub(super) slot: u32,
    /// The next entry of the place.
    next: u32,
}

/// The corners that are asked, and of each corner of the mesh by which it goes.
#[derive(Debug)]
pub(super) struct Asked {
    pub(super) entries: Vec<Entry>,
    /// By corner; nothing where it is not displaced.
    pub(super) entry_of: Vec<u32>,
}

impl Asked {
    /// Chooses the corners of a mesh.
    pub(super) fn new(mesh: &Mesh, recipe: &Recipe, weld: &Weld, names: &[String]) -> Self {
        let read = read_primvars(mesh, recipe, names);
        let values = |corner: usize| read.iter().map(move |primvar| at_corner(primvar, corner, mesh));
        let mut made = Self { entries: Vec::new(), entry_of: Vec::with_capacity(mesh.triangles.len() * 3) };
        let mut first = vec![NONE; weld.count];
        for (corner, point) in mesh.triangles.as_flattened().iter().enumerate() {
            let slot = slot_of(mesh, corner / 3);
            if recipe.slots.get(slot).is_none_or(Option::is_none) {
                made.entry_of.push(NONE);
                continue;
            }
            let place = weld.place[*point as usize];
            let (mut at, mut compared) = (first[place as usize], 1);
            let is_other = |entry: &Entry| entry.slot != slot as u32 || !values(entry.corner as usize).eq(values(corner));
            while at != NONE && compared < MOST && is_other(&made.entries[at as usize]) {
                (at, compared) = (made.entries[at as usize].next, compared + 1);
            }
            if at == NONE {
                at = made.entries.len() as u32;
                made.entries.push(Entry { corner: corner as u32, place, slot: slot as u32, next: first[place as usize] });
                first[place as usize] = at;
            }
            made.entry_of.push(at);
        }
        made
    }
}

/// The material slot of a triangle.
pub(super) fn slot_of(mesh: &Mesh, triangle: usize) -> usize {
    mesh.slots.as_ref().filter(|slots| slots.len() == mesh.triangles.len()).map_or(0, |slots| usize::from(slots[triangle]))
}

/// A primvar of a mesh, if its arrays fit.
pub(super) fn usable<'a>(mesh: &'a Mesh, name: &str) -> Option<&'a Primvar> {
    mesh.primvar(name).filter(|primvar| problem(primvar, elements(mesh)).is_none())
}

/// The primvars that the graphs read and that vary.
fn read_primvars<'a>(mesh: &'a Mesh, recipe: &Recipe, names: &[String]) -> Vec<&'a Primvar> {
    let mut read = recipe.names();
    read.extend(recipe.fields().filter(|field| field.displacement.kind == DisplacementKind::Tangent).filter_map(|field| {
        let column = field.program.uv?;
        names.get(column - 1).map(String::as_str)
    }));
    let varies = |primvar: &&Primvar| primvar.interpolation != PrimvarInterpolation::Constant;
    read.iter().filter_map(|name| usable(mesh, name)).filter(varies).collect()
}
