//! Sixteen rays made ready for box and triangle tests; lane for lane the numbers of `PreparedRay`.

use crate::intersect::prepared::{AXES, DIRECTION_RANGE, Padded, PreparedRay, SMALLEST_SHARE};
use crate::intersect::transform::Affine;
use crate::tree::node::{LARGEST_COORDINATE, ROUNDING_PAD};
use fearless_simd::{f32x16, mask32x16, prelude::*};

/// Rays of a packet.
pub(crate) const PACKET: usize = 16;

/// Sixteen rays in the space of one tree.
#[derive(Clone, Copy)]
pub(crate) struct PacketRays<S: Simd> {
    pub(crate) origin: [f32x16<S>; 3],
    pub(crate) direction: [f32x16<S>; 3],
    pub(crate) reciprocal: [f32x16<S>; 3],
    pub(crate) near_offset: [f32x16<S>; 3],
    pub(crate) far_offset: [f32x16<S>; 3],
    pub(crate) t_min: f32x16<S>,
    /// Lanes with negative directions, an axis each.
    negative: [u32; 3],
    /// Lanes whose largest direction component is along x and y.
    major: [u32; 2],
    /// The lanes that can hit something.
    pub(crate) lanes: u32,
}

impl<S: Simd> PacketRays<S> {
    /// Prepares the lanes of a mask; `t_min` must not be negative.
    #[inline(always)]
    pub(crate) fn new(simd: S, origin: [f32x16<S>; 3], direction: [f32x16<S>; 3], t_min: f32x16<S>, t_max: f32x16<S>, lanes: u32) -> Self {
        let zero = f32x16::splat(simd, 0.0);
        let [x, y, z] = [direction[0].abs(), direction[1].abs(), direction[2].abs()];
        let [ox, oy, oz] = [origin[0].abs(), origin[1].abs(), origin[2].abs()];
        let (largest, start) = (x.max(y).max(z), ox.max(oy).max(oz));
        let sum = x + y + z + ox + oy + oz;
        let usable = largest.simd_ge(DIRECTION_RANGE[0])
            & largest.simd_le(DIRECTION_RANGE[1])
            & start.simd_le(LARGEST_COORDINATE)
            & sum.simd_lt(f32::INFINITY)
            & t_min.simd_le(t_max);
        let (smallest, pad) = (largest * SMALLEST_SHARE, start * ROUNDING_PAD);
        let (mut reciprocal, mut near_offset, mut far_offset) = ([zero; 3], [zero; 3], [zero; 3]);
        let mut negative = [0; 3];
        for axis in 0..3 {
            let component = direction[axis].abs().max(smallest).copysign(direction[axis]);
            reciprocal[axis] = f32x16::splat(simd, 1.0) / component;
            let signed_pad = pad.copysign(component);
            near_offset[axis] = -(origin[axis] + signed_pad) * reciprocal[axis];
            far_offset[axis] = -(origin[axis] - signed_pad) * reciprocal[axis];
            negative[axis] = component.simd_lt(0.0).to_bitmask() as u32;
        }
        let x_major = (x.simd_ge(y) & x.simd_ge(z)).to_bitmask() as u32;
        let major = [x_major, y.simd_ge(z).to_bitmask() as u32 & !x_major];
        let lanes = lanes & usable.to_bitmask() as u32;
        PacketRays { origin, direction, reciprocal, near_offset, far_offset, t_min, negative, major, lanes }
    }

    /// The packet in the space of an instance.
    #[inline(always)]
    pub(crate) fn transformed(&self, simd: S, m: &Affine, t_max: f32x16<S>, lanes: u32) -> Self {
        let (mut origin, mut direction) = (self.origin, self.direction);
        let [p, d] = [self.origin, self.direction];
        for axis in 0..3 {
            let row = m.row(axis);
            origin[axis] = (p[0] * row[0] + p[1] * row[1]) + (p[2] * row[2] + row[3]);
            direction[axis] = (d[0] * row[0] + d[1] * row[1]) + d[2] * row[2];
        }
        Self::new(simd, origin, direction, self.t_min, t_max, lanes)
    }

    /// The lanes among `lanes` that go through boxes and triangles the way the first of them does.
    #[inline(always)]
    pub(crate) fn like_first(&self, lanes: u32) -> u32 {
        let bit = lanes & lanes.wrapping_neg();
        let mut group = lanes;
        for mask in self.negative.into_iter().chain(self.major) {
            group &= if mask & bit != 0 { mask } else { !mask };
        }
        group
    }

    /// The ray of one lane, which must be among those that can hit something: its numbers are there, none has to be worked out anew.
    #[inline(always)]
    pub(crate) fn single(&self, lane: usize) -> PreparedRay {
        let bit = 1 << lane;
        let major = self.major_of(bit);
        PreparedRay::with_offsets(
            lane_of(&self.origin, lane),
            lane_of(&self.direction, lane),
            lane_of(&self.reciprocal, lane),
            [lane_of(&self.near_offset, lane), lane_of(&self.far_offset, lane)],
            self.t_min.as_slice()[lane],
            major,
        )
    }

    /// The major axis of the lane of a bit.
    #[inline(always)]
    fn major_of(&self, bit: u32) -> usize {
        if self.major[0] & bit != 0 { 0 } else { 2 - usize::from(self.major[1] & bit != 0) }
    }
}

/// The components of one lane.
#[inline(always)]
pub(crate) fn lane_of<S: Simd>(v: &[f32x16<S>; 3], lane: usize) -> Padded {
    [v[0].as_slice()[lane], v[1].as_slice()[lane], v[2].as_slice()[lane], 0.0]
}

/// The least of the chosen lanes.
#[inline(always)]
fn least<S: Simd>(simd: S, lanes: mask32x16<S>, v: f32x16<S>) -> f32 {
    lanes.select(v, f32x16::splat(simd, f32::INFINITY)).reduce_min()
}

/// The largest of the chosen lanes.
#[inline(always)]
fn most<S: Simd>(simd: S, lanes: mask32x16<S>, v: f32x16<S>) -> f32 {
    lanes.select(v, f32x16::splat(simd, -f32::INFINITY)).reduce_max()
}

/// What the lanes of a group share: signs, major axis, and intervals around their rays.
pub(crate) struct Group<S: Simd> {
    /// See `PreparedRay::near_rows`.
    pub(crate) near_rows: [usize; 3],
    /// See `PreparedRay::axes`.
    pub(crate) axes: [usize; 3],
    /// See `PreparedRay::shear`, the slopes negated.
    pub(crate) shear: [f32x16<S>; 3],
    /// Ends of the reciprocals' interval.
    pub(crate) reciprocal: [[f32; 2]; 3],
    /// The starts that meet near planes first and far planes last.
    pub(crate) start: [[f32; 2]; 3],
}

impl<S: Simd> Group<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, rays: &PacketRays<S>, lanes: u32) -> Self {
        let first = lanes & lanes.wrapping_neg();
        let major = rays.major_of(first);
        let axes = AXES[major];
        let along = rays.reciprocal[major];
        let shear = [-(rays.direction[axes[0]] * along), -(rays.direction[axes[1]] * along), along];
        let mask = mask32x16::from_bitmask(simd, u64::from(lanes));
        let mut group = Group { near_rows: [0; 3], axes, shear, reciprocal: [[0.0; 2]; 3], start: [[0.0; 2]; 3] };
        let [x, y, z] = [rays.origin[0].abs(), rays.origin[1].abs(), rays.origin[2].abs()];
        let pad = most(simd, mask, x.max(y).max(z)) * ROUNDING_PAD;
        for axis in 0..3 {
            group.reciprocal[axis] = [least(simd, mask, rays.reciprocal[axis]), most(simd, mask, rays.reciprocal[axis])];
            let (low, high) = (least(simd, mask, rays.origin[axis]) - pad, most(simd, mask, rays.origin[axis]) + pad);
            let backwards = rays.negative[axis] & first != 0;
            group.near_rows[axis] = if backwards { axis + 3 } else { axis };
            group.start[axis] = if backwards { [low, high] } else { [high, low] };
        }
        group
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_simd::dispatch_level;

    /// What the tests of boxes and triangles read of a ray.
    fn numbers(ray: &PreparedRay) -> [[u32; 3]; 10] {
        let bits = |v: &[f32]| [v[0], v[1], v[2]].map(f32::to_bits);
        let rows = |v: &[u32]| [v[0], v[1], v[2]];
        let PreparedRay { origin, direction, reciprocal, near_offset, far_offset, near_rows, far_rows, axes, start, shear, t_min: _ } = ray;
        [
            bits(origin),
            bits(direction),
            bits(reciprocal),
            bits(near_offset),
            bits(far_offset),
            rows(near_rows),
            rows(far_rows),
            rows(axes),
            bits(start),
            bits(shear),
        ]
    }

    #[inline(always)]
    fn singles<S: Simd>(simd: S, origin: &[[f32; PACKET]; 3], direction: &[[f32; PACKET]; 3]) -> Vec<PreparedRay> {
        let [x, y, z] = [0, 1, 2].map(|axis| (&origin[axis], &direction[axis]));
        let origin = [f32x16::from_slice(simd, x.0), f32x16::from_slice(simd, y.0), f32x16::from_slice(simd, z.0)];
        let direction = [f32x16::from_slice(simd, x.1), f32x16::from_slice(simd, y.1), f32x16::from_slice(simd, z.1)];
        let rays = PacketRays::new(simd, origin, direction, f32x16::splat(simd, 0.25), f32x16::splat(simd, 9.0), 0xffff);
        assert_eq!(rays.lanes, 0xffff);
        let mut singles = Vec::new();
        for lane in 0..PACKET {
            singles.push(rays.single(lane));
        }
        singles
    }

    #[test]
    fn a_lane_alone_has_the_numbers_of_a_ray_made_ready_alone() {
        let directions =
            [[1.0, 0.5, -0.25], [-0.5, 1.0, 0.0], [0.0, -0.0, -2.0], [-1.0, -1.0, -1.0], [0.0, 3.0, 3.0], [2.0, 1e-20, -1e-20]];
        let of = |lane: usize| (directions[lane % 6], [lane as f32 - 7.5, 0.0, 1e3 * lane as f32]);
        let origin = [0, 1, 2].map(|axis| std::array::from_fn(|lane| of(lane).1[axis]));
        let direction = [0, 1, 2].map(|axis| std::array::from_fn(|lane| of(lane).0[axis]));
        for level in crate::tests::levels() {
            let singles = dispatch_level!(level, simd => singles(simd, &origin, &direction));
            for (lane, single) in singles.iter().enumerate() {
                let ([dx, dy, dz], [x, y, z]) = of(lane);
                let alone = PreparedRay::new([x, y, z, 0.0], [dx, dy, dz, 0.0], 0.25, 9.0).expect("a ray that can hit something");
                assert_eq!(numbers(single), numbers(&alone), "{level:?}, lane {lane}");
                assert_eq!(single.t_min, alone.t_min);
            }
        }
    }
}
