//! Traversal of both levels with a packet, and its tests at the leaves.

use super::packet::{PacketStack, PacketVisitor, traverse_groups};
use super::packet_ray::{Group, PACKET, PacketRays, lane_of};
use super::single::Stack;
use super::single_scene::{SceneStacks, traverse_mesh, traverse_scene_from};
use crate::hit_callback::{Any, HitCallback, Nearest};
use crate::intersect::line_ray::SmoothHits;
use crate::intersect::triangle_block::TriangleBlock;
use crate::intersect::wide::Wide;
use crate::ray::{Hit, NONE, RayMask};
use crate::tree::blas::Blas;
use crate::tree::instance::{Geometry, InstanceRecord, MapKind};
use crate::tree::moving::MovingRecord;
use crate::tree::node::{ChildRef, Kind, WIDTH};
use crate::tree::tlas::Tlas;
use fearless_simd::{f32x16, mask32x16, prelude::*, u32x16};

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

    #[inline(always)]
    fn get(&self, lane: usize) -> Hit {
        Hit { t: self.t[lane], u: self.u[lane], v: self.v[lane], primitive: self.primitive[lane], instance: self.instance[lane] }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, hit: Hit) {
        (self.t[lane], self.u[lane], self.v[lane]) = (hit.t, hit.u, hit.v);
        (self.primitive[lane], self.instance[lane]) = (hit.primitive, hit.instance);
    }

    #[inline(always)]
    fn set_blocked(&mut self, lane: usize) {
        self.t[lane] = -f32::INFINITY;
    }

    /// The lanes among `lanes` that want more.
    #[inline(always)]
    fn live<S: Simd>(&self, simd: S, lanes: u32) -> u32 {
        lanes & f32x16::from_slice(simd, &self.t).simd_ge(0.0).to_bitmask() as u32
    }
}

/// The stacks of a packet's traversal.
pub(crate) struct PacketStacks {
    pub(crate) scene: Box<PacketStack>,
    pub(crate) mesh: Box<PacketStack>,
    pub(crate) single_scene: Box<Stack>,
    pub(crate) single_mesh: Box<Stack>,
}

/// Sends a packet through the scene; with `ANY`, hits end a lane's search and are kept as `t` minus infinity alone.
#[inline(always)]
pub(crate) fn traverse_scene_packet<S: Simd, const ANY: bool>(
    simd: S,
    scene: &Tlas,
    rays: &PacketRays<S>,
    (masks, times): (&[RayMask; PACKET], &[f32; PACKET]),
    stacks: &mut PacketStacks,
    hits: &mut PacketHits,
) {
    let PacketStacks { scene: stack, mesh, single_scene, single_mesh } = stacks;
    let mut visitor = SceneVisitor::<ANY> { scene, masks, times, mesh_stack: mesh, single_scene, single_mesh, hits };
    traverse_groups(simd, &scene.nodes, rays, stack, &mut visitor);
}

struct SceneVisitor<'a, const ANY: bool> {
    scene: &'a Tlas,
    masks: &'a [RayMask; PACKET],
    times: &'a [f32; PACKET],
    mesh_stack: &'a mut PacketStack,
    single_scene: &'a mut Stack,
    single_mesh: &'a mut Stack,
    hits: &'a mut PacketHits,
}

impl<const ANY: bool> SceneVisitor<'_, ANY> {
    /// The lanes whose rays see what has this mask.
    #[inline(always)]
    fn seeing(&self, mask: RayMask) -> u32 {
        let mut seeing = 0;
        for (lane, own) in self.masks.iter().enumerate() {
            seeing |= u32::from(own & mask != 0) << lane;
        }
        seeing
    }
}

impl<S: Simd, const ANY: bool> PacketVisitor<S> for SceneVisitor<'_, ANY> {
    const ORDERED: bool = !ANY;

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
        if leaf.is(Kind::WorldTriangles) {
            let owner = self.scene.owners[leaf.index()];
            let (block, lanes) = (&self.scene.blocks[leaf.index()], lanes & self.seeing(owner.mask));
            return intersect_leaf::<S, ANY>(simd, block, rays, group, lanes, owner.id, self.hits);
        }
        let record = &self.scene.records[leaf.index()];
        let lanes = lanes & self.seeing(record.mask);
        if lanes == 0 {
            return;
        }
        let t_max = f32x16::from_slice(simd, &self.hits.t);
        let rays = if record.map == MapKind::Moving {
            let moved = moved(simd, self.scene.moving(record.id), rays, self.times, &self.hits.t, lanes);
            if moved.lanes == 0 {
                return;
            }
            moved
        } else {
            rays.transformed(simd, &record.world_to_object, t_max, lanes)
        };
        match record.geometry.get() {
            Geometry::Mesh(index) => {
                let mesh = &*self.scene.meshes[index as usize];
                if !mesh.is_still() {
                    return one_by_one::<S, ANY>(simd, (mesh, record), &rays, self.times, self.single_mesh, self.hits);
                }
                let mut visitor = MeshVisitor::<ANY> { mesh, record, stack: self.single_mesh, hits: self.hits };
                traverse_groups(simd, &mesh.nodes, &rays, self.mesh_stack, &mut visitor);
            }
            Geometry::Shape(shape) => {
                let mut left = lanes;
                while left != 0 {
                    let lane = left.trailing_zeros() as usize % PACKET;
                    left &= left - 1;
                    let crossings = shape.crossings(
                        lane_of(&rays.origin, lane),
                        lane_of(&rays.direction, lane),
                        rays.t_min.as_slice()[lane],
                        self.hits.t[lane],
                    );
                    let Some(hit) = crossings[0] else { continue };
                    if ANY {
                        self.hits.set_blocked(lane);
                    } else {
                        let mut nearest = Nearest(self.hits.get(lane));
                        let hit = Hit { t: hit.t, u: hit.u, v: hit.v, primitive: 0, instance: record.id };
                        nearest.add(hit, false);
                        self.hits.set(lane, nearest.0);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn single(&mut self, simd: S, rays: &PacketRays<S>, start: ChildRef, lane: usize) {
        let ray = rays.single(lane);
        let mut stacks = SceneStacks { stack: self.single_scene, mesh_stack: self.single_mesh };
        let (scene, mask) = (self.scene, (self.masks[lane], self.times[lane]));
        // Outlined: the code of single-ray traversal exists once, however often it is called for.
        if ANY {
            let mut any = Any { t_max: self.hits.t[lane] };
            let blocked = simd.vectorize(
                #[inline(always)]
                || traverse_scene_from(Wide(simd), scene, &mut stacks, start, &ray, mask, &mut any),
            );
            if blocked {
                self.hits.set_blocked(lane);
            }
        } else {
            let mut nearest = Nearest(self.hits.get(lane));
            simd.vectorize(
                #[inline(always)]
                || traverse_scene_from(Wide(simd), scene, &mut stacks, start, &ray, mask, &mut nearest),
            );
            self.hits.set(lane, nearest.0);
        }
    }
}

/// The packet in the space of an instance that moves, each ray at its own time.
#[inline(always)]
fn moved<S: Simd>(
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

/// Sends the rays of a packet through a mesh that deforms, each alone: no two see the same triangles.
#[inline(always)]
fn one_by_one<S: Simd, const ANY: bool>(
    simd: S,
    (mesh, record): (&Blas, &InstanceRecord),
    rays: &PacketRays<S>,
    times: &[f32; PACKET],
    stack: &mut Stack,
    hits: &mut PacketHits,
) {
    let mut left = rays.lanes;
    while left != 0 {
        let lane = left.trailing_zeros() as usize % PACKET;
        left &= left - 1;
        let (ray, at) = (rays.single(lane), (record, times[lane]));
        if ANY {
            let mut any = Any { t_max: hits.t[lane] };
            let blocked = simd.vectorize(
                #[inline(always)]
                || traverse_mesh(Wide(simd), mesh, ChildRef::ROOT, &ray, at, stack, &mut any),
            );
            if blocked {
                hits.set_blocked(lane);
            }
        } else {
            let mut nearest = Nearest(hits.get(lane));
            simd.vectorize(
                #[inline(always)]
                || traverse_mesh(Wide(simd), mesh, ChildRef::ROOT, &ray, at, stack, &mut nearest),
            );
            hits.set(lane, nearest.0);
        }
    }
}

struct MeshVisitor<'a, const ANY: bool> {
    mesh: &'a Blas,
    record: &'a InstanceRecord,
    stack: &'a mut Stack,
    hits: &'a mut PacketHits,
}

impl<const ANY: bool> MeshVisitor<'_, ANY> {
    /// A leaf of curves or points with one lane.
    #[inline(always)]
    fn smooth<S: Simd>(&mut self, simd: S, rays: &PacketRays<S>, leaf: usize, lane: usize) {
        let ray = rays.single(lane);
        let mut found = SmoothHits::default();
        let leaf = self.mesh.smooth.leaf(leaf);
        let mut mask = leaf.intersect(simd, &ray, self.hits.t[lane], &mut found);
        if ANY {
            if mask != 0 {
                self.hits.set_blocked(lane);
            }
            return;
        }
        while mask != 0 {
            let slot = mask.trailing_zeros() as usize % WIDTH;
            mask &= mask - 1;
            let (primitive, u, v) = leaf.describe(slot, &ray, &found);
            let mut nearest = Nearest(self.hits.get(lane));
            nearest.add(Hit { t: found.t[slot], u, v, primitive, instance: self.record.id }, false);
            self.hits.set(lane, nearest.0);
        }
    }
}

impl<S: Simd, const ANY: bool> PacketVisitor<S> for MeshVisitor<'_, ANY> {
    const ORDERED: bool = !ANY;

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
        if leaf.is(Kind::Triangles) {
            return intersect_leaf::<S, ANY>(simd, &self.mesh.blocks[leaf.index()], rays, group, lanes, self.record.id, self.hits);
        }
        // Eight pieces of curves are as many as a register holds: one ray after the other.
        let mut left = lanes;
        while left != 0 {
            self.smooth(simd, rays, leaf.index(), left.trailing_zeros() as usize % PACKET);
            left &= left - 1;
        }
    }

    #[inline(always)]
    fn single(&mut self, simd: S, rays: &PacketRays<S>, start: ChildRef, lane: usize) {
        let ray = rays.single(lane);
        let (mesh, record) = (self.mesh, self.record);
        if ANY {
            let mut any = Any { t_max: self.hits.t[lane] };
            let blocked = simd.vectorize(
                #[inline(always)]
                || traverse_mesh(Wide(simd), mesh, start, &ray, (record, 0.5), self.stack, &mut any),
            );
            if blocked {
                self.hits.set_blocked(lane);
            }
        } else {
            let mut nearest = Nearest(self.hits.get(lane));
            simd.vectorize(
                #[inline(always)]
                || traverse_mesh(Wide(simd), mesh, start, &ray, (record, 0.5), self.stack, &mut nearest),
            );
            self.hits.set(lane, nearest.0);
        }
    }
}

/// The triangles of a block against sixteen rays.
#[inline(always)]
fn intersect_leaf<S: Simd, const ANY: bool>(
    simd: S,
    block: &TriangleBlock,
    rays: &PacketRays<S>,
    group: &Group<S>,
    lanes: u32,
    instance: u32,
    hits: &mut PacketHits,
) {
    for triangle in 0..block.len() {
        let lanes = if ANY { hits.live(simd, lanes) } else { lanes };
        intersect_triangle::<S, ANY>(simd, block, triangle, rays, group, lanes, instance, hits);
    }
}

/// One triangle against sixteen rays: lane for lane the arithmetic of `Wide::triangles`.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "one step of the traversal, inlined into it")]
fn intersect_triangle<S: Simd, const ANY: bool>(
    simd: S,
    block: &TriangleBlock,
    triangle: usize,
    rays: &PacketRays<S>,
    group: &Group<S>,
    lanes: u32,
    instance: u32,
    hits: &mut PacketHits,
) {
    let a = corner(simd, &block.vertices[0], triangle, rays, group);
    let b = corner(simd, &block.vertices[1], triangle, rays, group);
    let c = corner(simd, &block.vertices[2], triangle, rays, group);
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    let inside = u.min(v).min(w).simd_ge(0.0) | u.max(v).max(w).simd_le(0.0);
    if inside.to_bitmask() as u32 & lanes == 0 {
        return;
    }
    let inverse = f32x16::splat(simd, 1.0) / (u + v + w);
    let t = u.mul_add(a[2], v.mul_add(b[2], w * c[2])) * inverse * group.shear[2];
    let t_max: f32x16<S> = f32x16::from_slice(simd, &hits.t);
    let hit = inside & t.simd_gt(rays.t_min) & t.simd_le(t_max) & mask32x16::from_bitmask(simd, u64::from(lanes));
    if ANY {
        hit.select(f32x16::splat(simd, -f32::INFINITY), t_max).store_slice(&mut hits.t);
        return;
    }
    let (old_primitive, old_instance) = (u32x16::from_slice(simd, &hits.primitive), u32x16::from_slice(simd, &hits.instance));
    let primitive = u32x16::splat(simd, block.primitives[triangle]);
    let instance = u32x16::splat(simd, instance);
    // Equal distances go to the lower instance and its higher primitive, as in `Nearest`.
    let preferred = instance.simd_lt(old_instance) | (instance.simd_eq(old_instance) & primitive.simd_gt(old_primitive));
    let hit = hit & (t.simd_lt(t_max) | preferred);
    hit.select(t, t_max).store_slice(&mut hits.t);
    hit.select(v * inverse, f32x16::from_slice(simd, &hits.u)).store_slice(&mut hits.u);
    hit.select(w * inverse, f32x16::from_slice(simd, &hits.v)).store_slice(&mut hits.v);
    hit.select(primitive, old_primitive).store_slice(&mut hits.primitive);
    hit.select(instance, old_instance).store_slice(&mut hits.instance);
}

/// One corner of a triangle in the space of sixteen rays.
#[inline(always)]
fn corner<S: Simd>(simd: S, rows: &[[f32; WIDTH]; 3], triangle: usize, rays: &PacketRays<S>, group: &Group<S>) -> [f32x16<S>; 3] {
    let [x, y, z] = group.axes;
    let z = f32x16::splat(simd, rows[z][triangle]) - rays.origin[z];
    let x = f32x16::splat(simd, rows[x][triangle]) - rays.origin[x];
    let y = f32x16::splat(simd, rows[y][triangle]) - rays.origin[y];
    [group.shear[0].mul_add(z, x), group.shear[1].mul_add(z, y), z]
}
