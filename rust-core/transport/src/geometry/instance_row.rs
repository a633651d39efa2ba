//! What is looked up of an instance at a hit, side by side: a register of hits reads four words in one load a lane.

use super::{GeometryTable, NONE};
use bytemuck::{Pod, Zeroable};
use gonio_simd::{Lanes, U};

/// An instance and its mesh in the tables.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct InstanceRow {
    /// Mesh, or behind all meshes curves or points.
    pub mesh: u32,
    /// First triangle of the mesh, or piece of the curves.
    pub first_triangle: u32,
    /// First point of the mesh.
    pub first_point: u32,
    /// First reference in `instance_primvars`, or [`NONE`].
    pub first_primvar: u32,
    /// First entry in `materials`.
    pub first_material: u32,
    /// First entry in `slots` of the mesh, or [`NONE`].
    pub first_slot: u32,
    /// Number of the set it came from: what the primId pass shows.
    pub set: u32,
    /// Number in its set; primvars with one value an instance are read with it.
    pub number: u32,
}

/// Words of a row.
const WORDS: u32 = (size_of::<InstanceRow>() / 4) as u32;

/// The part of a row that says where a mesh begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshLanes<L: Lanes> {
    pub(super) mesh: U<L>,
    pub(super) first_triangle: U<L>,
    pub(super) first_point: U<L>,
    pub(super) first_primvar: U<L>,
}

/// The part of a row that says what an instance looks like.
#[derive(Clone, Copy, Debug)]
struct LookLanes<L: Lanes> {
    first_material: U<L>,
    first_slot: U<L>,
    set: U<L>,
    number: U<L>,
}

impl GeometryTable {
    /// Where the meshes of instances begin.
    #[inline(always)]
    pub(super) fn mesh_lanes<L: Lanes>(&self, l: L, instance: U<L>) -> MeshLanes<L> {
        let words = bytemuck::cast_slice(&self.instances);
        let [mesh, first_triangle, first_point, first_primvar] = l.gather_integer_quads(words, instance * WORDS);
        MeshLanes { mesh, first_triangle, first_point, first_primvar }
    }

    #[inline(always)]
    fn look_lanes<L: Lanes>(&self, l: L, instance: U<L>) -> LookLanes<L> {
        let words = bytemuck::cast_slice(&self.instances);
        let [first_material, first_slot, set, number] = l.gather_integer_quads(words, instance * WORDS + WORDS / 2);
        LookLanes { first_material, first_slot, set, number }
    }

    /// The sets that instances came from.
    #[inline(always)]
    pub fn set_lanes<L: Lanes>(&self, l: L, instance: U<L>) -> U<L> {
        self.look_lanes(l, instance).set
    }

    /// The instances' numbers in their sets.
    #[inline(always)]
    pub fn number_lanes<L: Lanes>(&self, l: L, instance: U<L>) -> U<L> {
        self.look_lanes(l, instance).number
    }

    /// The materials at a register of hits.
    #[inline(always)]
    pub fn material_lanes<L: Lanes>(&self, l: L, instance: U<L>, primitive: U<L>) -> U<L> {
        let look = self.look_lanes(l, instance);
        let whole = look.first_slot.eq(NONE);
        let part = if whole.all() { l.u(0) } else { l.gather_integers(&self.slots, look.first_slot + primitive).keep_if(!whole) };
        l.gather_integers(&self.materials, look.first_material + part)
    }
}
