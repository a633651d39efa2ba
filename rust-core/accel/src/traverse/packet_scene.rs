//! Traversal of both levels with a packet.

use super::packet::{PacketStack, PacketVisitor, traverse_groups};
use super::packet_mesh::traverse_mesh_packet;
use super::scene_leaf::{Place, SceneRays, visit};
use super::single::Stack;
use super::single_scene::{SceneStacks, traverse_scene_from};
use crate::intersect::leaf::{Leaf, PacketAtLeaf};
use crate::intersect::packet_ray::{Group, PACKET, PacketRays, lane_of};
use crate::intersect::shape::Shape;
use crate::intersect::triangle_block::TriangleBlock;
use crate::intersect::wide::Wide;
use crate::packet_hits::{LaneCallback, PacketHits};
use crate::ray::RayMask;
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, Owner};
use crate::tree::moving::MovingRecord;
use crate::tree::node::ChildRef;
use crate::tree::tlas::Tlas;
use fearless_simd::{f32x16, prelude::*};
use std::marker::PhantomData;

/// The stacks of a packet's traversal.
pub(crate) struct PacketStacks {
    pub(crate) scene: Box<PacketStack>,
    pub(crate) mesh: Box<PacketStack>,
    pub(crate) single_scene: Box<Stack>,
    pub(crate) single_mesh: Box<Stack>,
}

/// Sends a packet through the scene; `C` says what its rays look for.
#[inline(always)]
pub(crate) fn traverse_scene_packet<S: Simd, C: LaneCallback>(
    simd: S,
    scene: &Tlas,
    rays: &PacketRays<S>,
    (masks, times): (&[RayMask; PACKET], &[f32; PACKET]),
    stacks: &mut PacketStacks,
    hits: &mut PacketHits,
) {
    let PacketStacks { scene: stack, mesh, single_scene, single_mesh } = stacks;
    let mut visitor = SceneVisitor::<C> { scene, masks, times, mesh_stack: mesh, single_scene, single_mesh, hits, query: PhantomData };
    traverse_groups(simd, &scene.nodes, rays, stack, &mut visitor);
}

struct SceneVisitor<'a, C: LaneCallback> {
    scene: &'a Tlas,
    masks: &'a [RayMask; PACKET],
    times: &'a [f32; PACKET],
    mesh_stack: &'a mut PacketStack,
    single_scene: &'a mut Stack,
    single_mesh: &'a mut Stack,
    hits: &'a mut PacketHits,
    query: PhantomData<C>,
}

impl<S: Simd, C: LaneCallback> PacketVisitor<S> for SceneVisitor<'_, C> {
    const ORDERED: bool = C::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> &[f32; PACKET] {
        &self.hits.t
    }

    #[inline(always)]
    fn fetch(&self, child: ChildRef) {
        self.scene.fetch(child);
    }

    #[inline(always)]
    fn leaf(&mut self, simd: S, rays: &PacketRays<S>, group: &Group<S>, leaf: ChildRef, lanes: u32) {
        visit(self.scene, leaf, &mut ScenePacket { simd, rays, group, lanes, visitor: self });
    }

    #[inline(always)]
    fn single(&mut self, simd: S, rays: &PacketRays<S>, start: ChildRef, lane: usize) {
        let (ray, at) = (rays.single(lane), (self.masks[lane], self.times[lane]));
        let mut stacks = SceneStacks { stack: self.single_scene, mesh_stack: self.single_mesh };
        let (scene, mut callback) = (self.scene, C::of(self.hits, lane));
        // Outlined: the code of single-ray traversal exists once, however often it is called for.
        let ended = simd.vectorize(
            #[inline(always)]
            || traverse_scene_from(Wide(simd), scene, &mut stacks, start, &ray, at, &mut callback),
        );
        callback.keep(self.hits, lane, ended);
    }
}

/// Rays of a packet at a leaf of the scene's tree.
struct ScenePacket<'r, 'a, S: Simd, C: LaneCallback> {
    simd: S,
    rays: &'r PacketRays<S>,
    group: &'r Group<S>,
    lanes: u32,
    visitor: &'r mut SceneVisitor<'a, C>,
}

impl<'r, S: Simd, C: LaneCallback> SceneRays<'r> for ScenePacket<'r, '_, S, C> {
    type Next = ();
    const PAST: () = ();

    #[inline(always)]
    fn see(&mut self, owner: Owner) -> bool {
        let mut seeing = 0;
        for (lane, own) in self.visitor.masks.iter().enumerate() {
            seeing |= u32::from(own & owner.mask != 0) << lane;
        }
        self.lanes &= seeing;
        self.lanes != 0
    }

    #[inline(always)]
    fn triangles(&mut self, block: &TriangleBlock, owner: Owner) {
        let packet = PacketAtLeaf { rays: self.rays, group: self.group, lanes: self.lanes, owner };
        block.intersect_packet::<S, C>(self.simd, &packet, self.visitor.hits);
    }

    #[inline(always)]
    fn shape(&mut self, shape: Shape, record: &InstanceRecord) {
        let (rays, mut left) = (self.rays, self.lanes);
        while left != 0 {
            let lane = left.trailing_zeros() as usize % PACKET;
            left &= left - 1;
            let (origin, direction, t_min) = (lane_of(&rays.origin, lane), lane_of(&rays.direction, lane), rays.t_min.as_slice()[lane]);
            let mut callback = C::of(self.visitor.hits, lane);
            let ended = record.intersect_shape(shape, origin, direction, t_min, &mut callback);
            callback.keep(self.visitor.hits, lane, ended);
        }
    }

    #[inline(always)]
    fn walk(&mut self, mesh: &Blas, place: Place<'_>, owner: Owner) {
        let SceneVisitor { times, mesh_stack, single_mesh, hits, .. } = &mut *self.visitor;
        let (simd, rays) = (self.simd, self.rays);
        let image = match place {
            Place::AtRest(_, map) => rays.transformed(simd, map, f32x16::from_slice(simd, &hits.t), self.lanes),
            Place::InMotion(moving) => in_motion(simd, moving, rays, times, &hits.t, self.lanes),
        };
        traverse_mesh_packet::<S, C>(simd, mesh, &image, (owner, times), (mesh_stack, single_mesh), hits);
    }
}

/// The packet in the space of an instance that moves, each ray at its own time.
#[inline(always)]
fn in_motion<S: Simd>(
    simd: S,
    moving: &MovingRecord,
    rays: &PacketRays<S>,
    times: &[f32; PACKET],
    t_max: &[f32; PACKET],
    lanes: u32,
) -> PacketRays<S> {
    let (mut origin, mut direction, mut meeting, mut left) = ([[0.0; PACKET]; 3], [[0.0; PACKET]; 3], 0, lanes);
    while left != 0 {
        let lane = left.trailing_zeros() as usize % PACKET;
        left &= left - 1;
        let ray = rays.single(lane);
        let Some(map) = moving.enter(times[lane], &ray, t_max[lane]) else { continue };
        let (point, way) = (map.point(ray.origin), map.direction(ray.direction));
        for axis in 0..3 {
            (origin[axis][lane], direction[axis][lane]) = (point[axis], way[axis]);
        }
        meeting |= 1 << lane;
    }
    let [x, y, z] = &origin;
    let origin = [f32x16::from_slice(simd, x), f32x16::from_slice(simd, y), f32x16::from_slice(simd, z)];
    let [x, y, z] = &direction;
    let direction = [f32x16::from_slice(simd, x), f32x16::from_slice(simd, y), f32x16::from_slice(simd, z)];
    PacketRays::new(simd, origin, direction, rays.t_min, f32x16::from_slice(simd, t_max), meeting)
}
