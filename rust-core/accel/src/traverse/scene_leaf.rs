//! What happens at the leaves of the scene's tree: triangles in world space are tested, instances entered. Rays alone, packets and streams all do it here.

use crate::intersect::shape::Shape;
use crate::intersect::triangle_block::TriangleBlock;
use crate::tree::blas::Blas;
use crate::tree::instance::{Geometry, InstanceRecord, MapKind, Owner};
use crate::tree::moving::MovingRecord;
use crate::tree::node::{ChildRef, Kind};
use crate::tree::tlas::Tlas;

/// One ray or several at a leaf of the scene's tree.
pub(crate) trait SceneRays<'a> {
    /// The rays in the space of an instance.
    type Image;
    /// How they go on.
    type Next;
    /// They go on as if there were no leaf.
    const PAST: Self::Next;

    /// Whether any of them sees what has this owner. Those that do not take no part in what follows.
    fn see(&mut self, owner: Owner) -> bool;
    /// Tests triangles in world space.
    fn triangles(&mut self, block: &'a TriangleBlock, owner: Owner) -> Self::Next;
    /// Tests the shape of an instance.
    fn shape(&mut self, shape: Shape, record: &InstanceRecord) -> Self::Next;
    /// The rays in the space of an instance that stands still, if any of them can hit something there.
    fn image(&mut self, record: &InstanceRecord) -> Option<Self::Image>;
    /// The same for an instance that moves.
    fn image_in_motion(&mut self, moving: &MovingRecord) -> Option<Self::Image>;
    /// Walks the tree of a mesh, or of curves or points.
    fn walk(&mut self, mesh: &'a Blas, image: Self::Image, owner: Owner) -> Self::Next;
}

/// Shows rays a leaf of the scene's tree.
#[inline(always)]
pub(crate) fn visit<'a, R: SceneRays<'a>>(scene: &'a Tlas, leaf: ChildRef, rays: &mut R) -> R::Next {
    if leaf.is(Kind::WorldTriangles) { test(scene, leaf.index(), rays) } else { enter(scene, &scene.records[leaf.index()], rays) }
}

/// Has rays test a block of triangles in world space.
#[inline(always)]
pub(crate) fn test<'a, R: SceneRays<'a>>(scene: &'a Tlas, block: usize, rays: &mut R) -> R::Next {
    let owner = scene.owners[block];
    if rays.see(owner) { rays.triangles(&scene.blocks[block], owner) } else { R::PAST }
}

/// Has rays enter an instance.
#[inline(always)]
pub(crate) fn enter<'a, R: SceneRays<'a>>(scene: &'a Tlas, record: &InstanceRecord, rays: &mut R) -> R::Next {
    if !rays.see(record.owner()) {
        return R::PAST;
    }
    match record.geometry.get() {
        Geometry::Mesh(index) => {
            let image = match record.map {
                MapKind::Moving => rays.image_in_motion(scene.moving(record.id)),
                _ => rays.image(record),
            };
            let Some(image) = image else { return R::PAST };
            rays.walk(&scene.meshes[index as usize], image, record.owner())
        }
        Geometry::Shape(shape) => rays.shape(shape, record),
    }
}
