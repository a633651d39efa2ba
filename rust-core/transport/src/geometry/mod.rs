//! Compiled geometry: flat tables that surface points are gathered from, for all meshes, curves, points and instances at once.

mod deforming;
mod derivatives;
mod instance_row;
mod moving;
mod primvar;
mod smooth;
mod surface_point;
mod terminator;

pub use deforming::MeshKeys;
pub use derivatives::UvDerivatives;
pub use instance_row::InstanceRow;
pub use primvar::{PrimvarKind, PrimvarRef};
pub use smooth::{FIRST_PIECE, LAST_PIECE, PrimitiveShape, SmoothHit};
pub use surface_point::{HitLanes, ShadowSegment, SurfacePoint, offset_ray_origin, shadow_ray_from, shadow_ray_to};

use gonio_simd::motion::Motion;

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
    /// A [`PrimitiveShape`] for each geometry: meshes, behind them curves and points; empty where there are meshes alone.
    pub shapes: Vec<u32>,
    /// Of each piece of curves its first point in the geometry, with [`FIRST_PIECE`] and [`LAST_PIECE`].
    pub pieces: Vec<u32>,
    /// Radii of the points of curves and of points, object space.
    pub radii: Vec<f32>,
    /// Number of the point that has the first radius: those of meshes come before.
    pub first_radius: u32,
    /// Material slot of each triangle of the meshes that have slots.
    pub slots: Vec<u32>,
    /// Values of all primvars.
    pub values: Vec<f32>,
    /// Value numbers of indexed primvars.
    pub value_indices: Vec<u32>,
    /// Whether any mesh has shading normals.
    pub any_normals: bool,
    /// Primvar columns a mesh has; column [`NORMALS`] first.
    pub columns: usize,
    /// `columns` references a mesh, four words each (see [`PrimvarRef`]).
    pub primvars: Vec<u32>,
    /// Overrides of the instances' own primvars: `columns` references an instance that has any.
    pub instance_primvars: Vec<u32>,
    /// What is looked up of each instance.
    pub instances: Vec<InstanceRow>,
    /// Object to world, twelve numbers an instance: images of x, y, z and the origin, rebased.
    pub instance_transform: Vec<f32>,
    /// How instances move, and by instance the place in it or [`NONE`]; both empty where none does.
    pub motion: Vec<Motion>,
    /// See `motion`.
    pub motion_of: Vec<u32>,
    /// Keys of meshes that change their form: by mesh where they stand, empty where none does.
    pub mesh_keys: Vec<MeshKeys>,
    /// Coordinates of the points at all keys, object space.
    pub key_points: Vec<f32>,
    /// Numbers of the shading normals at all keys.
    pub key_normals: Vec<f32>,
    /// Pass index of each set.
    pub set_pass_index: Vec<u32>,
    /// 1 for sets that cut holes into the coverage, else 0; empty where there is none.
    pub set_holdout: Vec<u32>,
    /// 1 for sets of which the camera sees nothing, holdouts too, else 0; empty where there is none.
    pub set_hidden: Vec<u32>,
    /// 1 for sets that catch shadows, else 0; empty where there is none.
    pub set_catcher: Vec<u32>,
    /// By set, the cosine under which light grazes that starts from the curved surface ([`Self::lift`]), or 0; empty where all are.
    pub set_terminator: Vec<f32>,
    /// Material numbers by slot.
    pub materials: Vec<u32>,
}

impl GeometryTable {
    /// The material at a hit on a mesh.
    #[inline]
    pub fn material(&self, instance: u32, primitive: u32) -> u32 {
        let row = &self.instances[instance as usize];
        let slot = if row.first_slot == NONE { 0 } else { self.slots[(row.first_slot + primitive) as usize] };
        self.materials[(row.first_material + slot) as usize]
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let words = self.points.len()
            + self.corners.len()
            + self.pieces.len()
            + self.radii.len()
            + self.slots.len()
            + self.values.len()
            + self.value_indices.len()
            + self.primvars.len()
            + self.instance_primvars.len()
            + self.instances.len() * size_of::<InstanceRow>() / 4
            + self.key_points.len()
            + self.key_normals.len()
            + self.instance_transform.len()
            + self.materials.len();
        words * 4
    }
}
