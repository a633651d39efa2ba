//! Traversal of one tree with sixteen coherent rays.

use crate::intersect::packet_ray::{Group, PACKET, PacketRays};
use crate::tree::node::{ChildRef, Node, STACK, WIDTH};
use fearless_simd::{f32x8, f32x16, prelude::*, u32x8};
use gonio_simd::Sort8;

/// Below this many live lanes the rays go on one by one.
pub(crate) const FEWEST_LANES: u32 = 3;

/// A pending child with the lanes that meet it and their distances.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct PacketEntry {
    near: [f32; PACKET],
    child: ChildRef,
    lanes: u32,
}

/// Pending children of a packet.
pub(crate) type PacketStack = [PacketEntry; STACK];

/// An empty stack.
pub(crate) static EMPTY_PACKET_STACK: PacketStack = [PacketEntry { near: [0.0; PACKET], child: ChildRef::ROOT, lanes: 0 }; STACK];

/// The numbers of a node's slots.
const SLOTS: [u32; WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7];

/// What happens at the leaves of a packet's traversal.
pub(crate) trait PacketVisitor<S: Simd> {
    /// True when nearer children are to be visited first.
    const ORDERED: bool;
    /// Nothing beyond these distances is of interest; minus infinity for lanes that are done.
    fn t_max(&self) -> &[f32; PACKET];
    /// Has memory fetch a child that is pushed.
    fn fetch(&self, child: ChildRef);
    /// Visits a leaf with the lanes of a mask.
    fn leaf(&mut self, simd: S, rays: &PacketRays<S>, group: &Group<S>, leaf: ChildRef, lanes: u32);
    /// Goes on from `start` with one lane alone.
    fn single(&mut self, simd: S, rays: &PacketRays<S>, start: ChildRef, lane: usize);
}

/// Sends all live lanes through a tree, in groups of equal signs and major axis.
#[inline(always)]
pub(crate) fn traverse_groups<S: Simd, V: PacketVisitor<S>>(
    simd: S,
    nodes: &[Node],
    rays: &PacketRays<S>,
    stack: &mut PacketStack,
    visitor: &mut V,
) {
    let mut waiting = rays.lanes;
    while waiting != 0 {
        let lanes = rays.like_first(waiting);
        waiting &= !lanes;
        if lanes.count_ones() < FEWEST_LANES {
            singles(simd, rays, ChildRef::ROOT, lanes, visitor);
        } else {
            let group = Group::new(simd, rays, lanes);
            traverse_packet(simd, nodes, rays, &group, lanes, stack, visitor);
        }
    }
}

#[inline(always)]
fn singles<S: Simd, V: PacketVisitor<S>>(simd: S, rays: &PacketRays<S>, start: ChildRef, mut lanes: u32, visitor: &mut V) {
    while lanes != 0 {
        visitor.single(simd, rays, start, lanes.trailing_zeros() as usize % PACKET);
        lanes &= lanes - 1;
    }
}

#[inline(always)]
fn traverse_packet<S: Simd, V: PacketVisitor<S>>(
    simd: S,
    nodes: &[Node],
    rays: &PacketRays<S>,
    group: &Group<S>,
    lanes: u32,
    stack: &mut PacketStack,
    visitor: &mut V,
) {
    stack[0] = PacketEntry { near: [0.0; PACKET], child: ChildRef::ROOT, lanes };
    let mut top = 1;
    while top > 0 {
        top -= 1;
        let popped = &stack[top % STACK];
        let child = popped.child;
        let t_max = f32x16::from_slice(simd, visitor.t_max());
        let lanes = popped.lanes & f32x16::from_slice(simd, &popped.near).simd_le(t_max).to_bitmask() as u32;
        if lanes.count_ones() < FEWEST_LANES {
            singles(simd, rays, child, lanes, visitor);
        } else if child.is_inner() {
            push_children(simd, &nodes[child.index()], rays, group, lanes, t_max, stack, &mut top, visitor);
        } else {
            visitor.leaf(simd, rays, group, child, lanes);
        }
    }
}

/// Tests all boxes against the group's intervals, those that pass against its rays, and leaves the children on the stack, nearest on top.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "one step of the traversal, inlined into it")]
fn push_children<S: Simd, V: PacketVisitor<S>>(
    simd: S,
    node: &Node,
    rays: &PacketRays<S>,
    group: &Group<S>,
    lanes: u32,
    t_max: f32x16<S>,
    stack: &mut PacketStack,
    top: &mut usize,
    visitor: &V,
) {
    let (mut distances, mut slots) = ([0; WIDTH], [0; WIDTH]);
    let n = interval_test::<S, V>(simd, node, group, t_max.reduce_max(), &mut distances, &mut slots);
    for &slot in &slots[..n] {
        let slot = slot as usize % WIDTH;
        let mut enter = rays.t_min;
        let mut leave = t_max;
        for axis in 0..3 {
            let row = group.near_rows[axis];
            let near_plane = f32x16::splat(simd, node.bounds[row][slot]);
            let far_plane = f32x16::splat(simd, node.bounds[opposite(row)][slot]);
            enter = near_plane.mul_add(rays.reciprocal[axis], rays.near_offset[axis]).max(enter);
            leave = far_plane.mul_add(rays.reciprocal[axis], rays.far_offset[axis]).min(leave);
        }
        let lanes = lanes & enter.simd_le(leave).to_bitmask() as u32;
        if lanes != 0 {
            let entry = &mut stack[*top % STACK];
            enter.store_slice(&mut entry.near);
            entry.child = node.children[slot];
            entry.lanes = lanes;
            *top += 1;
            visitor.fetch(node.children[slot]);
        }
    }
}

/// The row of the planes on the other side.
#[inline(always)]
fn opposite(row: usize) -> usize {
    if row < 3 { row + 3 } else { row - 3 }
}

/// The slots some ray of the group may meet, farthest (or largest) first; returns their number.
#[inline(always)]
fn interval_test<S: Simd, V: PacketVisitor<S>>(
    simd: S,
    node: &Node,
    group: &Group<S>,
    t_max: f32,
    distances: &mut [u32; WIDTH],
    slots: &mut [u32; WIDTH],
) -> usize {
    let mut enter = f32x8::splat(simd, 0.0);
    let mut leave = f32x8::splat(simd, t_max);
    for axis in 0..3 {
        let row = group.near_rows[axis];
        let (low, high) = (f32x8::splat(simd, group.reciprocal[axis][0]), f32x8::splat(simd, group.reciprocal[axis][1]));
        let near_plane = f32x8::from_slice(simd, &node.bounds[row]) - f32x8::splat(simd, group.start[axis][0]);
        let far_plane = f32x8::from_slice(simd, &node.bounds[opposite(row)]) - f32x8::splat(simd, group.start[axis][1]);
        enter = (near_plane * low).min(near_plane * high).max(enter);
        leave = (far_plane * low).max(far_plane * high).min(leave);
    }
    let met = enter.simd_le(leave);
    let mask = met.to_bitmask() as u32;
    let all = u32x8::from_slice(simd, &SLOTS);
    if V::ORDERED {
        simd.sort8(enter, mask, all, distances, slots);
    } else {
        all.compress(met).store_slice(slots);
    }
    mask.count_ones() as usize
}
