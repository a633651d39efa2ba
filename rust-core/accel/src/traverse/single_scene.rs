//! Traversal of both levels with one ray.

use super::scene_leaf::{Place, SceneRays, visit};
use super::single::{Stack, Visitor, traverse};
use super::single_mesh::traverse_mesh;
use crate::hit_callback::HitCallback;
use crate::intersect::lanes8::Lanes8;
use crate::intersect::leaf::{LeafVisitor, RayAtLeaf};
use crate::intersect::prepared::PreparedRay;
use crate::intersect::shape::Shape;
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::{RayBatch, RayMask};
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, MapKind, Owner};
use crate::tree::node::ChildRef;
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
        visit(self.scene, leaf, &mut SceneRay { lanes, ray, visitor: self })
    }
}

/// A ray of the world at a leaf of the scene's tree; true ends its search.
struct SceneRay<'r, 'a, K: Lanes8, C: HitCallback> {
    lanes: K,
    ray: &'r PreparedRay,
    visitor: &'r mut SceneVisitor<'a, C>,
}

impl<'r, K: Lanes8, C: HitCallback> SceneRays<'r> for SceneRay<'r, '_, K, C> {
    type Next = bool;
    const PAST: bool = false;

    #[inline(always)]
    fn see(&mut self, owner: Owner) -> bool {
        owner.mask & self.visitor.mask != 0
    }

    #[inline(always)]
    fn triangles(&mut self, block: &TriangleBlock, owner: Owner) -> bool {
        RayAtLeaf { lanes: self.lanes, ray: self.ray, owner, callback: self.visitor.callback }.visit(block)
    }

    #[inline(always)]
    fn shape(&mut self, shape: Shape, record: &InstanceRecord) -> bool {
        record.intersect_shape(shape, self.ray.origin, self.ray.direction, self.ray.t_min, self.visitor.callback)
    }

    #[inline(always)]
    fn walk(&mut self, mesh: &Blas, place: Place<'_>, owner: Owner) -> bool {
        let SceneVisitor { time, stack, callback, .. } = &mut *self.visitor;
        let (lanes, ray, at) = (self.lanes, self.ray, (owner, *time));
        let moved;
        let map = match place {
            Place::AtRest(MapKind::Identity, _) => return traverse_mesh(lanes, mesh, ChildRef::ROOT, ray, at, stack, *callback),
            Place::AtRest(_, map) => map,
            Place::InMotion(moving) => {
                let Some(map) = moving.enter(*time, ray, callback.t_max()) else { return false };
                moved = map;
                &moved
            }
        };
        let Some(image) = lanes.image(map, ray, callback.t_max()) else { return false };
        traverse_mesh(lanes, mesh, ChildRef::ROOT, &image, at, stack, *callback)
    }
}
