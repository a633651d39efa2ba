//! One ray made ready for box and triangle tests.
//!
//! Boxes are tested as `plane * reciprocal + offset`, one fused operation a plane. Its rounding errors move a plane by some units in the
//! last place of the coordinates in play; the share that depends on the box was added to the box when the tree was built, the share that
//! depends on the ray is in the offsets here (`node.rs`, `ROUNDING_PAD`). So the test is conservative at the speed of a careless one.

use super::node::{LARGEST_COORDINATE, ROUNDING_PAD};

/// Three components and a number that means nothing, so that all are computed and moved at once: a ray is made ready for every instance it enters.
pub(super) type Padded = [f32; 4];

/// The lesser axes and the largest, by the largest.
pub(super) static AXES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// The larger number, and the second where one is NaN: one instruction, which `f32::max` is not.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A ray in the space of one tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedRay {
    pub(super) origin: Padded,
    pub(super) direction: Padded,
    /// One over the direction, components near zero replaced.
    pub(super) reciprocal: Padded,
    /// Offsets of the near planes, moved towards the ray's start.
    pub(super) near_offset: Padded,
    /// Offsets of the far planes, moved away from the ray's start.
    pub(super) far_offset: Padded,
    /// Where the near planes of x, y, z begin among the numbers of a node, and a place of no meaning.
    pub(super) near_rows: [u32; 4],
    /// Where the far planes begin.
    pub(super) far_rows: [u32; 4],
    /// Where the coordinates along the two lesser axes and the axis of the largest direction component begin among those of a corner.
    pub(super) axes: [u32; 3],
    /// The origin in the order of those axes.
    pub(super) start: [f32; 3],
    /// Slopes of the lesser axes and the reciprocal along the largest.
    pub(super) shear: [f32; 3],
    /// Lower end of the interval.
    pub(super) t_min: f32,
}

/// Direction components below this share of the largest are raised to it; the planes move less by that than by the padding.
pub(super) const SMALLEST_SHARE: f32 = 1.0 / (1u32 << 30) as f32;

/// Bounds of the direction's largest component between which reciprocals and products stay finite.
pub(super) const DIRECTION_RANGE: [f32; 2] = [1e-12, 1e12];

impl PreparedRay {
    /// A ray that is of no use, where there is none yet.
    pub(super) const NOTHING: PreparedRay = PreparedRay {
        origin: [0.0; 4],
        direction: [0.0; 4],
        reciprocal: [0.0; 4],
        near_offset: [0.0; 4],
        far_offset: [0.0; 4],
        near_rows: [0; 4],
        far_rows: [0; 4],
        axes: [0; 3],
        start: [0.0; 3],
        shear: [0.0; 3],
        t_min: 0.0,
    };

    /// `None` when the ray can hit nothing: parts of it are not finite, its direction is zero, or its interval is empty.
    #[inline(always)]
    pub(super) fn new(origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<Self> {
        let (reciprocal, offsets, t_min, major) = slopes(&origin, &direction, t_min, t_max)?;
        Some(Self::with_offsets(origin, direction, reciprocal, offsets, t_min, major))
    }

    /// [`PreparedRay::new`] in the place where the ray stays; false when it can hit nothing.
    #[inline(always)]
    pub(super) fn prepare(&mut self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> bool {
        let Some((reciprocal, offsets, t_min, major)) = slopes(&origin, &direction, t_min, t_max) else {
            return false;
        };
        (self.origin, self.direction, self.reciprocal, self.t_min) = (origin, direction, reciprocal, t_min);
        [self.near_offset, self.far_offset] = offsets;
        [self.near_rows, self.far_rows] = rows(&direction);
        // Read where they are kept now: numbers that an axis chooses would be put into memory once more, and copied from there.
        [self.start, self.shear] = along_axes(&self.origin, &self.direction, &self.reciprocal, major);
        self.axes = AXES[major % 3].map(|axis| 8 * axis as u32);
        true
    }

    /// The ray of these numbers; `offsets` are those of the near planes and of the far ones.
    #[inline(always)]
    pub(super) fn with_offsets(
        origin: Padded,
        direction: Padded,
        reciprocal: Padded,
        [near_offset, far_offset]: [Padded; 2],
        t_min: f32,
        major: usize,
    ) -> Self {
        let [near_rows, far_rows] = rows(&direction);
        let [start, shear] = along_axes(&origin, &direction, &reciprocal, major);
        let axes = AXES[major % 3].map(|axis| 8 * axis as u32);
        PreparedRay { origin, direction, reciprocal, near_offset, far_offset, near_rows, far_rows, axes, start, shear, t_min }
    }
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
fn along_axes(origin: &Padded, direction: &Padded, reciprocal: &Padded, major: usize) -> [[f32; 3]; 2] {
    let axes = AXES[major % 3];
    let along = reciprocal[major % 4];
    let shear = [direction[axes[0] % 4] * along, direction[axes[1] % 4] * along, along];
    [[origin[axes[0] % 4], origin[axes[1] % 4], origin[axes[2] % 4]], shear]
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
