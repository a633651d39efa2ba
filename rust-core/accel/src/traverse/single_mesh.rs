//! Traversal of the tree of a mesh, or of curves or points, with one ray.

use super::single::{Stack, Visitor, traverse};
use crate::hit_callback::HitCallback;
use crate::intersect::lanes8::Lanes8;
use crate::intersect::leaf::RayAtLeaf;
use crate::intersect::prepared::PreparedRay;
use crate::tree::blas::Blas;
use crate::tree::instance::Owner;
use crate::tree::node::ChildRef;

/// Sends a ray in object space and at a time through the part of a mesh's tree below `start`; true when the callback ended the search.
#[inline(always)]
pub(crate) fn traverse_mesh<K: Lanes8, C: HitCallback>(
    lanes: K,
    mesh: &Blas,
    start: ChildRef,
    ray: &PreparedRay,
    (owner, time): (Owner, f32),
    stack: &mut Stack,
    callback: &mut C,
) -> bool {
    let mut visitor = MeshVisitor { mesh, owner, time, callback };
    traverse(lanes, &mesh.nodes, start, ray, stack, &mut visitor)
}

struct MeshVisitor<'a, C: HitCallback> {
    mesh: &'a Blas,
    owner: Owner,
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
        self.mesh.leaf_at(leaf, self.time, RayAtLeaf { lanes, ray, owner: self.owner, callback: self.callback })
    }
}
