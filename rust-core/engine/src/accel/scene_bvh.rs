//! The tree over the instances of a scene.

use super::Cancelled;
use super::blas::Blas;
use super::build::{Effort, build};
use super::collapse::LeafMaker;
use super::instance::{Geometry, Instance, InstanceRecord, PackedGeometry};
use super::node::{Bounds, Kind, LARGEST_COORDINATE, MAX_INDEX, Node};
use super::ray::NONE;
use super::transform::{Affine, inverse, transformed_bounds};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Two-level tree of a scene: instances over shared meshes and analytic shapes.
#[derive(Clone, Debug)]
pub struct SceneBvh {
    pub(super) nodes: Vec<Node>,
    pub(super) records: Vec<InstanceRecord>,
    /// Record of each instance by its number, [`NONE`] for those left out.
    pub(super) record_of: Vec<u32>,
    pub(super) meshes: Vec<Arc<Blas>>,
    /// So large that incoherent rays gain from going together.
    pub(super) is_large: bool,
}

impl SceneBvh {
    /// Builds the top level over `instances`, whose order gives the instance numbers in the hits.
    ///
    /// Instances of missing or empty meshes, with singular maps or beyond 1e12 metres are left out; no ray hits them.
    pub fn build(meshes: Vec<Arc<Blas>>, instances: &[Instance], cancel: &AtomicBool) -> Result<SceneBvh, Cancelled> {
        let mut boxes = Vec::with_capacity(instances.len());
        let mut records = Vec::with_capacity(instances.len());
        for (id, instance) in instances.iter().enumerate() {
            if let Some((bounds, record)) = placed(&meshes, instance, id as u32) {
                boxes.push(bounds);
                records.push(record);
            }
        }
        assert!(boxes.len() <= MAX_INDEX, "a scene holds at most {MAX_INDEX} instances");
        let effort = if boxes.len() <= MANY_INSTANCES { Effort::THOROUGH } else { Effort::QUICK };
        let tree = build(&boxes, &Records(&records), effort, cancel)?;
        let mut record_of = vec![NONE; instances.len()];
        for (place, record) in tree.leaves.iter().enumerate() {
            record_of[record.id as usize] = place as u32;
        }
        let bytes =
            meshes.iter().map(|mesh| mesh.memory().bytes()).sum::<usize>() + size_of_val(&tree.nodes[..]) + size_of_val(&tree.leaves[..]);
        Ok(SceneBvh { nodes: tree.nodes, records: tree.leaves, record_of, meshes, is_large: bytes > SMALL })
    }

    /// The same meshes with their instances placed anew, as for moved objects: the mesh trees are kept.
    pub fn rebuild(&mut self, instances: &[Instance], cancel: &AtomicBool) -> Result<(), Cancelled> {
        *self = SceneBvh::build(self.meshes.clone(), instances, cancel)?;
        Ok(())
    }

    /// The mesh trees, in the order of the numbers in [`Geometry::Mesh`].
    pub fn meshes(&self) -> &[Arc<Blas>] {
        &self.meshes
    }

    /// Bytes of the top level, without the meshes.
    pub fn memory(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.records.capacity() * size_of::<InstanceRecord>() + self.record_of.capacity() * 4
    }
}

/// In trees of so many bytes, which stay in a core's second cache, one ray after the other is as fast.
const SMALL: usize = 1 << 20;

/// Above this number of instances the top level gets no more care than a mesh, so that moving one stays quick.
const MANY_INSTANCES: usize = 50_000;

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
    };
    usable.then_some((bounds, record))
}

/// Puts instance records into the order of the tree.
struct Records<'a>(&'a [InstanceRecord]);

impl LeafMaker for Records<'_> {
    type Leaf = InstanceRecord;
    const CAPACITY: u32 = 1;
    const KIND: Kind = Kind::Instance;
    const COST: f32 = 1.0;

    fn leaf(&self, primitives: &[u32]) -> InstanceRecord {
        self.0[primitives[0] as usize]
    }
}
