//! The steps of a ray in a stream at leaves of the scene's tree.

use super::scene_leaf::{SceneRays, enter, test};
use super::stream_ray::{NEXT, StreamRay};
use crate::hit_callback::HitCallback;
use crate::intersect::shape::Shape;
use crate::intersect::triangle_block::TriangleBlock;
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, MapKind, Owner};
use crate::tree::moving::MovingRecord;
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
    type Image = ();
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
    fn image(&mut self, record: &InstanceRecord) -> Option<()> {
        let ([ray, image], map, t_max) = (&mut self.ray.rays, &record.world_to_object, self.ray.callback.t_max());
        let may_hit = match record.map {
            MapKind::Translation | MapKind::Identity => image.shift(self.simd, ray, map.translation(self.simd), t_max),
            _ => image.move_by(self.simd, ray, map, t_max),
        };
        may_hit.then_some(())
    }

    #[inline(always)]
    fn image_in_motion(&mut self, moving: &MovingRecord) -> Option<()> {
        let ([ray, image], t_max) = (&mut self.ray.rays, self.ray.callback.t_max());
        let map = moving.enter(self.ray.time, ray, t_max)?;
        image.move_by(self.simd, ray, &map, t_max).then_some(())
    }

    #[inline(always)]
    fn walk(&mut self, mesh: &'a Blas, (): (), _owner: Owner) -> usize {
        if mesh.is_still() { self.ray.enter(mesh) } else { self.ray.pass_deforming(self.simd, mesh) }
    }
}
