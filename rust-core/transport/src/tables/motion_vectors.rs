//! Motion vectors: how many pixels what is seen has moved since the frame before, and moves until the next.
//!
//! Scalar and in double precision, one hit after the other: the pass is asked for where nothing is blurred, and costs nothing else.

use gonio_camera::CameraTable;
use gonio_simd::motion::Rows;
use gonio_simd::{Lanes, One, Vec3};

/// The camera at the frame, and at the ends of the motion: the frame before and the next one.
#[derive(Clone, Debug)]
pub struct MotionCameras {
    /// At the frame.
    pub now: CameraTable,
    /// At the frame before and at the next one.
    pub ends: [CameraTable; 2],
}

impl MotionCameras {
    /// Pixels to the right and upwards: of where a point was less where it is, and of where it is less where it will be. Zero where the camera
    /// has no picture of it.
    fn vectors(&self, now: [f32; 3], ends: [[f32; 3]; 2]) -> [f32; 4] {
        let Some(here) = place(&self.now, now) else { return [0.0; 4] };
        let mut vectors = [0.0; 4];
        for (end, sign) in [1.0, -1.0].into_iter().enumerate() {
            let Some(there) = place(&self.ends[end], ends[end]) else { continue };
            let mut right = there[0] - here[0];
            if let Some(turn) = self.now.turn() {
                // The shorter way round.
                right -= (right / turn).round() * turn;
            }
            // Rows of the raster count downwards.
            (vectors[2 * end], vectors[2 * end + 1]) = (sign * right, sign * (here[1] - there[1]));
        }
        vectors
    }
}

/// Where a camera sees a point through the middle of its lens.
fn place(camera: &CameraTable, point: [f32; 3]) -> Option<[f32; 2]> {
    let seen = camera.importance(One, Vec3::splat(One, point), [One.f(0.5); 2]);
    seen.valid.any().then(|| seen.raster.map(|x| x.0))
}

/// Where what is seen is at the ends of the motion.
#[derive(Clone, Debug, Default)]
pub struct NeighbourFrames {
    /// By instance, the maps of those that move or change their form; empty where none does.
    pub placements: Vec<Option<NeighbourMaps>>,
    /// By geometry, the first number in `displacements` of one that changes its form, and the points that it has.
    pub forms: Vec<Option<(usize, usize)>>,
    /// Of geometry that changes its form, how far each point is off at the frame before, then at the next one; object space.
    pub displacements: Vec<f32>,
}

/// Maps of an instance that moves.
#[derive(Clone, Debug)]
pub struct NeighbourMaps {
    /// World to object at the frame.
    pub to_object: Rows,
    /// Object to world at the frame before and at the next one.
    pub to_world: [Rows; 2],
}

/// A hit, as far as its way depends on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved {
    pub(crate) instance: u32,
    pub(crate) geometry: u32,
    /// Corners, or ends of a piece of a curve, as numbers of the geometry's own points, with their weights.
    pub(crate) points: [u32; 3],
    pub(crate) weights: [f32; 3],
    /// World space.
    pub(crate) position: [f32; 3],
}

impl NeighbourFrames {
    /// The motion vectors of a hit.
    #[inline(never)]
    pub(crate) fn vectors(&self, cameras: &MotionCameras, hit: &Moved) -> [f32; 4] {
        let Some(Some(maps)) = self.placements.get(hit.instance as usize) else {
            return cameras.vectors(hit.position, [hit.position; 2]);
        };
        let local = image(&maps.to_object, hit.position.map(f64::from));
        let mut ends = [hit.position; 2];
        for (end, place) in ends.iter_mut().enumerate() {
            let off = self.displacement(hit, end);
            *place = image(&maps.to_world[end], [local[0] + off[0], local[1] + off[1], local[2] + off[2]]).map(|x| x as f32);
        }
        cameras.vectors(hit.position, ends)
    }

    /// How far the geometry's change of form takes a hit at one of the ends, object space.
    fn displacement(&self, hit: &Moved, end: usize) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let Some(Some((first, points))) = self.forms.get(hit.geometry as usize) else { return sum };
        for (point, weight) in hit.points.iter().zip(hit.weights) {
            let at = first + 3 * (end * points + *point as usize);
            let off = self.displacements.get(at..at + 3).unwrap_or(&[0.0; 3]);
            for (sum, off) in sum.iter_mut().zip(off) {
                *sum += f64::from(weight) * f64::from(*off);
            }
        }
        sum
    }
}

fn image(map: &Rows, p: [f64; 3]) -> [f64; 3] {
    map.map(|[x, y, z, place]| x * p[0] + y * p[1] + z * p[2] + place)
}
