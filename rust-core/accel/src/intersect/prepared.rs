//! One ray made ready for box and triangle tests.
//!
//! Boxes are tested as `plane * reciprocal + offset`, one fused operation a plane. Its rounding errors move a plane by some units in the
//! last place of the coordinates in play; the share that depends on the box was added to the box when the tree was built, the share that
//! depends on the ray is in the offsets here (`node.rs`, `ROUNDING_PAD`). So the test is conservative at the speed of a careless one.

use crate::tree::node::{LARGEST_COORDINATE, ROUNDING_PAD};
use fearless_simd::{f32x4, prelude::*, u8x16, u32x4};

/// Three components and a number that means nothing, so that all are computed and moved at once: a ray is made ready for every instance it enters.
pub(crate) type Padded = [f32; 4];

/// The lesser axes and the largest, by the largest.
pub(crate) static AXES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// Where the coordinates along these begin among those of a corner.
static CORNER_ROWS: [[u32; 4]; 3] = [[8, 16, 0, 0], [16, 0, 8, 0], [0, 8, 16, 0]];

/// Bytes of the components along these.
static ORDER: [[u8; 16]; 3] = [
    [4, 5, 6, 7, 8, 9, 10, 11, 0, 1, 2, 3, 12, 13, 14, 15],
    [8, 9, 10, 11, 0, 1, 2, 3, 4, 5, 6, 7, 12, 13, 14, 15],
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15],
];

/// Where near planes and far planes begin for directions that nowhere go backwards.
static ROWS: [[u32; 4]; 2] = [[0, 8, 16, 24], [24, 32, 40, 48]];

/// The larger number, and the second where one is NaN: one instruction, which `f32::max` is not.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A ray in the space of one tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreparedRay {
    pub(crate) origin: Padded,
    pub(crate) direction: Padded,
    /// One over the direction, components near zero replaced.
    pub(crate) reciprocal: Padded,
    /// Offsets of the near planes, moved towards the ray's start.
    pub(crate) near_offset: Padded,
    /// Offsets of the far planes, moved away from the ray's start.
    pub(crate) far_offset: Padded,
    /// Where the near planes of x, y, z begin among the numbers of a node, and a place of no meaning.
    pub(crate) near_rows: [u32; 4],
    /// Where the far planes begin.
    pub(crate) far_rows: [u32; 4],
    /// Where the coordinates along the two lesser axes and the axis of the largest direction component begin among those of a corner.
    pub(crate) axes: [u32; 4],
    /// The origin in the order of those axes.
    pub(crate) start: Padded,
    /// Slopes of the lesser axes and the reciprocal along the largest.
    pub(crate) shear: Padded,
    /// Lower end of the interval.
    pub(crate) t_min: f32,
}

/// Direction components below this share of the largest are raised to it; the planes move less by that than by the padding.
pub(crate) const SMALLEST_SHARE: f32 = 1.0 / (1u32 << 30) as f32;

/// Bounds of the direction's largest component between which reciprocals and products stay finite.
pub(crate) const DIRECTION_RANGE: [f32; 2] = [1e-12, 1e12];

impl PreparedRay {
    /// A ray that is of no use, where there is none yet.
    pub(crate) const NOTHING: PreparedRay = PreparedRay {
        origin: [0.0; 4],
        direction: [0.0; 4],
        reciprocal: [0.0; 4],
        near_offset: [0.0; 4],
        far_offset: [0.0; 4],
        near_rows: [0; 4],
        far_rows: [0; 4],
        axes: [0; 4],
        start: [0.0; 4],
        shear: [0.0; 4],
        t_min: 0.0,
    };

    /// `None` when the ray can hit nothing: parts of it are not finite, its direction is zero, or its interval is empty.
    #[inline(always)]
    pub(crate) fn new(origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<Self> {
        let (reciprocal, offsets, t_min, major) = slopes(&origin, &direction, t_min, t_max)?;
        Some(Self::with_offsets(origin, direction, reciprocal, offsets, t_min, major))
    }

    /// [`PreparedRay::new`] in the place where the ray stays, all components at once and to the same bits; false when it can hit nothing.
    #[inline(always)]
    pub(crate) fn prepare<S: Simd>(&mut self, simd: S, origin: f32x4<S>, direction: f32x4<S>, t_min: f32, t_max: f32) -> bool {
        let (size, distance) = (direction.abs(), origin.abs());
        let (largest, farthest) = (largest_of(simd, size), largest_of(simd, distance));
        // Comparisons catch NaN.
        let usable = size.simd_le(DIRECTION_RANGE[1]) & distance.simd_le(LARGEST_COORDINATE) & largest.simd_ge(DIRECTION_RANGE[0]);
        let t_min = larger(t_min, 0.0);
        if !((usable.to_bitmask() & 7 == 7) & (t_min <= t_max)) {
            return false;
        }
        let major = size.simd_ge(largest).to_bitmask().trailing_zeros() as usize % 3;
        let reciprocal = f32x4::splat(simd, 1.0) / size.max(largest * SMALLEST_SHARE).copysign(direction);
        let pad = (farthest * ROUNDING_PAD).copysign(direction);
        let backwards = direction.to_bits() >> 31;
        let backwards = (backwards << 4) + (backwards << 3);
        let order = u8x16::from_slice(simd, &ORDER[major]);
        let along = reciprocal.as_slice()[major];
        origin.store_slice(&mut self.origin);
        direction.store_slice(&mut self.direction);
        reciprocal.store_slice(&mut self.reciprocal);
        (-(origin + pad) * reciprocal).store_slice(&mut self.near_offset);
        (-(origin - pad) * reciprocal).store_slice(&mut self.far_offset);
        (u32x4::from_slice(simd, &ROWS[0]) + backwards).store_slice(&mut self.near_rows);
        (u32x4::from_slice(simd, &ROWS[1]) - backwards).store_slice(&mut self.far_rows);
        self.axes = CORNER_ROWS[major];
        origin.swizzle_dyn(order).store_slice(&mut self.start);
        (direction.swizzle_dyn(order) * along).store_slice(&mut self.shear);
        self.shear[2] = along;
        self.t_min = t_min;
        true
    }

    /// Another ray moved, in the place where it stays: to the bits of [`PreparedRay::new`], but for zeros that keep their signs; false when it
    /// can hit nothing.
    #[inline(always)]
    pub(crate) fn shift<S: Simd>(&mut self, simd: S, ray: &PreparedRay, translation: f32x4<S>, t_max: f32) -> bool {
        let origin = f32x4::from_slice(simd, &ray.origin) + translation;
        let distance = origin.abs();
        if !((distance.simd_le(LARGEST_COORDINATE).to_bitmask() & 7 == 7) & (ray.t_min <= t_max)) {
            return false;
        }
        let reciprocal = f32x4::from_slice(simd, &ray.reciprocal);
        let pad = (largest_of(simd, distance) * ROUNDING_PAD).copysign(reciprocal);
        let order = u8x16::from_slice(simd, &ORDER[ray.axes[2] as usize / 8 % 3]);
        origin.store_slice(&mut self.origin);
        reciprocal.store_slice(&mut self.reciprocal);
        (-(origin + pad) * reciprocal).store_slice(&mut self.near_offset);
        (-(origin - pad) * reciprocal).store_slice(&mut self.far_offset);
        origin.swizzle_dyn(order).store_slice(&mut self.start);
        (self.near_rows, self.far_rows, self.axes) = (ray.near_rows, ray.far_rows, ray.axes);
        (self.shear, self.t_min, self.direction) = (ray.shear, ray.t_min, ray.direction);
        true
    }

    /// The ray of these numbers; `offsets` are those of the near planes and of the far ones.
    #[inline(always)]
    pub(crate) fn with_offsets(
        origin: Padded,
        direction: Padded,
        reciprocal: Padded,
        [near_offset, far_offset]: [Padded; 2],
        t_min: f32,
        major: usize,
    ) -> Self {
        let [near_rows, far_rows] = rows(&direction);
        let [start, shear] = along_axes(&origin, &direction, &reciprocal, major);
        let axes = CORNER_ROWS[major % 3];
        PreparedRay { origin, direction, reciprocal, near_offset, far_offset, near_rows, far_rows, axes, start, shear, t_min }
    }
}

/// The largest of the first three components, in these three.
#[inline(always)]
fn largest_of<S: Simd>(simd: S, v: f32x4<S>) -> f32x4<S> {
    v.max(v.swizzle_dyn(u8x16::from_slice(simd, &ORDER[0]))).max(v.swizzle_dyn(u8x16::from_slice(simd, &ORDER[1])))
}

/// Where near planes and far planes begin.
#[inline(always)]
fn rows(direction: &Padded) -> [[u32; 4]; 2] {
    let (mut near_rows, mut far_rows) = ([0; 4], [0; 4]);
    for k in 0..4 {
        let backwards = (direction[k].to_bits() >> 31) * 24;
        near_rows[k] = 8 * k as u32 + backwards;
        far_rows[k] = 8 * k as u32 + 24 - backwards;
    }
    [near_rows, far_rows]
}

/// The origin in the order of the axes, and the slopes with the reciprocal along the largest.
#[inline(always)]
fn along_axes(origin: &Padded, direction: &Padded, reciprocal: &Padded, major: usize) -> [Padded; 2] {
    let axes = AXES[major % 3];
    let along = reciprocal[major % 4];
    let shear = [direction[axes[0] % 4] * along, direction[axes[1] % 4] * along, along, 0.0];
    [[origin[axes[0] % 4], origin[axes[1] % 4], origin[axes[2] % 4], 0.0], shear]
}

/// Reciprocals, offsets of near and far planes, lower end of the interval and largest axis of a ray, if it can hit anything.
#[inline(always)]
fn slopes(origin: &Padded, direction: &Padded, t_min: f32, t_max: f32) -> Option<(Padded, [Padded; 2], f32, usize)> {
    let ([x, y, z, _], [ox, oy, oz, _]) = (direction.map(f32::abs), origin.map(f32::abs));
    let (largest, start) = (larger(larger(x, y), z), larger(larger(ox, oy), oz));
    // The sum catches NaN, which the maxima drop.
    let sum = x + y + z + ox + oy + oz;
    let t_min = larger(t_min, 0.0);
    let usable = (DIRECTION_RANGE[0]..=DIRECTION_RANGE[1]).contains(&largest)
        & (start <= LARGEST_COORDINATE)
        & (sum < f32::INFINITY)
        & (t_min <= t_max);
    if !usable {
        return None;
    }
    let major = if (x >= y) & (x >= z) { 0 } else { 1 + usize::from(y < z) };
    let smallest = largest * SMALLEST_SHARE;
    let pad = start * ROUNDING_PAD;
    let (mut reciprocal, mut near_offset, mut far_offset) = ([0.0; 4], [0.0; 4], [0.0; 4]);
    for k in 0..4 {
        let component = larger(direction[k].abs(), smallest).copysign(direction[k]);
        reciprocal[k] = 1.0 / component;
        let signed_pad = pad.copysign(direction[k]);
        near_offset[k] = -(origin[k] + signed_pad) * reciprocal[k];
        far_offset[k] = -(origin[k] - signed_pad) * reciprocal[k];
    }
    Some((reciprocal, [near_offset, far_offset], t_min, major))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersect::lanes8::Lanes8;
    use crate::intersect::scalar::Scalar;
    use crate::intersect::transform::Affine;
    use crate::intersect::wide::Wide;
    use gonio_simd::dispatch_level;

    /// Starts, directions and ends: axes, ties, both zeros, what is too small, too large, not finite, or ends before it begins.
    fn rays() -> Vec<(Padded, Padded, [f32; 2])> {
        let numbers = [0.0, -0.0, 1.0, -1.0, 0.3, -2.5, 1e-14, 1e-20, 2e12, f32::INFINITY, f32::NAN];
        let mut rays = Vec::new();
        for (i, x) in numbers.into_iter().enumerate() {
            for (j, y) in numbers.into_iter().enumerate() {
                let place = [y, numbers[(i + 2 * j) % 7], numbers[(3 * i + j) % 7], 0.0];
                let range = [[0.0, f32::MAX], [-1.0, 1.0], [0.5, 0.25], [0.1, f32::NAN]][(i + j) % 4];
                rays.extend(numbers.map(|z| (place, [x, y, z, 0.0], range)));
            }
        }
        rays
    }

    /// The bits of all that tests of boxes and triangles read, if the ray is of use.
    fn bits(ray: Option<PreparedRay>) -> Option<Vec<u32>> {
        let ray = ray?;
        let floats = [ray.origin, ray.direction, ray.reciprocal, ray.near_offset, ray.far_offset, ray.start, ray.shear];
        let places = [ray.near_rows, ray.far_rows, ray.axes];
        let floats = floats.iter().flat_map(|v| v[..3].iter().map(|x| x.to_bits()));
        Some(floats.chain(places.iter().flat_map(|v| v[..3].to_vec())).chain([ray.t_min.to_bits()]).collect())
    }

    #[test]
    fn rays_and_their_images_have_the_same_numbers_at_every_level() {
        let map = Affine::new(&[[0.5, -2.0, 0.25, 3.0], [1.5, 0.125, -0.75, -7.0], [-0.3, 0.9, 1.1, 0.01]]).expect("finite");
        let mut of_use = 0;
        for (origin, direction, [t_min, t_max]) in rays() {
            let alone = Scalar.prepare(origin, direction, t_min, t_max);
            of_use += usize::from(alone.is_some());
            let image = alone.and_then(|ray| Scalar.image(&map, &ray, t_max));
            for level in crate::tests::levels() {
                let lanes = dispatch_level!(level, simd => Wide(simd).prepare(origin, direction, t_min, t_max));
                let lanes_image = alone.and_then(|ray| dispatch_level!(level, simd => Wide(simd).image(&map, &ray, t_max)));
                assert_eq!(bits(lanes), bits(alone), "{level:?} {origin:?} {direction:?}");
                assert_eq!(bits(lanes_image), bits(image), "{level:?} {origin:?} {direction:?}");
            }
        }
        assert!(of_use > 100, "{of_use}");
    }

    #[test]
    fn a_ray_is_shifted_to_its_image() {
        let map = Affine::new(&[[1.0, 0.0, 0.0, 3.0], [0.0, 1.0, 0.0, -7.0], [0.0, 0.0, 1.0, 0.01]]).expect("finite");
        let no_sign_of_zero = |direction: &Padded| direction.iter().all(|x| *x != 0.0 || x.is_sign_positive());
        let mut of_use = 0;
        for (origin, direction, [t_min, t_max]) in rays().into_iter().filter(|(_, direction, _)| no_sign_of_zero(direction)) {
            let Some(ray) = Scalar.prepare(origin, direction, t_min, t_max) else { continue };
            let image = Scalar.image(&map, &ray, t_max);
            of_use += usize::from(image.is_some());
            for level in crate::tests::levels() {
                let mut shifted = PreparedRay { direction, ..PreparedRay::NOTHING };
                let may_hit = dispatch_level!(level, simd => shifted.shift(simd, &ray, map.translation(simd), t_max));
                assert_eq!(bits(may_hit.then_some(shifted)), bits(image), "{level:?} {origin:?} {direction:?}");
            }
        }
        assert!(of_use > 100, "{of_use}");
    }
}
