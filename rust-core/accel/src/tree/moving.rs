//! Instances that move while the shutter is open: where they are at a ray's time, and the boxes that they stay within.

use super::node::Bounds;
use crate::intersect::prepared::{Padded, PreparedRay};
use crate::intersect::transform::{Affine, transformed_bounds};
use gonio_simd::motion::{Motion, segment_of};

/// An instance by its number, and how it moves; its own map is where it rests.
#[derive(Clone, Debug)]
pub struct MovingInstance {
    /// The instance's number.
    pub instance: u32,
    /// Object to world over the shutter.
    pub motion: Motion,
}

/// What traversal reads of a moving instance.
#[derive(Clone, Debug)]
pub(crate) struct MovingRecord {
    motion: Motion,
    /// Boxes at evenly spaced times: lowest and highest corners, and numbers that mean nothing. Between two of them the instance is within the box that
    /// goes straight from one to the next.
    boxes: Vec<[Padded; 2]>,
}

/// A box spans a turn of about so many radians at most.
const LARGEST_TURN: f64 = 0.4;

impl MovingRecord {
    /// An instance whose geometry lies within some boxes of its own space; the second is the world box of the whole shutter.
    pub(crate) fn new(motion: &Motion, outline: &[Bounds]) -> (Self, Bounds) {
        let segments = motion.segments();
        let turn = (0..segments).map(|segment| motion.turn(segment)).fold(0.0, f64::max);
        let parts = (turn / LARGEST_TURN).ceil().max(1.0);
        let corners: Vec<[f64; 3]> = outline.iter().flat_map(corners).collect();
        let bow = (0..segments).map(|segment| motion.bow(segment, &corners)).fold(0.0, f64::max) / (parts * parts);
        let count = segments * parts as usize;
        let at = |place: usize| {
            let rows = motion.at(place as f32 / count as f32);
            let bounds = outline.iter().map(|bounds| transformed_bounds(&rows, bounds));
            widened(&bounds.fold(Bounds::EMPTY, |all, bounds| all.union(&bounds)), bow as f32)
        };
        let boxes: Vec<Bounds> = (0..=count).map(at).collect();
        let whole = boxes.iter().fold(Bounds::EMPTY, |all, bounds| all.union(bounds));
        let padded = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        let boxes = boxes.iter().map(|bounds| [padded(bounds.min), padded(bounds.max)]).collect();
        (Self { motion: motion.clone(), boxes }, whole)
    }

    /// The map from the world to the instance's space at a time; `None` where it is flat then.
    #[inline(always)]
    pub(crate) fn world_to_object(&self, time: f32) -> Option<Affine> {
        Affine::of_columns(&self.motion.inverse_columns_at(time)?)
    }

    /// Whether a ray of the world meets the box that the instance is in at a time.
    #[inline(always)]
    fn is_met(&self, time: f32, ray: &PreparedRay, t_max: f32) -> bool {
        let (number, share) = segment_of(time, self.boxes.len() - 1);
        let ([low, high], [next_low, next_high]) = (&self.boxes[number], &self.boxes[number + 1]);
        let (mut enters, mut leaves) = ([0.0f32; 4], [0.0f32; 4]);
        // All four at once, though the last means nothing.
        for k in 0..4 {
            let low = low[k] + (next_low[k] - low[k]) * share;
            let high = high[k] + (next_high[k] - high[k]) * share;
            let backwards = ray.reciprocal[k] < 0.0;
            enters[k] = if backwards { high } else { low } * ray.reciprocal[k] + ray.near_offset[k];
            leaves[k] = if backwards { low } else { high } * ray.reciprocal[k] + ray.far_offset[k];
        }
        let [enter, leave] = [ray.t_min.max(enters[0]).max(enters[1]).max(enters[2]), t_max.min(leaves[0]).min(leaves[1]).min(leaves[2])];
        enter <= leave
    }

    /// The map for a ray of the world that may meet the instance at its time, else `None`.
    #[inline(never)]
    pub(crate) fn enter(&self, time: f32, ray: &PreparedRay, t_max: f32) -> Option<Affine> {
        if self.is_met(time, ray, t_max) { self.world_to_object(time) } else { None }
    }
}

fn corners(bounds: &Bounds) -> [[f64; 3]; 8] {
    let mut corners = [[0.0; 3]; 8];
    for (number, corner) in corners.iter_mut().enumerate() {
        for (axis, x) in corner.iter_mut().enumerate() {
            *x = f64::from(if number >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] });
        }
    }
    corners
}

/// Wider on all sides, and by the rounding of its way: twice what boxes at rest are widened by.
fn widened(bounds: &Bounds, by: f32) -> Bounds {
    let wide = Bounds { min: bounds.min.map(|x| x - by), max: bounds.max.map(|x| x + by) };
    wide.padded().padded()
}

/// How some instance moves.
pub(crate) fn motion_of(moving: &[MovingInstance], instance: u32) -> Option<&Motion> {
    moving.binary_search_by_key(&instance, |one| one.instance).ok().map(|place| &moving[place].motion)
}
