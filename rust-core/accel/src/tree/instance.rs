//! Placed geometry: what the caller says, and the record the traversal reads.

use crate::hit_callback::HitCallback;
use crate::intersect::prepared::Padded;
use crate::intersect::shape::Shape;
use crate::intersect::transform::Affine;
use crate::ray::{Hit, RayMask};

/// What an instance shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// A mesh, or curves or points, by its number in the scene's list of trees.
    Mesh(u32),
    /// An analytic shape.
    Shape(Shape),
}

/// Geometry placed in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// What is placed.
    pub geometry: Geometry,
    /// Rows of the map from object to world space, the last column the translation. Mirrors are fine; a singular map hides the instance.
    pub object_to_world: [[f64; 4]; 3],
    /// A ray sees the instance when its own mask shares a bit with this one.
    pub mask: RayMask,
    /// True when the material may let shadow rays pass.
    pub transparent: bool,
}

impl Instance {
    /// The identity map, which moves nothing.
    pub const IDENTITY: [[f64; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
}

/// Geometry in one word: shapes are counted down from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PackedGeometry(u32);

const SHAPES: [Shape; 4] = [Shape::Rectangle, Shape::Disk, Shape::Sphere, Shape::Cylinder];

impl PackedGeometry {
    pub(crate) fn new(geometry: Geometry) -> Self {
        match geometry {
            Geometry::Mesh(index) => PackedGeometry(index),
            Geometry::Shape(shape) => PackedGeometry(u32::MAX - shape as u32),
        }
    }

    #[inline(always)]
    pub(crate) fn get(self) -> Geometry {
        match SHAPES.get((u32::MAX - self.0) as usize) {
            Some(&shape) => Geometry::Shape(shape),
            None => Geometry::Mesh(self.0),
        }
    }
}

/// Leaf of the top-level tree: one instance; 64 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct InstanceRecord {
    pub(crate) world_to_object: Affine,
    pub(crate) geometry: PackedGeometry,
    /// The caller's number.
    pub(crate) id: u32,
    pub(crate) mask: RayMask,
    pub(crate) transparent: bool,
    pub(crate) map: MapKind,
}

/// What is known of an instance's map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum MapKind {
    /// Nothing.
    General,
    /// It moves and does nothing else, so that directions stay what they are.
    Translation,
    /// It moves nothing, so that a ray goes on as it is.
    Identity,
    /// It changes over the shutter.
    Moving,
}

impl InstanceRecord {
    /// Hands the hits of a ray of the world on the instance's shape to a callback; true when it ended the search.
    #[inline(always)]
    pub(crate) fn intersect_shape<C: HitCallback>(
        &self,
        shape: Shape,
        origin: Padded,
        direction: Padded,
        t_min: f32,
        callback: &mut C,
    ) -> bool {
        let (origin, direction) = (self.world_to_object.point(origin), self.world_to_object.direction(direction));
        shape
            .crossings(origin, direction, t_min, callback.t_max())
            .into_iter()
            .flatten()
            .any(|hit| callback.add(Hit { t: hit.t, u: hit.u, v: hit.v, primitive: 0, instance: self.id }, self.transparent))
    }

    #[inline(always)]
    pub(crate) fn owner(&self) -> Owner {
        Owner { id: self.id, mask: self.mask, transparent: self.transparent }
    }
}

/// Whose a triangle is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Owner {
    /// The instance's number.
    pub(crate) id: u32,
    pub(crate) mask: RayMask,
    pub(crate) transparent: bool,
}
