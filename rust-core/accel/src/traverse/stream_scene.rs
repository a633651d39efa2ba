//! The steps of a ray in a stream at leaves of the scene's tree.

use super::scene_leaf::{Place, SceneRays, enter, test};
use super::stream_ray::{NEXT, StreamRay};
use crate::hit_callback::HitCallback;
use crate::intersect::shape::Shape;
use crate::intersect::triangle_block::TriangleBlock;
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, MapKind, Owner};
use crate::tree::tlas::Tlas;
use fearless_simd::prelude::*;

impl<'a, C: HitCallback> StreamRay<'a, C> {
    /// The step at a block of triangles in world space.
    #[inline(always)]
    pub(crate) fn world_triangles<S: Simd>(&mut self, simd: S, scene: &'a Tlas) -> usize {
        let block = self.current.index();
        test(scene, block, &mut StreamedRay { simd, ray: self })
    }

    /// The step at an instance.
    #[inline(always)]
    pub(crate) fn instance<S: Simd>(&mut self, simd: S, scene: &'a Tlas) -> usize {
        let record = &scene.records[self.current.index()];
        enter(scene, record, &mut StreamedRay { simd, ray: self })
    }
}

/// A ray of a stream at a leaf of the scene's tree; its image stays where it is.
struct StreamedRay<'r, 'a, S: Simd, C: HitCallback> {
    simd: S,
    ray: &'r mut StreamRay<'a, C>,
}

impl<'a, S: Simd, C: HitCallback> SceneRays<'a> for StreamedRay<'_, 'a, S, C> {
    /// The number of its next step.
    type Next = usize;
    const PAST: usize = NEXT;

    #[inline(always)]
    fn see(&mut self, owner: Owner) -> bool {
        self.ray.owner = owner;
        owner.mask & self.ray.mask != 0
    }

    #[inline(always)]
    fn triangles(&mut self, block: &'a TriangleBlock, _owner: Owner) -> usize {
        self.ray.test(self.simd, 0, block)
    }

    #[inline(always)]
    fn shape(&mut self, shape: Shape, record: &InstanceRecord) -> usize {
        let [ray, _] = &self.ray.rays;
        let ended = record.intersect_shape(shape, ray.origin, ray.direction, ray.t_min, &mut self.ray.callback);
        self.ray.go_on(ended)
    }

    #[inline(always)]
    fn walk(&mut self, mesh: &'a Blas, place: Place<'_>, _owner: Owner) -> usize {
        let (simd, [ray, image], t_max) = (self.simd, &mut self.ray.rays, self.ray.callback.t_max());
        let may_hit = match place {
            Place::AtRest(MapKind::Translation | MapKind::Identity, map) => image.shift(simd, ray, map.translation(simd), t_max),
            Place::AtRest(_, map) => image.move_by(simd, ray, map, t_max),
            Place::InMotion(moving) => match moving.enter(self.ray.time, ray, t_max) {
                Some(map) => image.move_by(simd, ray, &map, t_max),
                None => false,
            },
        };
        match (may_hit, mesh.is_still()) {
            (false, _) => NEXT,
            (true, true) => self.ray.enter(mesh),
            (true, false) => self.ray.pass_deforming(simd, mesh),
        }
    }
}
