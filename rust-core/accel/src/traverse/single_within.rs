//! Traversal of the mesh of one instance, whatever else is in the way.

use super::scene_leaf::{SceneRays, enter};
use super::single::Stack;
use super::single_mesh::traverse_mesh;
use crate::hit_callback::HitCallback;
use crate::intersect::lanes8::Lanes8;
use crate::intersect::prepared::PreparedRay;
use crate::intersect::shape::Shape;
use crate::intersect::transform::Affine;
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::RayBatch;
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, Owner};
use crate::tree::moving::MovingRecord;
use crate::tree::node::ChildRef;
use crate::tree::tlas::Tlas;

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
    enter(scene, record, &mut RayWithin { lanes, rays, i, stack, callback });
}

/// A ray that is known to be within an instance, whatever it sees.
struct RayWithin<'r, K: Lanes8, C: HitCallback> {
    lanes: K,
    rays: &'r RayBatch<'r>,
    i: usize,
    stack: &'r mut Stack,
    callback: &'r mut C,
}

impl<K: Lanes8, C: HitCallback> RayWithin<'_, K, C> {
    #[inline(always)]
    fn moved_by(&self, map: &Affine) -> Option<PreparedRay> {
        let (rays, i) = (self.rays, self.i);
        PreparedRay::new(map.point(rays.origin_of(i)), map.direction(rays.direction_of(i)), rays.t_min[i], self.callback.t_max())
    }
}

impl<'a, K: Lanes8, C: HitCallback> SceneRays<'a> for RayWithin<'_, K, C> {
    type Image = PreparedRay;
    type Next = ();
    const PAST: () = ();

    #[inline(always)]
    fn see(&mut self, _owner: Owner) -> bool {
        true
    }

    #[inline(always)]
    fn triangles(&mut self, _block: &TriangleBlock, _owner: Owner) {}

    #[inline(always)]
    fn shape(&mut self, _shape: Shape, _record: &InstanceRecord) {}

    #[inline(always)]
    fn image(&mut self, record: &InstanceRecord) -> Option<PreparedRay> {
        self.moved_by(&record.world_to_object)
    }

    #[inline(always)]
    fn image_in_motion(&mut self, moving: &MovingRecord) -> Option<PreparedRay> {
        self.moved_by(&moving.world_to_object(self.rays.time_of(self.i))?)
    }

    #[inline(always)]
    fn walk(&mut self, mesh: &Blas, image: PreparedRay, owner: Owner) {
        let at = (owner, self.rays.time_of(self.i));
        traverse_mesh(self.lanes, mesh, ChildRef::ROOT, &image, at, self.stack, self.callback);
    }
}
