//! Traversal of both levels with one ray.

use super::single::{Stack, Visitor, traverse};
use crate::hit_callback::HitCallback;
use crate::intersect::lanes8::Lanes8;
use crate::intersect::line_ray::SmoothHits;
use crate::intersect::prepared::PreparedRay;
use crate::intersect::smooth::SmoothLeaf;
use crate::intersect::triangle_block::{BlockHits, TriangleBlock};
use crate::ray::{Hit, RayBatch, RayMask};
use crate::tree::blas::Blas;
use crate::tree::instance::{Geometry, InstanceRecord, MapKind, Owner};
use crate::tree::node::{ChildRef, Kind, WIDTH};
use crate::tree::tlas::Tlas;

/// The stacks of the two levels.
pub(crate) struct SceneStacks<'a> {
    pub(crate) stack: &'a mut Stack,
    pub(crate) mesh_stack: &'a mut Stack,
}

/// Sends ray `i` of a batch through the scene; true when the callback ended the search.
#[inline(always)]
pub(crate) fn traverse_scene<K: Lanes8, C: HitCallback>(
    lanes: K,
    scene: &Tlas,
    stacks: &mut SceneStacks,
    rays: &RayBatch,
    i: usize,
    callback: &mut C,
) -> bool {
    let Some(ray) = lanes.prepare(rays.origin_of(i), rays.direction_of(i), rays.t_min[i], rays.t_max[i]) else { return false };
    traverse_scene_from(lanes, scene, stacks, ChildRef::ROOT, &ray, (rays.mask[i], rays.time_of(i)), callback)
}

/// Sends ray `i` of a batch through the mesh of one instance.
#[inline(always)]
pub(crate) fn traverse_instance<K: Lanes8, C: HitCallback>(
    lanes: K,
    scene: &Tlas,
    stack: &mut Stack,
    rays: &RayBatch,
    i: usize,
    instance: u32,
    callback: &mut C,
) {
    let Some(record) = scene.record_of.get(instance as usize).and_then(|place| scene.records.get(*place as usize)) else { return };
    let Geometry::Mesh(index) = record.geometry.get() else { return };
    let moving = record.map == MapKind::Moving;
    let at_time = if moving { scene.moving(record.id).world_to_object(rays.time_of(i)) } else { Some(record.world_to_object) };
    let Some(map) = at_time else { return };
    let (origin, direction) = (map.point(rays.origin_of(i)), map.direction(rays.direction_of(i)));
    let Some(ray) = PreparedRay::new(origin, direction, rays.t_min[i], callback.t_max()) else { return };
    traverse_mesh(lanes, &scene.meshes[index as usize], ChildRef::ROOT, &ray, (record, rays.time_of(i)), stack, callback);
}

/// Sends a ray of a visibility mask and a time through the part of the scene's tree below `start`.
#[inline(always)]
pub(crate) fn traverse_scene_from<K: Lanes8, C: HitCallback>(
    lanes: K,
    scene: &Tlas,
    stacks: &mut SceneStacks,
    start: ChildRef,
    ray: &PreparedRay,
    (mask, time): (RayMask, f32),
    callback: &mut C,
) -> bool {
    let mut visitor = SceneVisitor { scene, mask, time, stack: stacks.mesh_stack, callback };
    traverse(lanes, &scene.nodes, start, ray, stacks.stack, &mut visitor)
}

struct SceneVisitor<'a, C: HitCallback> {
    scene: &'a Tlas,
    mask: RayMask,
    time: f32,
    stack: &'a mut Stack,
    callback: &'a mut C,
}

impl<K: Lanes8, C: HitCallback> Visitor<K> for SceneVisitor<'_, C> {
    const ORDERED: bool = C::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.callback.t_max()
    }

    #[inline(always)]
    fn fetch(&self, child: ChildRef) {
        self.scene.fetch(child);
    }

    #[inline(always)]
    fn leaf(&mut self, lanes: K, ray: &PreparedRay, leaf: ChildRef) -> bool {
        if leaf.is(Kind::WorldTriangles) {
            let owner = self.scene.owners[leaf.index()];
            return owner.mask & self.mask != 0 && intersect_leaf(lanes, &self.scene.blocks[leaf.index()], ray, owner, self.callback);
        }
        let record = &self.scene.records[leaf.index()];
        if record.mask & self.mask == 0 {
            return false;
        }
        if let (MapKind::Identity, Geometry::Mesh(index)) = (record.map, record.geometry.get()) {
            let mesh = &self.scene.meshes[index as usize];
            return traverse_mesh(lanes, mesh, ChildRef::ROOT, ray, (record, self.time), self.stack, self.callback);
        }
        match record.geometry.get() {
            Geometry::Mesh(index) => {
                let moved;
                let map = if record.map == MapKind::Moving {
                    let Some(map) = self.scene.moving(record.id).enter(self.time, ray, self.callback.t_max()) else { return false };
                    moved = map;
                    &moved
                } else {
                    &record.world_to_object
                };
                let Some(ray) = lanes.image(map, ray, self.callback.t_max()) else { return false };
                traverse_mesh(
                    lanes,
                    &self.scene.meshes[index as usize],
                    ChildRef::ROOT,
                    &ray,
                    (record, self.time),
                    self.stack,
                    self.callback,
                )
            }
            Geometry::Shape(shape) => record.intersect_shape(shape, ray.origin, ray.direction, ray.t_min, self.callback),
        }
    }
}

/// Sends a ray in object space and at a time through the part of a mesh's tree below `start`.
#[inline(always)]
pub(crate) fn traverse_mesh<K: Lanes8, C: HitCallback>(
    lanes: K,
    mesh: &Blas,
    start: ChildRef,
    ray: &PreparedRay,
    (record, time): (&InstanceRecord, f32),
    stack: &mut Stack,
    callback: &mut C,
) -> bool {
    let mut visitor = MeshVisitor { mesh, record, time, callback };
    traverse(lanes, &mesh.nodes, start, ray, stack, &mut visitor)
}

struct MeshVisitor<'a, C: HitCallback> {
    mesh: &'a Blas,
    record: &'a InstanceRecord,
    time: f32,
    callback: &'a mut C,
}

impl<K: Lanes8, C: HitCallback> Visitor<K> for MeshVisitor<'_, C> {
    const ORDERED: bool = C::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.callback.t_max()
    }

    #[inline(always)]
    fn fetch(&self, child: ChildRef) {
        self.mesh.fetch(child);
    }

    #[inline(always)]
    fn leaf(&mut self, lanes: K, ray: &PreparedRay, leaf: ChildRef) -> bool {
        if !leaf.is(Kind::Triangles) {
            if self.mesh.is_still() {
                return intersect_smooth(lanes, self.mesh.smooth.leaf(leaf.index()), ray, self.record.owner(), self.callback);
            }
            return self.moved(lanes, ray, leaf.index());
        }
        if self.mesh.is_still() {
            return intersect_leaf(lanes, &self.mesh.blocks[leaf.index()], ray, self.record.owner(), self.callback);
        }
        let block = self.mesh.block_at(leaf.index(), self.time);
        intersect_leaf(lanes, &block, ray, self.record.owner(), self.callback)
    }
}

impl<C: HitCallback> MeshVisitor<'_, C> {
    /// A leaf of curves or points that move; apart, because triangles shall not pay for its room on the stack.
    #[inline(never)]
    fn moved<K: Lanes8>(&mut self, lanes: K, ray: &PreparedRay, leaf: usize) -> bool {
        let moved = self.mesh.smooth_at(leaf, self.time);
        intersect_smooth(lanes, moved.leaf(), ray, self.record.owner(), self.callback)
    }
}

/// Hands the triangles of a block that a ray meets to a callback; true when it ended the search.
#[inline(always)]
fn intersect_leaf<K: Lanes8, C: HitCallback>(lanes: K, block: &TriangleBlock, ray: &PreparedRay, owner: Owner, callback: &mut C) -> bool {
    let mut hits = BlockHits::default();
    let mut mask = lanes.triangles(block, ray, callback.t_max(), &mut hits);
    while mask != 0 {
        let lane = mask.trailing_zeros() as usize % WIDTH;
        mask &= mask - 1;
        let hit = Hit { t: hits.t[lane], u: hits.u[lane], v: hits.v[lane], primitive: block.primitives[lane], instance: owner.id };
        if callback.add(hit, owner.transparent) {
            return true;
        }
    }
    false
}

/// Hands the pieces of curves or points of a leaf that a ray meets to a callback; true when it ended the search.
#[inline(always)]
fn intersect_smooth<K: Lanes8, C: HitCallback>(lanes: K, leaf: SmoothLeaf<'_>, ray: &PreparedRay, owner: Owner, callback: &mut C) -> bool {
    let mut hits = SmoothHits::default();
    let mut mask = lanes.smooth(leaf, ray, callback.t_max(), &mut hits);
    while mask != 0 {
        let lane = mask.trailing_zeros() as usize % WIDTH;
        mask &= mask - 1;
        // What an earlier lane of this leaf covers needs no description.
        if C::ORDERED && hits.t[lane] > callback.t_max() {
            continue;
        }
        let (primitive, u, v) = leaf.describe(lane, ray, &hits);
        let hit = Hit { t: hits.t[lane], u, v, primitive, instance: owner.id };
        if callback.add_smooth(hit, || leaf.leaves(lane, ray, hit.t), owner.transparent) {
            return true;
        }
    }
    false
}
