//! The top-level acceleration structure (TLAS): the tree over the instances of a scene.

use super::blas::Blas;
use super::instance::{Instance, InstanceRecord, Owner};
use super::loose_lights::{LooseLight, MOST_LOOSE};
use super::moving::{MovingInstance, MovingRecord};
use super::node::{ChildRef, Kind, MAX_INDEX, Node};
use super::tlas_input::TlasInput;
use crate::build::collapse::{LeafMaker, LeafRule};
use crate::build::effort::Effort;
use crate::build::wide_tree::build;
use crate::cancelled::Cancelled;
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::NONE;
use crate::traverse::stream_tuner::StreamTuners;
use gonio_simd::prefetch;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Top level (TLAS) of a scene's tree: instances over shared meshes (BLASes) and analytic shapes.
#[derive(Clone, Debug)]
pub struct Tlas {
    pub(crate) nodes: Vec<Node>,
    pub(crate) records: Vec<InstanceRecord>,
    /// Record of each instance by its number, [`NONE`] for those left out.
    pub(crate) record_of: Vec<u32>,
    /// World-space leaves: triangles that stand in the top level themselves, and the instances that they belong to.
    pub(crate) blocks: Vec<TriangleBlock>,
    pub(crate) owners: Vec<Owner>,
    pub(crate) meshes: Vec<Arc<Blas>>,
    /// Instances that move, and the place of each instance among them; both empty where all stand still.
    pub(crate) moving: Vec<MovingRecord>,
    pub(crate) moving_of: Vec<u32>,
    /// Shapes of lights that are not in the tree.
    pub(crate) loose_lights: Vec<LooseLight>,
    /// Whether the tree is so large that incoherent rays may gain from ray streams.
    pub(crate) is_large: bool,
    /// Whether ray streams are faster than single rays, as measured.
    pub(crate) tuners: StreamTuners,
}

impl Tlas {
    /// Builds the top level over `instances`, whose order gives the instance numbers in the hits.
    ///
    /// Instances of missing or empty meshes, with singular maps or beyond 1e12 metres are left out; no ray hits them.
    pub fn build(meshes: Vec<Arc<Blas>>, instances: &[Instance], cancel: &AtomicBool) -> Result<Tlas, Cancelled> {
        Tlas::build_moving(meshes, instances, &[], instances.len(), cancel)
    }

    /// [`Tlas::build`] where the instances from `first_light` on are shapes that no shadow ray sees: queries for what is in a ray's way need
    /// not find them.
    pub fn build_with_lights(
        meshes: Vec<Arc<Blas>>,
        instances: &[Instance],
        first_light: usize,
        cancel: &AtomicBool,
    ) -> Result<Tlas, Cancelled> {
        Tlas::build_moving(meshes, instances, &[], first_light, cancel)
    }

    /// [`Tlas::build_with_lights`] where instances of meshes may move; `moving` is sorted by their numbers.
    pub fn build_moving(
        meshes: Vec<Arc<Blas>>,
        instances: &[Instance],
        moving: &[MovingInstance],
        first_light: usize,
        cancel: &AtomicBool,
    ) -> Result<Tlas, Cancelled> {
        let first_loose = if instances.len() - first_light <= MOST_LOOSE { first_light } else { instances.len() };
        let input = TlasInput::new(&meshes, instances, moving, first_loose, instances.len() <= MOST_OPENED);
        assert!(input.boxes.len() <= MAX_INDEX, "the top level holds at most {MAX_INDEX} boxes");
        let effort = if input.boxes.len() <= MANY_BOXES { Effort::THOROUGH } else { Effort::QUICK };
        let tree = build(&input.boxes, &Numbers, effort, cancel)?;
        let mut scene = Tlas {
            nodes: tree.nodes,
            records: Vec::with_capacity(input.records.len()),
            record_of: vec![NONE; instances.len()],
            blocks: Vec::with_capacity(input.blocks.len()),
            owners: Vec::with_capacity(input.blocks.len()),
            meshes,
            moving: Vec::new(),
            moving_of: Vec::new(),
            loose_lights: Vec::new(),
            is_large: false,
            tuners: StreamTuners::default(),
        };
        scene.fill(&input, &tree.leaves);
        scene.keep_moving(input.moving, instances.len());
        let in_place = (first_loose..).zip(&instances[first_loose..]).filter(|(number, _)| scene.record_of[*number] != NONE);
        scene.loose_lights = in_place.filter_map(|(number, instance)| LooseLight::new(instance, scene.record_of[number])).collect();
        scene.is_large = scene.meshes.iter().map(|mesh| mesh.memory().bytes()).sum::<usize>() + scene.memory() > SMALL;
        Ok(scene)
    }

    /// Takes over what was placed in the order of the tree's leaves; instances that were taken apart stay known by their records.
    fn fill(&mut self, input: &TlasInput, leaves: &[u32]) {
        let mut children = Vec::with_capacity(leaves.len());
        for &number in leaves {
            let content = input.contents[number as usize];
            children.push(if content.is(Kind::Instance) {
                self.keep(input.records[content.index()]);
                ChildRef::new(Kind::Instance, self.records.len() - 1)
            } else {
                self.blocks.push(input.blocks[content.index()]);
                self.owners.push(input.owners[content.index()]);
                ChildRef::new(Kind::WorldTriangles, self.blocks.len() - 1)
            });
        }
        for child in self.nodes.iter_mut().flat_map(|node| &mut node.children).filter(|child| !child.is_inner()) {
            *child = children[child.index()];
        }
        for record in &input.records {
            if self.record_of[record.id as usize] == NONE {
                self.keep(*record);
            }
        }
    }

    fn keep_moving(&mut self, moving: Vec<(u32, MovingRecord)>, instances: usize) {
        if !moving.is_empty() {
            self.moving_of = vec![NONE; instances];
        }
        for (instance, moves) in moving {
            self.moving_of[instance as usize] = self.moving.len() as u32;
            self.moving.push(moves);
        }
    }

    fn keep(&mut self, record: InstanceRecord) {
        self.record_of[record.id as usize] = self.records.len() as u32;
        self.records.push(record);
    }

    /// The same meshes with their instances placed anew, as for moved objects: the mesh trees are kept.
    pub fn rebuild(&mut self, instances: &[Instance], cancel: &AtomicBool) -> Result<(), Cancelled> {
        let rebuilt = Tlas::build(self.meshes.clone(), instances, cancel)?;
        *self = Tlas { tuners: std::mem::take(&mut self.tuners), ..rebuilt };
        Ok(())
    }

    /// The mesh trees, in the order of the numbers in [`Geometry::Mesh`](crate::Geometry::Mesh).
    pub fn meshes(&self) -> &[Arc<Blas>] {
        &self.meshes
    }

    /// Whether anything moves while the shutter is open.
    pub fn moves(&self) -> bool {
        !self.moving.is_empty() || self.meshes.iter().any(|mesh| !mesh.is_still())
    }

    /// How an instance moves whose record says that it does.
    #[inline(always)]
    pub(crate) fn moving(&self, instance: u32) -> &MovingRecord {
        &self.moving[self.moving_of[instance as usize] as usize]
    }

    /// Has memory fetch a child of the top level.
    #[inline(always)]
    pub(crate) fn fetch(&self, child: ChildRef) {
        if child.is_inner() {
            prefetch(&self.nodes, child.index());
        } else if child.is(Kind::Instance) {
            prefetch(&self.records, child.index());
        } else {
            prefetch(&self.blocks, child.index());
        }
    }

    /// Bytes of the top level, without the meshes.
    pub fn memory(&self) -> usize {
        let blocks = self.blocks.capacity() * (size_of::<TriangleBlock>() + size_of::<Owner>());
        let records = self.records.capacity() * size_of::<InstanceRecord>() + self.record_of.capacity() * size_of::<u32>();
        self.nodes.capacity() * size_of::<Node>() + records + blocks
    }
}

/// In trees of so many bytes, which stay in a core's second cache, one ray after the other is thought to be as fast until it has been tried.
const SMALL: usize = 1 << 20;

/// Above this number of boxes the top level gets no more care than a mesh, so that moving an instance stays quick.
const MANY_BOXES: usize = 50_000;

/// Above this number of instances none is taken apart, for the same reason.
const MOST_OPENED: usize = 1 << 12;

/// Leaves hold one box each, by its number.
struct Numbers;

impl LeafMaker for Numbers {
    type Leaf = u32;
    const RULE: LeafRule = LeafRule { capacity: 1, cost: 1.0 };
    const KIND: Kind = Kind::Instance;

    fn leaf(&self, primitives: &[u32]) -> u32 {
        primitives[0]
    }
}
