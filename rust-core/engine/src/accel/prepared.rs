//! One ray made ready for box and triangle tests.
//!
//! Boxes are tested as `plane * reciprocal + offset`, one fused operation a plane. Its rounding errors move a plane by some units in the
//! last place of the coordinates in play; the share that depends on the box was added to the box when the tree was built, the share that
//! depends on the ray is in the offsets here (`node.rs`, `ROUNDING_PAD`). So the test is conservative at the speed of a careless one.

use super::node::{LARGEST_COORDINATE, ROUNDING_PAD};

/// A ray in the space of one tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedRay {
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 3],
    /// One over the direction, components near zero replaced.
    pub(super) reciprocal: [f32; 3],
    /// Offsets of the near planes, moved towards the ray's start.
    pub(super) near_offset: [f32; 3],
    /// Offsets of the far planes, moved away from the ray's start.
    pub(super) far_offset: [f32; 3],
    /// Rows of `Node::bounds` with the near planes of x, y, z.
    pub(super) near_rows: [usize; 3],
    /// The two lesser axes and the axis of the largest direction component.
    pub(super) axes: [usize; 3],
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
    /// `None` when the ray can hit nothing: parts of it are not finite, its direction is zero, or its interval is empty.
    #[inline(always)]
    pub(super) fn new(origin: [f32; 3], direction: [f32; 3], t_min: f32, t_max: f32) -> Option<Self> {
        let [x, y, z] = direction.map(f32::abs);
        let largest = x.max(y).max(z);
        let start = origin[0].abs().max(origin[1].abs()).max(origin[2].abs());
        // The sum catches NaN, which the maxima drop.
        let sum = x + y + z + origin[0].abs() + origin[1].abs() + origin[2].abs();
        let t_min = if t_min > 0.0 { t_min } else { 0.0 };
        if !((DIRECTION_RANGE[0]..=DIRECTION_RANGE[1]).contains(&largest)
            && start <= LARGEST_COORDINATE
            && sum < f32::INFINITY
            && t_min <= t_max)
        {
            return None;
        }
        let major = if x >= y && x >= z { 0 } else { 1 + usize::from(y < z) };
        Some(Self::with_major(origin, direction, t_min, largest, start, major))
    }

    #[inline(always)]
    fn with_major(origin: [f32; 3], direction: [f32; 3], t_min: f32, largest: f32, start: f32, major: usize) -> Self {
        let smallest = largest * SMALLEST_SHARE;
        let pad = start * ROUNDING_PAD;
        let mut reciprocal = [0.0; 3];
        let (mut near_offset, mut far_offset, mut near_rows) = ([0.0; 3], [0.0; 3], [0; 3]);
        for axis in 0..3 {
            let component = direction[axis].abs().max(smallest).copysign(direction[axis]);
            reciprocal[axis] = 1.0 / component;
            let signed_pad = pad.copysign(component);
            near_offset[axis] = -(origin[axis] + signed_pad) * reciprocal[axis];
            far_offset[axis] = -(origin[axis] - signed_pad) * reciprocal[axis];
            near_rows[axis] = if component < 0.0 { axis + 3 } else { axis };
        }
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][major];
        let along = reciprocal[major];
        let shear = [direction[axes[0]] * along, direction[axes[1]] * along, along];
        PreparedRay { origin, direction, reciprocal, near_offset, far_offset, near_rows, axes, shear, t_min }
    }
}
