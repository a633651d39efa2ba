//! The queries over a batch whose consecutive groups of sixteen rays are coherent.

use super::packet::EMPTY_PACKET_STACK;
use super::packet_scene::{PacketStacks, traverse_scene_packet};
use crate::hit_callback::{Any, Nearest};
use crate::intersect::packet_ray::{PACKET, PacketRays};
use crate::packet_hits::PacketHits;
use crate::ray::{Hits, RayBatch, RayMask};
use crate::tree::node::STACK;
use crate::tree::tlas::Tlas;
use fearless_simd::{Level, f32x16, prelude::*};
use gonio_simd::dispatch_level;
use std::cell::RefCell;

impl Tlas {
    /// The nearest hit of every ray in the tree, consecutive groups of sixteen together.
    pub(crate) fn first_hit_packets(&self, level: Level, rays: &RayBatch, hits: &mut Hits) {
        STACKS.with_borrow_mut(|stacks| dispatch_level!(level, simd => first_hit_packets(simd, self, rays, stacks, hits)));
    }

    /// [`Tlas::occluded`], consecutive groups of sixteen rays together.
    pub(crate) fn occluded_packets(&self, level: Level, rays: &RayBatch, out: &mut [u8]) {
        STACKS.with_borrow_mut(|stacks| dispatch_level!(level, simd => occluded_packets(simd, self, rays, stacks, out)));
    }
}

thread_local! {
    /// Kept, as clearing them takes as long as some hundred rays.
    static STACKS: RefCell<PacketStacks> = RefCell::new(PacketStacks::new());
}

impl PacketStacks {
    fn new() -> Self {
        PacketStacks {
            scene: Box::new(EMPTY_PACKET_STACK),
            mesh: Box::new(EMPTY_PACKET_STACK),
            single_scene: Box::new([0; STACK]),
            single_mesh: Box::new([0; STACK]),
        }
    }
}

/// Sixteen rays copied out of a batch; those beyond its end can hit nothing.
struct Loaded<S: Simd> {
    rays: PacketRays<S>,
    masks: [RayMask; PACKET],
    times: [f32; PACKET],
    t_max: [f32; PACKET],
    n: usize,
}

/// Entries of a column, and `beyond` behind them.
#[inline(always)]
fn column(values: &[f32], first: usize, n: usize, beyond: f32) -> [f32; PACKET] {
    let mut lanes = [beyond; PACKET];
    lanes[..n].copy_from_slice(&values[first..first + n]);
    lanes
}

#[inline(always)]
fn load<S: Simd>(simd: S, rays: &RayBatch, first: usize) -> Loaded<S> {
    let n = PACKET.min(rays.len() - first);
    let [x, y, z] = rays.origin;
    let [dx, dy, dz] = rays.direction;
    let origin = [
        f32x16::from_slice(simd, &column(x, first, n, 0.0)),
        f32x16::from_slice(simd, &column(y, first, n, 0.0)),
        f32x16::from_slice(simd, &column(z, first, n, 0.0)),
    ];
    let direction = [
        f32x16::from_slice(simd, &column(dx, first, n, 0.0)),
        f32x16::from_slice(simd, &column(dy, first, n, 0.0)),
        f32x16::from_slice(simd, &column(dz, first, n, 0.0)),
    ];
    let mut masks = [0; PACKET];
    masks[..n].copy_from_slice(&rays.mask[first..first + n]);
    let times = if rays.time.is_empty() { [0.5; PACKET] } else { column(rays.time, first, n, 0.5) };
    let t_max = column(rays.t_max, first, n, -f32::INFINITY);
    let t_min: f32x16<S> = f32x16::from_slice(simd, &column(rays.t_min, first, n, 0.0));
    let t_min = t_min.simd_gt(0.0).select(t_min, f32x16::splat(simd, 0.0));
    let lanes = ((1u64 << n) - 1) as u32;
    Loaded { rays: PacketRays::new(simd, origin, direction, t_min, f32x16::from_slice(simd, &t_max), lanes), masks, times, t_max, n }
}

#[inline(always)]
fn first_hit_packets<S: Simd>(simd: S, scene: &Tlas, rays: &RayBatch, stacks: &mut PacketStacks, hits: &mut Hits) {
    let rays = rays.same_length();
    hits.resize(rays.len());
    for first in (0..rays.len()).step_by(PACKET) {
        let packet = load(simd, &rays, first);
        let mut found = PacketHits::misses(packet.t_max);
        traverse_scene_packet::<S, Nearest>(simd, scene, &packet.rays, (&packet.masks, &packet.times), stacks, &mut found);
        let range = first..first + packet.n;
        hits.t[range.clone()].copy_from_slice(&found.t[..packet.n]);
        hits.u[range.clone()].copy_from_slice(&found.u[..packet.n]);
        hits.v[range.clone()].copy_from_slice(&found.v[..packet.n]);
        hits.primitive[range.clone()].copy_from_slice(&found.primitive[..packet.n]);
        hits.instance[range].copy_from_slice(&found.instance[..packet.n]);
    }
}

#[inline(always)]
fn occluded_packets<S: Simd>(simd: S, scene: &Tlas, rays: &RayBatch, stacks: &mut PacketStacks, out: &mut [u8]) {
    let rays = rays.same_length();
    for first in (0..rays.len()).step_by(PACKET) {
        let packet = load(simd, &rays, first);
        let mut found = PacketHits::misses(packet.t_max);
        traverse_scene_packet::<S, Any>(simd, scene, &packet.rays, (&packet.masks, &packet.times), stacks, &mut found);
        for (lane, out) in out[first..first + packet.n].iter_mut().enumerate() {
            // Lanes that were of no use from the start have not been hit either.
            *out = u8::from(packet.rays.lanes & (1 << lane) != 0 && found.t[lane] == -f32::INFINITY);
        }
    }
}
