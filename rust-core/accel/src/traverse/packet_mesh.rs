//! Traversal of the tree of a mesh, or of curves or points, with a packet.

use super::packet::{PacketStack, PacketVisitor, traverse_groups};
use super::single::Stack;
use super::single_mesh::traverse_mesh;
use crate::intersect::leaf::{Leaf, LeafVisitor, PacketAtLeaf};
use crate::intersect::packet_ray::{Group, PACKET, PacketRays};
use crate::intersect::wide::Wide;
use crate::packet_hits::{LaneCallback, PacketHits};
use crate::tree::blas::Blas;
use crate::tree::instance::Owner;
use crate::tree::node::ChildRef;
use fearless_simd::prelude::*;
use std::marker::PhantomData;

/// Sends a packet in object space through a mesh; `C` says what its rays look for.
#[inline(always)]
pub(crate) fn traverse_mesh_packet<S: Simd, C: LaneCallback>(
    simd: S,
    mesh: &Blas,
    rays: &PacketRays<S>,
    (owner, times): (Owner, &[f32; PACKET]),
    (stack, single): (&mut PacketStack, &mut Stack),
    hits: &mut PacketHits,
) {
    let mut visitor = MeshVisitor::<C> { mesh, owner, times, stack: single, hits, query: PhantomData };
    if mesh.is_still() {
        return traverse_groups(simd, &mesh.nodes, rays, stack, &mut visitor);
    }
    // Of a mesh that deforms no two rays see the same triangles.
    let mut left = rays.lanes;
    while left != 0 {
        visitor.single(simd, rays, ChildRef::ROOT, left.trailing_zeros() as usize % PACKET);
        left &= left - 1;
    }
}

struct MeshVisitor<'a, C: LaneCallback> {
    mesh: &'a Blas,
    owner: Owner,
    times: &'a [f32; PACKET],
    stack: &'a mut Stack,
    hits: &'a mut PacketHits,
    query: PhantomData<C>,
}

impl<S: Simd, C: LaneCallback> PacketVisitor<S> for MeshVisitor<'_, C> {
    const ORDERED: bool = C::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> &[f32; PACKET] {
        &self.hits.t
    }

    #[inline(always)]
    fn fetch(&self, child: ChildRef) {
        self.mesh.fetch(child);
    }

    #[inline(always)]
    fn leaf(&mut self, simd: S, rays: &PacketRays<S>, group: &Group<S>, leaf: ChildRef, lanes: u32) {
        let packet = PacketAtLeaf { rays, group, lanes, owner: self.owner };
        self.mesh.leaf(leaf, Tested::<S, C> { simd, packet, hits: self.hits, query: PhantomData });
    }

    #[inline(always)]
    fn single(&mut self, simd: S, rays: &PacketRays<S>, start: ChildRef, lane: usize) {
        let (ray, at) = (rays.single(lane), (self.owner, self.times[lane]));
        let (mesh, mut callback) = (self.mesh, C::of(self.hits, lane));
        let ended = simd.vectorize(
            #[inline(always)]
            || traverse_mesh(Wide(simd), mesh, start, &ray, at, self.stack, &mut callback),
        );
        callback.keep(self.hits, lane, ended);
    }
}

/// Has a packet tested at a leaf of any kind.
struct Tested<'r, S: Simd, C: LaneCallback> {
    simd: S,
    packet: PacketAtLeaf<'r, S>,
    hits: &'r mut PacketHits,
    query: PhantomData<C>,
}

impl<S: Simd, C: LaneCallback> LeafVisitor for Tested<'_, S, C> {
    type Outcome = ();

    #[inline(always)]
    fn visit<L: Leaf>(self, leaf: L) {
        leaf.intersect_packet::<S, C>(self.simd, &self.packet, self.hits);
    }
}
