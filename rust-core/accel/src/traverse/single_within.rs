//! Traversal of the mesh of one instance, whatever else is in the way.

use super::scene_leaf::{Place, SceneRays, enter};
use super::single::Stack;
use super::single_mesh::traverse_mesh;
use crate::hit_callback::HitCallback;
use crate::intersect::lanes8::Lanes8;
use crate::intersect::prepared::PreparedRay;
use crate::intersect::shape::Shape;
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::RayBatch;
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, Owner};
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

impl<'a, K: Lanes8, C: HitCallback> SceneRays<'a> for RayWithin<'_, K, C> {
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
    fn walk(&mut self, mesh: &Blas, place: Place<'_>, owner: Owner) {
        let (rays, i) = (self.rays, self.i);
        let moved;
        let map = match place {
            Place::AtRest(_, map) => map,
            Place::InMotion(moving) => {
                let Some(map) = moving.world_to_object(rays.time_of(i)) else { return };
                moved = map;
                &moved
            }
        };
        let (origin, direction) = (map.point(rays.origin_of(i)), map.direction(rays.direction_of(i)));
        let Some(ray) = PreparedRay::new(origin, direction, rays.t_min[i], self.callback.t_max()) else { return };
        traverse_mesh(self.lanes, mesh, ChildRef::ROOT, &ray, (owner, rays.time_of(i)), self.stack, self.callback);
    }
}
