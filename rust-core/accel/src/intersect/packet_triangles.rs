//! The triangles of a block against sixteen rays.

use super::leaf::PacketAtLeaf;
use super::packet_ray::{Group, PacketRays};
use super::triangle_block::TriangleBlock;
use crate::packet_hits::{LaneCallback, PacketHits};
use crate::tree::node::WIDTH;
use fearless_simd::{f32x16, mask32x16, prelude::*, u32x16};

/// Tests one triangle after the other.
#[inline(always)]
pub(super) fn intersect_block<S: Simd, C: LaneCallback>(
    simd: S,
    block: &TriangleBlock,
    packet: &PacketAtLeaf<'_, S>,
    hits: &mut PacketHits,
) {
    for triangle in 0..block.len() {
        let lanes = if C::ORDERED { packet.lanes } else { hits.live(simd, packet.lanes) };
        intersect_triangle::<S, C>(simd, block, triangle, packet, lanes, hits);
    }
}

/// One triangle against sixteen rays: lane for lane the arithmetic of one ray against eight triangles.
#[inline(always)]
fn intersect_triangle<S: Simd, C: LaneCallback>(
    simd: S,
    block: &TriangleBlock,
    triangle: usize,
    packet: &PacketAtLeaf<'_, S>,
    lanes: u32,
    hits: &mut PacketHits,
) {
    let (rays, group) = (packet.rays, packet.group);
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
    if !C::ORDERED {
        hit.select(f32x16::splat(simd, -f32::INFINITY), t_max).store_slice(&mut hits.t);
        return;
    }
    let (old_primitive, old_instance) = (u32x16::from_slice(simd, &hits.primitive), u32x16::from_slice(simd, &hits.instance));
    let primitive = u32x16::splat(simd, block.primitives[triangle]);
    let instance = u32x16::splat(simd, packet.owner.id);
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
