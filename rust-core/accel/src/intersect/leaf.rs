//! What all kinds of leaves have in common: up to eight primitives, which a ray or a packet is tested against together.

use super::lanes8::Lanes8;
use super::packet_ray::{Group, PACKET, PacketRays};
use super::prepared::PreparedRay;
use super::wide::Wide;
use crate::hit_callback::HitCallback;
use crate::packet_hits::{LaneCallback, PacketHits};
use crate::tree::instance::Owner;
use crate::tree::node::WIDTH;
use fearless_simd::Simd;

/// A kind of leaf.
pub(crate) trait Leaf: Copy {
    /// What a test finds of each primitive, valid in the lanes of a mask.
    type Found: Default;

    /// The primitives hit with `ray.t_min < t <= t_max`, as a mask, in plain Rust.
    fn intersect_scalar(self, ray: &PreparedRay, t_max: f32, found: &mut Self::Found) -> u32;

    /// The same in registers.
    fn intersect<S: Simd>(self, simd: S, ray: &PreparedRay, t_max: f32, found: &mut Self::Found) -> u32;

    /// Hands the hit of a lane of the mask to a callback; true when that ended the search.
    fn report<C: HitCallback>(self, lane: usize, ray: &PreparedRay, found: &Self::Found, owner: Owner, callback: &mut C) -> bool;

    /// Tests a packet: one ray after the other, as its primitives are as many as a register holds.
    #[inline(always)]
    fn intersect_packet<S: Simd, C: LaneCallback>(self, simd: S, packet: &PacketAtLeaf<'_, S>, hits: &mut PacketHits) {
        let mut left = packet.lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % PACKET;
            left &= left - 1;
            let ray = packet.rays.single(lane);
            let mut callback = C::of(hits, lane);
            let ended = RayAtLeaf { lanes: Wide(simd), ray: &ray, owner: packet.owner, callback: &mut callback }.visit(self);
            callback.keep(hits, lane, ended);
        }
    }
}

/// Does the same at leaves of every kind.
pub(crate) trait LeafVisitor {
    /// What comes of it.
    type Outcome;
    fn visit<L: Leaf>(self, leaf: L) -> Self::Outcome;
}

/// Hands the primitives of a leaf that a ray meets to a callback; true when it ended the search.
pub(crate) struct RayAtLeaf<'r, K: Lanes8, C: HitCallback> {
    pub(crate) lanes: K,
    pub(crate) ray: &'r PreparedRay,
    /// Whose the leaf is.
    pub(crate) owner: Owner,
    pub(crate) callback: &'r mut C,
}

impl<K: Lanes8, C: HitCallback> LeafVisitor for RayAtLeaf<'_, K, C> {
    type Outcome = bool;

    #[inline(always)]
    fn visit<L: Leaf>(self, leaf: L) -> bool {
        let mut found = L::Found::default();
        let mut mask = self.lanes.leaf(leaf, self.ray, self.callback.t_max(), &mut found);
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize % WIDTH;
            mask &= mask - 1;
            if leaf.report(lane, self.ray, &found, self.owner, self.callback) {
                return true;
            }
        }
        false
    }
}

/// The rays of a packet that meet the box of a leaf.
pub(crate) struct PacketAtLeaf<'r, S: Simd> {
    pub(crate) rays: &'r PacketRays<S>,
    pub(crate) group: &'r Group<S>,
    pub(crate) lanes: u32,
    /// Whose the leaf is.
    pub(crate) owner: Owner,
}
