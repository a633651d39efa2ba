//! Traversal of both levels with one ray.

use super::single::{Stack, Visitor, traverse};
use crate::hit_callback::HitCallback;
use crate::intersect::lanes8::Lanes8;
use crate::intersect::line_ray::SmoothHits;
use crate::intersect::prepared::PreparedRay;
use crate::intersect::smooth::Smooth;
use crate::intersect::triangle_block::{BlockHits, TriangleBlock};
use crate::ray::{Hit, RayBatch};
use crate::tree::blas::Blas;
use crate::tree::instance::{Geometry, InstanceRecord, Owner};
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
    traverse_scene_from(lanes, scene, stacks, ChildRef::ROOT, &ray, rays.mask[i], callback)
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
    let origin = record.world_to_object.point(rays.origin_of(i));
    let direction = record.world_to_object.direction(rays.direction_of(i));
    let Some(ray) = PreparedRay::new(origin, direction, rays.t_min[i], callback.t_max()) else { return };
    traverse_mesh(lanes, &scene.meshes[index as usize], ChildRef::ROOT, &ray, record, stack, callback);
}

/// Sends a ray through the part of the scene's tree below `start`.
#[inline(always)]
pub(crate) fn traverse_scene_from<K: Lanes8, C: HitCallback>(
    lanes: K,
    scene: &Tlas,
    stacks: &mut SceneStacks,
    start: ChildRef,
    ray: &PreparedRay,
    mask: u8,
    callback: &mut C,
) -> bool {
    let mut visitor = SceneVisitor { scene, mask, stack: stacks.mesh_stack, callback };
    traverse(lanes, &scene.nodes, start, ray, stacks.stack, &mut visitor)
}

struct SceneVisitor<'a, C: HitCallback> {
    scene: &'a Tlas,
    mask: u8,
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
        if let (true, Geometry::Mesh(index)) = (record.identity, record.geometry.get()) {
            let mesh = &self.scene.meshes[index as usize];
            return traverse_mesh(lanes, mesh, ChildRef::ROOT, ray, record, self.stack, self.callback);
        }
        match record.geometry.get() {
            Geometry::Mesh(index) => {
                let Some(ray) = lanes.image(&record.world_to_object, ray, self.callback.t_max()) else { return false };
                traverse_mesh(lanes, &self.scene.meshes[index as usize], ChildRef::ROOT, &ray, record, self.stack, self.callback)
            }
            Geometry::Shape(shape) => record.intersect_shape(shape, ray.origin, ray.direction, ray.t_min, self.callback),
        }
    }
}

/// Sends a ray in object space through the part of a mesh's tree below `start`.
#[inline(always)]
pub(crate) fn traverse_mesh<K: Lanes8, C: HitCallback>(
    lanes: K,
    mesh: &Blas,
    start: ChildRef,
    ray: &PreparedRay,
    record: &InstanceRecord,
    stack: &mut Stack,
    callback: &mut C,
) -> bool {
    let mut visitor = MeshVisitor { mesh, record, callback };
    traverse(lanes, &mesh.nodes, start, ray, stack, &mut visitor)
}

struct MeshVisitor<'a, C: HitCallback> {
    mesh: &'a Blas,
    record: &'a InstanceRecord,
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
        if leaf.is(Kind::Triangles) {
            return intersect_leaf(lanes, &self.mesh.blocks[leaf.index()], ray, self.record.owner(), self.callback);
        }
        intersect_smooth(lanes, &self.mesh.smooth, leaf.index(), ray, self.record.owner(), self.callback)
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
fn intersect_smooth<K: Lanes8, C: HitCallback>(
    lanes: K,
    smooth: &Smooth,
    leaf: usize,
    ray: &PreparedRay,
    owner: Owner,
    callback: &mut C,
) -> bool {
    let mut hits = SmoothHits::default();
    let mut mask = lanes.smooth(smooth, leaf, ray, callback.t_max(), &mut hits);
    while mask != 0 {
        let lane = mask.trailing_zeros() as usize % WIDTH;
        mask &= mask - 1;
        // What an earlier lane of this leaf covers needs no description.
        if C::ORDERED && hits.t[lane] > callback.t_max() {
            continue;
        }
        let (primitive, u, v) = smooth.describe(leaf, lane, ray, &hits);
        let hit = Hit { t: hits.t[lane], u, v, primitive, instance: owner.id };
        if callback.add_smooth(hit, || smooth.leaves(leaf, lane, ray, hit.t), owner.transparent) {
            return true;
        }
    }
    false
}
