//! Leaf of a mesh tree: up to eight triangles, structure of arrays.

use super::leaf::{Leaf, PacketAtLeaf};
use super::packet_triangles::intersect_block;
use super::prepared::PreparedRay;
use crate::hit_callback::HitCallback;
use crate::packet_hits::{LaneCallback, PacketHits};
use crate::ray::{Hit, NONE};
use crate::tree::instance::Owner;
use crate::tree::node::WIDTH;
use bytemuck::{Pod, Zeroable};
use fearless_simd::{f32x8, prelude::*};

/// Up to eight triangles sorted by their number; unused lanes hold NaN, which no test accepts.
///
/// The intersection test (Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013) shears the vertices into the ray's
/// space, where the three edge functions are differences of two products. Both products round monotonously, so a sign is never wrong, and a
/// zero is accepted from both sides: a closed mesh has no gap at edges or vertices.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct TriangleBlock {
    /// `vertices[corner][axis][lane]`.
    pub(crate) vertices: [[[f32; WIDTH]; 3]; 3],
    /// The triangles' numbers in the mesh, [`NONE`] in unused lanes.
    pub(crate) primitives: [u32; WIDTH],
}

impl TriangleBlock {
    /// A block without triangles.
    pub(crate) const EMPTY: TriangleBlock = TriangleBlock { vertices: [[[f32::NAN; WIDTH]; 3]; 3], primitives: [NONE; WIDTH] };

    pub(crate) fn set(&mut self, lane: usize, corners: [[f32; 3]; 3], primitive: u32) {
        for (rows, corner) in self.vertices.iter_mut().zip(corners) {
            for (row, x) in rows.iter_mut().zip(corner) {
                row[lane] = x;
            }
        }
        self.primitives[lane] = primitive;
    }

    /// All of it as one row: a coordinate of a corner begins at `24 corner + 8 axis`.
    #[inline(always)]
    fn numbers(&self) -> &[f32; 10 * WIDTH] {
        bytemuck::cast_ref(self)
    }

    /// The number of triangles.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        let mut n = 0;
        for primitive in self.primitives {
            n += usize::from(primitive != NONE);
        }
        n
    }
}

/// Distances and barycentric coordinates of eight triangles, valid in the lanes of a mask.
#[derive(Clone, Copy, Default)]
#[repr(C, align(32))]
pub(crate) struct BlockHits {
    pub(crate) t: [f32; WIDTH],
    pub(crate) u: [f32; WIDTH],
    pub(crate) v: [f32; WIDTH],
}

impl Leaf for &TriangleBlock {
    type Found = BlockHits;

    #[inline(always)]
    fn intersect_scalar(self, ray: &PreparedRay, t_max: f32, found: &mut BlockHits) -> u32 {
        let [x_axis, y_axis, z_axis, _] = ray.axes.map(|axis| axis as usize / WIDTH);
        let mut mask = 0;
        for lane in 0..WIDTH {
            let corner = |k: usize| {
                let rows = &self.vertices[k];
                let z = rows[z_axis][lane] - ray.origin[z_axis];
                let x = (rows[x_axis][lane] - ray.origin[x_axis]) - ray.shear[0] * z;
                [x, (rows[y_axis][lane] - ray.origin[y_axis]) - ray.shear[1] * z, z]
            };
            let (a, b, c) = (corner(0), corner(1), corner(2));
            let u = c[0] * b[1] - c[1] * b[0];
            let v = a[0] * c[1] - a[1] * c[0];
            let w = b[0] * a[1] - b[1] * a[0];
            let determinant = u + v + w;
            let inverse = 1.0 / determinant;
            let t = (u * a[2] + (v * b[2] + w * c[2])) * inverse * ray.shear[2];
            let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) | (u <= 0.0 && v <= 0.0 && w <= 0.0);
            (found.t[lane], found.u[lane], found.v[lane]) = (t, v * inverse, w * inverse);
            mask |= u32::from(inside & (t > ray.t_min) & (t <= t_max)) << lane;
        }
        mask
    }

    #[inline(always)]
    fn intersect<S: Simd>(self, simd: S, ray: &PreparedRay, t_max: f32, found: &mut BlockHits) -> u32 {
        let sheared = ShearedRay::new(simd, ray);
        let numbers = self.numbers();
        let a = sheared.corner(simd, numbers, 0);
        let b = sheared.corner(simd, numbers, 1);
        let c = sheared.corner(simd, numbers, 2);
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let inside = u.min(v).min(w).simd_ge(0.0) | u.max(v).max(w).simd_le(0.0);
        // No early way out where none is inside: nobody foresees that branch, and it costs more than this division.
        let inverse = f32x8::splat(simd, 1.0) / (u + v + w);
        let t = u.mul_add(a[2], v.mul_add(b[2], w * c[2])) * inverse * ray.shear[2];
        let hit = inside & t.simd_gt(ray.t_min) & t.simd_le(t_max);
        t.store_slice(&mut found.t);
        (v * inverse).store_slice(&mut found.u);
        (w * inverse).store_slice(&mut found.v);
        hit.to_bitmask() as u32
    }

    #[inline(always)]
    fn report<C: HitCallback>(self, lane: usize, _ray: &PreparedRay, found: &BlockHits, owner: Owner, callback: &mut C) -> bool {
        let hit = Hit { t: found.t[lane], u: found.u[lane], v: found.v[lane], primitive: self.primitives[lane], instance: owner.id };
        callback.add(hit, owner.transparent)
    }

    #[inline(always)]
    fn intersect_packet<S: Simd, C: LaneCallback>(self, simd: S, packet: &PacketAtLeaf<'_, S>, hits: &mut PacketHits) {
        intersect_block::<S, C>(simd, self, packet, hits);
    }
}

/// A ray's start and slopes in the order of its axes.
struct ShearedRay<S: Simd> {
    axes: [usize; 3],
    origin: [f32x8<S>; 3],
    slopes: [f32x8<S>; 2],
}

impl<S: Simd> ShearedRay<S> {
    #[inline(always)]
    fn new(simd: S, ray: &PreparedRay) -> Self {
        let [x, y, z, _] = ray.start;
        // The masks say that a corner has this coordinate, so that nothing has to be checked.
        let axes = [(ray.axes[0] & 24) as usize, (ray.axes[1] & 24) as usize, (ray.axes[2] & 24) as usize];
        let origin = [f32x8::splat(simd, x), f32x8::splat(simd, y), f32x8::splat(simd, z)];
        let slopes = [f32x8::splat(simd, -ray.shear[0]), f32x8::splat(simd, -ray.shear[1])];
        ShearedRay { axes, origin, slopes }
    }

    /// One corner of eight triangles in the ray's space.
    #[inline(always)]
    fn corner(&self, simd: S, numbers: &[f32; 10 * WIDTH], corner: usize) -> [f32x8<S>; 3] {
        let [x, y, z] = self.axes;
        let z = f32x8::from_slice(simd, &numbers[24 * corner + z..][..8]) - self.origin[2];
        let x = f32x8::from_slice(simd, &numbers[24 * corner + x..][..8]) - self.origin[0];
        let y = f32x8::from_slice(simd, &numbers[24 * corner + y..][..8]) - self.origin[1];
        [self.slopes[0].mul_add(z, x), self.slopes[1].mul_add(z, y), z]
    }
}
