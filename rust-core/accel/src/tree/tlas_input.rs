//! What the TLAS is built over: instances, and the triangles of small ones, in world space.

use super::blas::Blas;
use super::instance::{Geometry, Instance, InstanceRecord, Owner, PackedGeometry};
use super::node::{Bounds, ChildRef, Kind, LARGEST_COORDINATE, WIDTH};
use crate::intersect::transform::{Affine, image_of, inverse, transformed_bounds};
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::NONE;
use std::sync::Arc;

/// Meshes of at most so many blocks stand in the top level themselves: a ray meets their triangles as it is, and no node above them.
const SMALL_MESH: usize = 4;

/// Boxes in world space, and what they hold.
#[derive(Default)]
pub(crate) struct TlasInput {
    pub(crate) boxes: Vec<Bounds>,
    /// What is in each box: an instance or a block by its number in the lists below.
    pub(crate) contents: Vec<ChildRef>,
    /// All instances that rays can hit.
    pub(crate) records: Vec<InstanceRecord>,
    pub(crate) blocks: Vec<TriangleBlock>,
    pub(crate) owners: Vec<Owner>,
}

impl TlasInput {
    /// Places instances; with `opened` those of small meshes are taken apart. Those from `first_loose` on get no boxes.
    pub(crate) fn new(meshes: &[Arc<Blas>], instances: &[Instance], first_loose: usize, opened: bool) -> Self {
        let mut input = TlasInput::default();
        for (id, instance) in instances.iter().enumerate() {
            let Some((bounds, record)) = placed(meshes, instance, id as u32) else { continue };
            if id < first_loose && !(opened && input.open(meshes, instance, record.owner())) {
                input.boxes.push(bounds);
                input.contents.push(ChildRef::new(Kind::Instance, input.records.len()));
            }
            input.records.push(record);
        }
        input
    }

    /// Takes an instance of a small mesh apart; false if the mesh is too large, or no mesh at all.
    fn open(&mut self, meshes: &[Arc<Blas>], instance: &Instance, owner: Owner) -> bool {
        let Geometry::Mesh(mesh) = instance.geometry else { return false };
        let blocks = &meshes[mesh as usize].blocks;
        // Curves and points have no blocks of triangles, and stay instances.
        if blocks.len() > SMALL_MESH || !meshes[mesh as usize].smooth.is_empty() {
            return false;
        }
        for block in blocks {
            let (block, bounds) = in_world(block, instance);
            self.boxes.push(bounds);
            self.contents.push(ChildRef::new(Kind::WorldTriangles, self.blocks.len()));
            self.blocks.push(block);
            self.owners.push(owner);
        }
        true
    }
}

/// A block of an instance in world space, and its padded box.
fn in_world(block: &TriangleBlock, instance: &Instance) -> (TriangleBlock, Bounds) {
    let (mut moved, mut bounds) = (TriangleBlock::EMPTY, Bounds::EMPTY);
    for lane in (0..WIDTH).filter(|lane| block.primitives[*lane] != NONE) {
        let corners = block.vertices.map(|rows| image_of(&instance.object_to_world, rows.map(|row| row[lane])));
        moved.set(lane, corners, block.primitives[lane]);
        bounds = corners.iter().fold(bounds, |all, corner| all.union(&Bounds { min: *corner, max: *corner }));
    }
    (moved, bounds.padded())
}

/// The world box and the record of an instance, if rays can hit it.
fn placed(meshes: &[Arc<Blas>], instance: &Instance, id: u32) -> Option<(Bounds, InstanceRecord)> {
    let shape_bounds;
    let outline: &[Bounds] = match instance.geometry {
        Geometry::Mesh(index) => &meshes.get(index as usize)?.outline,
        Geometry::Shape(shape) => {
            shape_bounds = [shape.bounds()];
            &shape_bounds
        }
    };
    if outline.is_empty() {
        return None;
    }
    let placed = outline.iter().map(|bounds| transformed_bounds(&instance.object_to_world, bounds));
    let bounds = placed.fold(Bounds::EMPTY, |all, bounds| all.union(&bounds));
    let usable = bounds.min.iter().chain(&bounds.max).all(|x| x.abs() <= LARGEST_COORDINATE);
    let world_to_object = Affine::new(&inverse(&instance.object_to_world)?)?;
    let record = InstanceRecord {
        world_to_object,
        geometry: PackedGeometry::new(instance.geometry),
        id,
        mask: instance.mask,
        transparent: instance.transparent,
        identity: instance.object_to_world == Instance::IDENTITY,
        keeps_directions: world_to_object.keeps_directions(),
    };
    usable.then_some((bounds, record))
}
