//! Compiled geometry: flat tables that surface points are gathered from, for all meshes and instances at once.

mod derivatives;
mod primvar;
mod surface_point;

pub use derivatives::UvDerivatives;
pub use primvar::{PrimvarKind, PrimvarRef};
pub use surface_point::{HitLanes, ShadowSegment, SurfacePoint, spawn, spawn_to};

use gonio_simd::{Lanes, U};

/// No entry.
pub const NONE: u32 = u32::MAX;

/// The column of a mesh's primvars that holds its shading normals.
pub const NORMALS: usize = 0;

/// Flat tables of all meshes and instances. Indices are in elements; every table has one entry at least, so that gathers are always valid.
#[derive(Clone, Debug, Default)]
pub struct GeometryTable {
    /// Coordinates, three a point, object space.
    pub points: Vec<f32>,
    /// Point numbers, three a triangle, counted over all meshes.
    pub corners: Vec<u32>,
    /// Material slot of each triangle of the meshes that have slots.
    pub slots: Vec<u32>,
    /// Values of all primvars.
    pub values: Vec<f32>,
    /// Value numbers of indexed primvars.
    pub value_indices: Vec<u32>,
    /// Primvar columns a mesh has; column [`NORMALS`] first.
    pub columns: usize,
    /// `columns` references a mesh, four words each (see [`PrimvarRef`]).
    pub primvars: Vec<u32>,
    /// Overrides of the instances' own primvars: `columns` references an instance that has any.
    pub instance_primvars: Vec<u32>,
    /// First triangle of each mesh.
    pub mesh_triangle: Vec<u32>,
    /// First point of each mesh.
    pub mesh_point: Vec<u32>,
    /// First entry in `slots` of each mesh, or [`NONE`].
    pub mesh_slot: Vec<u32>,
    /// Mesh of each instance.
    pub instance_mesh: Vec<u32>,
    /// Object to world, twelve numbers an instance: images of x, y, z and the origin, rebased.
    pub instance_transform: Vec<f32>,
    /// First entry in `materials` of each instance.
    pub instance_material: Vec<u32>,
    /// Number in its `Instances` set; primvars with one value an instance are read with it.
    pub instance_number: Vec<u32>,
    /// First reference in `instance_primvars` of each instance, or [`NONE`].
    pub instance_primvar: Vec<u32>,
    /// Number of the set an instance came from: what the primId pass shows.
    pub instance_set: Vec<u32>,
    /// Pass index of each set.
    pub set_pass_index: Vec<u32>,
    /// 1 for sets that cut holes into the coverage, else 0; empty where there is none.
    pub set_holdout: Vec<u32>,
    /// 1 for sets that catch shadows, else 0; empty where there is none.
    pub set_catcher: Vec<u32>,
    /// Material numbers by slot.
    pub materials: Vec<u32>,
}

impl GeometryTable {
    /// The material at a hit on a mesh.
    #[inline]
    pub fn material(&self, instance: u32, primitive: u32) -> u32 {
        let instance = instance as usize;
        let first = self.mesh_slot[self.instance_mesh[instance] as usize];
        let slot = if first == NONE { 0 } else { self.slots[(first + primitive) as usize] };
        self.materials[(self.instance_material[instance] + slot) as usize]
    }

    /// The same for a register of hits.
    #[inline(always)]
    pub fn material_lanes<L: Lanes>(&self, l: L, instance: U<L>, primitive: U<L>) -> U<L> {
        let first = l.gather_integers(&self.mesh_slot, l.gather_integers(&self.instance_mesh, instance));
        let (whole, slot) = (first.eq(NONE), l.gather_integers(&self.instance_material, instance));
        let part = if whole.all() { l.u(0) } else { l.gather_integers(&self.slots, first + primitive).keep_if(!whole) };
        l.gather_integers(&self.materials, slot + part)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let words = self.points.len()
            + self.corners.len()
            + self.slots.len()
            + self.values.len()
            + self.value_indices.len()
            + self.primvars.len()
            + self.instance_primvars.len()
            + self.instance_mesh.len() * 6
            + self.instance_transform.len()
            + self.materials.len();
        words * 4
    }
}
