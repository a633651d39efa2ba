//! The walk of one ray through both levels.

use super::blas::Blas;
use super::collector::{Collector, Hit};
use super::instance::{Geometry, InstanceRecord, Owner};
use super::lanes8::Lanes8;
use super::node::{ChildRef, Kind, WIDTH};
use super::prepared::PreparedRay;
use super::ray::RayBatch;
use super::scene_bvh::SceneBvh;
use super::triangle_block::{BlockHits, TriangleBlock};
use super::walk::{Stack, Visitor, walk};

/// The stacks of the two levels.
pub(super) struct SceneWalk<'a> {
    pub(super) stack: &'a mut Stack,
    pub(super) mesh_stack: &'a mut Stack,
}

/// Sends ray `i` of a batch through the scene; true when the collector ended the search.
#[inline(always)]
pub(super) fn walk_scene<K: Lanes8, C: Collector>(
    lanes: K,
    scene: &SceneBvh,
    stacks: &mut SceneWalk,
    rays: &RayBatch,
    i: usize,
    collector: &mut C,
) -> bool {
    let Some(ray) = lanes.prepare(rays.origin_of(i), rays.direction_of(i), rays.t_min[i], rays.t_max[i]) else { return false };
    walk_scene_from(lanes, scene, stacks, ChildRef::ROOT, &ray, rays.mask[i], collector)
}

/// Sends ray `i` of a batch through the mesh of one instance.
#[inline(always)]
pub(super) fn walk_instance<K: Lanes8, C: Collector>(
    lanes: K,
    scene: &SceneBvh,
    stack: &mut Stack,
    rays: &RayBatch,
    i: usize,
    instance: u32,
    collector: &mut C,
) {
    let Some(record) = scene.record_of.get(instance as usize).and_then(|place| scene.records.get(*place as usize)) else { return };
    let Geometry::Mesh(index) = record.geometry.get() else { return };
    let origin = record.world_to_object.point(rays.origin_of(i));
    let direction = record.world_to_object.direction(rays.direction_of(i));
    let Some(ray) = PreparedRay::new(origin, direction, rays.t_min[i], collector.t_max()) else { return };
    walk_mesh(lanes, &scene.meshes[index as usize], ChildRef::ROOT, &ray, record, stack, collector);
}

/// Sends a ray through the part of the scene's tree below `start`.
#[inline(always)]
pub(super) fn walk_scene_from<K: Lanes8, C: Collector>(
    lanes: K,
    scene: &SceneBvh,
    stacks: &mut SceneWalk,
    start: ChildRef,
    ray: &PreparedRay,
    mask: u8,
    collector: &mut C,
) -> bool {
    let mut visitor = SceneVisitor { scene, mask, stack: stacks.mesh_stack, collector };
    walk(lanes, &scene.nodes, start, ray, stacks.stack, &mut visitor)
}

struct SceneVisitor<'a, C: Collector> {
    scene: &'a SceneBvh,
    mask: u8,
    stack: &'a mut Stack,
    collector: &'a mut C,
}

impl<K: Lanes8, C: Collector> Visitor<K> for SceneVisitor<'_, C> {
    const ORDERED: bool = C::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.collector.t_max()
    }

    #[inline(always)]
    fn fetch(&self, child: ChildRef) {
        self.scene.fetch(child);
    }

    #[inline(always)]
    fn leaf(&mut self, lanes: K, ray: &PreparedRay, leaf: ChildRef) -> bool {
        if leaf.is(Kind::WorldTriangles) {
            let owner = self.scene.owners[leaf.index()];
            return owner.mask & self.mask != 0 && meet(lanes, &self.scene.blocks[leaf.index()], ray, owner, self.collector);
        }
        let record = &self.scene.records[leaf.index()];
        if record.mask & self.mask == 0 {
            return false;
        }
        if let (true, Geometry::Mesh(index)) = (record.identity, record.geometry.get()) {
            let mesh = &self.scene.meshes[index as usize];
            return walk_mesh(lanes, mesh, ChildRef::ROOT, ray, record, self.stack, self.collector);
        }
        match record.geometry.get() {
            Geometry::Mesh(index) => {
                let Some(ray) = lanes.image(&record.world_to_object, ray, self.collector.t_max()) else { return false };
                walk_mesh(lanes, &self.scene.meshes[index as usize], ChildRef::ROOT, &ray, record, self.stack, self.collector)
            }
            Geometry::Shape(shape) => record.meet_shape(shape, ray.origin, ray.direction, ray.t_min, self.collector),
        }
    }
}

/// Sends a ray in object space through the part of a mesh's tree below `start`.
#[inline(always)]
pub(super) fn walk_mesh<K: Lanes8, C: Collector>(
    lanes: K,
    mesh: &Blas,
    start: ChildRef,
    ray: &PreparedRay,
    record: &InstanceRecord,
    stack: &mut Stack,
    collector: &mut C,
) -> bool {
    let mut visitor = MeshVisitor { mesh, record, collector };
    walk(lanes, &mesh.nodes, start, ray, stack, &mut visitor)
}

struct MeshVisitor<'a, C: Collector> {
    mesh: &'a Blas,
    record: &'a InstanceRecord,
    collector: &'a mut C,
}

impl<K: Lanes8, C: Collector> Visitor<K> for MeshVisitor<'_, C> {
    const ORDERED: bool = C::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.collector.t_max()
    }

    #[inline(always)]
    fn fetch(&self, child: ChildRef) {
        self.mesh.fetch(child);
    }

    #[inline(always)]
    fn leaf(&mut self, lanes: K, ray: &PreparedRay, leaf: ChildRef) -> bool {
        meet(lanes, &self.mesh.blocks[leaf.index()], ray, self.record.owner(), self.collector)
    }
}

/// Hands the triangles of a block that a ray meets to a collector; true when it ended the search.
#[inline(always)]
fn meet<K: Lanes8, C: Collector>(lanes: K, block: &TriangleBlock, ray: &PreparedRay, owner: Owner, collector: &mut C) -> bool {
    let mut hits = BlockHits::default();
    let mut mask = lanes.triangles(block, ray, collector.t_max(), &mut hits);
    while mask != 0 {
        let lane = mask.trailing_zeros() as usize % WIDTH;
        mask &= mask - 1;
        let hit = Hit { t: hits.t[lane], u: hits.u[lane], v: hits.v[lane], primitive: block.primitives[lane], instance: owner.id };
        if collector.add(hit, owner.transparent) {
            return true;
        }
    }
    false
}
