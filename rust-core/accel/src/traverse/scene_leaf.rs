//! What happens at the leaves of the scene's tree: triangles in world space are tested, instances entered. Rays alone, packets and streams all do it here.

use crate::intersect::shape::Shape;
use crate::intersect::transform::Affine;
use crate::intersect::triangle_block::TriangleBlock;
use crate::tree::blas::Blas;
use crate::tree::instance::{Geometry, InstanceRecord, MapKind, Owner};
use crate::tree::moving::MovingRecord;
use crate::tree::node::{ChildRef, Kind};
use crate::tree::tlas::Tlas;

/// One ray or several at a leaf of the scene's tree.
pub(crate) trait SceneRays<'a> {
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
    /// Goes into the space of an instance, and through the tree of its mesh, or of its curves or points.
    fn walk(&mut self, mesh: &'a Blas, place: Place<'_>, owner: Owner) -> Self::Next;
}

/// The map from the world to an instance's space.
pub(crate) enum Place<'m> {
    AtRest(MapKind, &'m Affine),
    InMotion(&'m MovingRecord),
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
            let place = match record.map {
                MapKind::Moving => Place::InMotion(scene.moving(record.id)),
                kind => Place::AtRest(kind, &record.world_to_object),
            };
            rays.walk(&scene.meshes[index as usize], place, record.owner())
        }
        Geometry::Shape(shape) => rays.shape(shape, record),
    }
}
