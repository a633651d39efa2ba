//! What the rays of a packet have found, and the callbacks of single lanes.

use crate::hit_callback::{Any, HitCallback, Nearest};
use crate::intersect::packet_ray::PACKET;
use crate::ray::{Hit, NONE};
use fearless_simd::{f32x16, prelude::*};

/// The state of a packet's query: the nearest hits so far. A lane that wants no more has `t` minus infinity.
#[repr(C, align(64))]
pub(crate) struct PacketHits {
    pub(crate) t: [f32; PACKET],
    pub(crate) u: [f32; PACKET],
    pub(crate) v: [f32; PACKET],
    pub(crate) primitive: [u32; PACKET],
    pub(crate) instance: [u32; PACKET],
}

impl PacketHits {
    /// No hits up to `t`.
    #[inline(always)]
    pub(crate) fn misses(t: [f32; PACKET]) -> Self {
        PacketHits { t, u: [0.0; PACKET], v: [0.0; PACKET], primitive: [NONE; PACKET], instance: [NONE; PACKET] }
    }

    /// The lanes among `lanes` that want more.
    #[inline(always)]
    pub(crate) fn live<S: Simd>(&self, simd: S, lanes: u32) -> u32 {
        lanes & f32x16::from_slice(simd, &self.t).simd_ge(0.0).to_bitmask() as u32
    }
}

/// What a packet looks for, as the callback of one lane that is searched for alone.
pub(crate) trait LaneCallback: HitCallback {
    /// With what the lane has found.
    fn of(hits: &PacketHits, lane: usize) -> Self;
    /// Gives the lane what was found since; `ended` when the callback ended the search.
    fn keep(self, hits: &mut PacketHits, lane: usize, ended: bool);
}

/// The nearest hit of every lane.
impl LaneCallback for Nearest {
    #[inline(always)]
    fn of(hits: &PacketHits, lane: usize) -> Self {
        Nearest(Hit { t: hits.t[lane], u: hits.u[lane], v: hits.v[lane], primitive: hits.primitive[lane], instance: hits.instance[lane] })
    }

    #[inline(always)]
    fn keep(self, hits: &mut PacketHits, lane: usize, _ended: bool) {
        let Hit { t, u, v, primitive, instance } = self.0;
        (hits.t[lane], hits.u[lane], hits.v[lane]) = (t, u, v);
        (hits.primitive[lane], hits.instance[lane]) = (primitive, instance);
    }
}

/// Whether a lane hits anything, kept as `t` minus infinity alone.
impl LaneCallback for Any {
    #[inline(always)]
    fn of(hits: &PacketHits, lane: usize) -> Self {
        Any { t_max: hits.t[lane] }
    }

    #[inline(always)]
    fn keep(self, hits: &mut PacketHits, lane: usize, ended: bool) {
        if ended {
            hits.t[lane] = -f32::INFINITY;
        }
    }
}
