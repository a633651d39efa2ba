//! Cameras that receive: where a point is seen and how much light that arrives there counts. The inverse of ray generation.

use crate::chief::chief_ray;
use crate::{CameraTable, Lens, panorama, planes};
use gonio_simd::{F, Lanes, M, One, Vec3};
use std::f32::consts::TAU;

#[cfg(test)]
mod closed_forms;
#[cfg(test)]
mod tests;

/// How a camera sees a point. Where it does not, all numbers are finite and the importance is zero.
#[derive(Clone, Copy, Debug)]
pub struct Seen<L: Lanes> {
    /// Where in the raster, in pixels, as [`CameraTable::ray`] takes it. It may lie outside the picture.
    pub raster: [F<L>; 2],
    /// The point on the lens, world space.
    pub origin: Vec3<L>,
    /// Unit direction from the lens to the point.
    pub direction: Vec3<L>,
    /// Metres from the lens to the point.
    pub distance: F<L>,
    /// Raster area in square pixels for a square metre across the ray at the point. What a surface sends here in candelas, times this, is what it
    /// adds to the radiance of a pixel of area 1.
    pub importance: F<L>,
    /// Whether a ray of the camera through this place of the lens meets the point within the clipping limits.
    pub valid: M<L>,
}

/// A point as the lens maps it, in the camera's own space.
struct Mapped<L: Lanes> {
    /// Coordinates on the image plane.
    plane: [F<L>; 2],
    /// The point on the lens.
    start: Vec3<L>,
    /// From there to the point.
    path: Vec3<L>,
    /// Area of the image plane for an area across the ray at the point.
    density: F<L>,
    mapped: M<L>,
}

impl CameraTable {
    /// Width of a pixel about a point that the camera may see, metres.
    pub fn pixel_width(&self, point: [f32; 3]) -> Option<f32> {
        let seen = self.importance(One, Vec3::splat(One, point), [One.f(0.5); 2]);
        (seen.valid.any() && seen.importance.0 > 0.0).then(|| seen.importance.0.sqrt().recip())
    }

    /// How the camera sees a point through a place of the lens that `lens` in the unit square stands for, as in [`CameraTable::ray`].
    ///
    /// A pixel's radiance is the mean over the raster and the lens of the radiance along camera rays. For a fixed place of the lens a raster
    /// area dR sees the area dA across the ray at the point, so the point's light counts by dR / dA.
    #[inline(always)]
    pub fn importance<L: Lanes>(&self, l: L, point: Vec3<L>, lens: [F<L>; 2]) -> Seen<L> {
        let (inverse, volume) = inverse(self.axes);
        let columns = |m: [[f32; 3]; 3]| [Vec3::splat(l, m[0]), Vec3::splat(l, m[1]), Vec3::splat(l, m[2])];
        self.importance_from(l, point, lens, (columns(self.axes), columns(inverse), l.f(volume)), Vec3::splat(l, self.position))
    }

    /// The same for a camera with these axes, their inverse and their volume, at this position.
    #[inline(always)]
    pub(crate) fn importance_from<L: Lanes>(
        &self,
        l: L,
        point: Vec3<L>,
        lens: [F<L>; 2],
        (axes, inverse, volume): ([Vec3<L>; 3], [Vec3<L>; 3], F<L>),
        position: Vec3<L>,
    ) -> Seen<L> {
        let local = (point - position).transform(inverse);
        let found = match self.lens {
            Lens::Perspective => self.perspective(local, self.opening(l, lens)),
            Lens::Orthographic => self.parallel(local, self.opening(l, lens)),
            _ => self.around(l, local, lens),
        };
        let path = found.path.transform(axes);
        let (squared, local_length) = (path.length_squared(), found.path.length());
        let distance = squared.sqrt();
        let flat = self.lens == Lens::Orthographic || self.lens == Lens::Perspective;
        // Axes of sheared cameras are not square to each other: areas and lengths differ between the two spaces.
        let stretch = distance / local_length;
        let depth = if flat { -found.path.z * stretch } else { distance };
        let importance = found.density * stretch * (volume * (self.pixel[0] * self.pixel[1])).abs().recip();
        let [x, y] = self.raster(found.plane);
        let mut inside = depth.gt(0.0) & depth.ge(self.clipping[0]) & depth.le(self.clipping[1]);
        for plane in &self.planes {
            inside &= planes::shows(l, *plane, local);
        }
        let finite = importance.is_finite() & x.is_finite() & y.is_finite() & squared.is_finite();
        let valid = found.mapped & inside & finite & importance.gt(0.0);
        Seen {
            raster: [x.keep_if(valid), y.keep_if(valid)],
            origin: valid.select(position + found.start.transform(axes), position),
            direction: valid.select(path * squared.inverse_root(), -axes[2]),
            distance: distance.keep_if(valid),
            importance: importance.keep_if(valid),
            valid,
        }
    }

    /// Pixels of a full turn: places of the raster that far apart to the side see the same. None but latitude and longitude repeat themselves.
    /// A point's place is the one from 0 up to a turn.
    pub fn turn(&self) -> Option<f32> {
        (self.lens == Lens::Equirectangular).then(|| TAU / self.pixel[0].abs())
    }

    /// The place of the raster that has these coordinates on the image plane.
    #[inline(always)]
    fn raster<L: Lanes>(&self, [x, y]: [F<L>; 2]) -> [F<L>; 2] {
        let right = (x - self.corner[0]) / self.pixel[0];
        let down = (self.corner[1] - y) / self.pixel[1];
        let Some(turn) = self.turn() else { return [right, down] };
        [right - (right / turn).floor() * turn, down]
    }

    /// The place on the opening in metres.
    #[inline(always)]
    fn opening<L: Lanes>(&self, l: L, lens: [F<L>; 2]) -> [F<L>; 2] {
        if self.lens_radius <= 0.0 {
            return [l.f(0.0); 2];
        }
        let [u, v] = self.aperture.sample(lens);
        [u * self.lens_radius, v * self.lens_radius]
    }

    /// Through a point of the lens to the plane in focus: dω = cos³ dx dy.
    #[inline(always)]
    fn perspective<L: Lanes>(&self, point: Vec3<L>, [a, b]: [F<L>; 2]) -> Mapped<L> {
        let depth = -point.z;
        let mapped = depth.gt(0.0);
        let path = Vec3::new(point.x - a, point.y - b, point.z);
        let nearer = depth.recip();
        let focus = self.focus_distance.recip();
        Mapped {
            plane: [path.x.mul_add(nearer, a * focus), path.y.mul_add(nearer, b * focus)],
            start: Vec3::new(a, b, a.lanes().f(0.0)),
            path,
            density: path.length() * nearer * nearer * nearer,
            mapped,
        }
    }

    /// All rays through a place of the opening are parallel.
    #[inline(always)]
    fn parallel<L: Lanes>(&self, point: Vec3<L>, [a, b]: [F<L>; 2]) -> Mapped<L> {
        let depth = -point.z;
        let share = depth * self.focus_distance.recip();
        let path = Vec3::new(-(a * share), -(b * share), point.z);
        let start = Vec3::new(point.x - path.x, point.y - path.y, a.lanes().f(0.0));
        Mapped { plane: [start.x - a, start.y - b], start, path, density: path.length() / depth, mapped: depth.gt(0.0) }
    }

    /// Panoramas: the opening lies across every ray.
    #[inline(always)]
    fn around<L: Lanes>(&self, l: L, point: Vec3<L>, lens: [F<L>; 2]) -> Mapped<L> {
        let chief = if self.lens_radius > 0.0 {
            // With two rays through this place of the lens to the point, one of them stands for both; digits too fine to matter choose it.
            let fine = lens[0] * 32768.0;
            chief_ray(l, point, self.opening(l, lens), self.focus_distance, (fine - fine.floor()).ge(0.5))
        } else {
            crate::chief::through_middle(l, point)
        };
        let (plane, spread, mapped) = match self.lens {
            Lens::Equidistant { limit } => panorama::equidistant_place(chief.direction, limit),
            Lens::Equisolid { limit } => panorama::equisolid_place(chief.direction, limit),
            _ => panorama::equirectangular_place(chief.direction),
        };
        Mapped { plane, start: chief.start, path: point - chief.start, density: spread * chief.density, mapped: chief.found & mapped }
    }
}

/// The inverse of a matrix of columns, and its determinant; nothing but zeros where it has none.
#[inline(always)]
fn inverse(columns: [[f32; 3]; 3]) -> ([[f32; 3]; 3], f32) {
    let [a, b, c] = columns;
    let [r, s, t] = [cross(b, c), cross(c, a), cross(a, b)];
    let volume = a[0] * r[0] + a[1] * r[1] + a[2] * r[2];
    let over = if volume == 0.0 { 0.0 } else { volume.recip() };
    let column = |k: usize| [r[k] * over, s[k] * over, t[k] * over];
    ([column(0), column(1), column(2)], volume)
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
