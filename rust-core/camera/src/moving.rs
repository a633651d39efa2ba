//! Cameras that move while the shutter is open: each ray leaves from where the camera is at its time.

use crate::importance::Seen;
use crate::{CameraRay, CameraTable};
use gonio_simd::motion::Motion;
use gonio_simd::{F, Lanes, PADDING, Vec3};

impl CameraTable {
    /// [`CameraTable::ray`] at times of the shutter, from 0 to 1.
    #[inline(always)]
    pub fn ray_at<L: Lanes>(&self, l: L, raster: [F<L>; 2], lens: [F<L>; 2], time: F<L>) -> CameraRay<L> {
        let Some(motion) = &self.motion else { return self.ray(l, raster, lens) };
        let (axes, position) = placed(l, motion, time);
        self.ray_from(l, raster, lens, axes, position)
    }

    /// [`CameraTable::importance`] at times of the shutter.
    #[inline(always)]
    pub fn importance_at<L: Lanes>(&self, l: L, point: Vec3<L>, lens: [F<L>; 2], time: F<L>) -> Seen<L> {
        let Some(motion) = &self.motion else { return self.importance(l, point, lens) };
        let (axes, position) = placed(l, motion, time);
        let rows = [axes[1].cross(axes[2]), axes[2].cross(axes[0]), axes[0].cross(axes[1])];
        let volume = axes[0].dot(rows[0]);
        let over = volume.recip();
        let inverse = [
            Vec3::new(rows[0].x, rows[1].x, rows[2].x) * over,
            Vec3::new(rows[0].y, rows[1].y, rows[2].y) * over,
            Vec3::new(rows[0].z, rows[1].z, rows[2].z) * over,
        ];
        self.importance_from(l, point, lens, (axes, inverse, volume), position)
    }
}

/// Unit axes and positions of a camera at some times.
#[inline(always)]
fn placed<L: Lanes>(l: L, motion: &Motion, time: F<L>) -> ([Vec3<L>; 3], Vec3<L>) {
    let times = time.to_array();
    let mut numbers = [[0.0; PADDING]; 12];
    for (lane, time) in times.iter().enumerate().take(L::COUNT) {
        for (column, value) in numbers.iter_mut().zip(columns(motion, *time)) {
            column[lane] = value;
        }
    }
    let vector = |at: usize| Vec3::new(l.load(&numbers[at], 0), l.load(&numbers[at + 1], 0), l.load(&numbers[at + 2], 0));
    ([vector(0), vector(3), vector(6)], vector(9))
}

/// Unit axes and the position, one behind the other.
fn columns(motion: &Motion, time: f32) -> [f32; 12] {
    let rows = motion.at(time);
    let mut numbers = [0.0; 12];
    for column in 0..4 {
        let axis = rows.map(|row| row[column]);
        let length = if column < 3 { axis.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE) } else { 1.0 };
        for (place, x) in numbers[3 * column..].iter_mut().zip(axis) {
            *place = (x / length) as f32;
        }
    }
    numbers
}
