//! Camera rays on lanes and what cameras receive: perspective and parallel projections, panoramas, and the lens.

mod aperture;
mod chief;
mod filter;
mod importance;
mod moving;
mod panorama;
mod planes;
pub mod sampler;
#[cfg(test)]
mod tests;

pub use aperture::{Aperture, concentric_disk, regular_polygon};
pub use filter::{FilterTable, KNOTS, Placement};
pub use importance::Seen;

use gonio_simd::motion::Motion;
use gonio_simd::{F, Lanes, M, Vec3};
use panorama::{equidistant, equirectangular, equisolid};
use std::sync::Arc;

/// What a position on the image plane means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// The direction through a point of the plane at distance 1.
    Perspective,
    /// Parallel rays; the plane is in metres.
    Orthographic,
    /// x is the longitude (0 ahead, growing to the right), y the latitude, in radians.
    Equirectangular,
    /// The distance from the middle is the angle to the axis in radians, up to `limit`.
    Equidistant {
        /// Half the field of view.
        limit: f32,
    },
    /// The distance from the middle is the sine of half the angle to the axis, up to `limit`.
    Equisolid {
        /// Sine of a quarter of the field of view.
        limit: f32,
    },
}

/// A camera laid out for ray generation: an affine map from raster position to the image plane.
///
/// World space is the rebased one of the compiled scene, metres.
#[derive(Clone, Debug)]
pub struct CameraTable {
    /// Unit axes x, y, z (z points backwards), world space.
    pub axes: [[f32; 3]; 3],
    /// Position, world space.
    pub position: [f32; 3],
    /// Plane coordinates of the raster's top left corner.
    pub corner: [f32; 2],
    /// Plane coordinates of a pixel's step to the right and down (the latter counted upwards).
    pub pixel: [f32; 2],
    /// What plane coordinates mean.
    pub lens: Lens,
    /// Lens radius in metres.
    pub lens_radius: f32,
    /// The lens opening's form.
    pub aperture: Aperture,
    /// Distance of what is sharp in metres: along the axis, or around the camera for panoramas.
    pub focus_distance: f32,
    /// Planes in the camera's own space: what lies where the plane's `a x + b y + c z + d` is below zero is not seen.
    pub planes: Vec<[f32; 4]>,
    /// Limits in metres: along the axis, or around the camera for panoramas.
    pub clipping: [f32; 2],
    /// How it moves while the shutter is open; `axes` and `position` are where it rests.
    pub motion: Option<Arc<Motion>>,
    /// What its middle stands in.
    pub surroundings: Surroundings,
}

/// What a place stands in: glass, water, resin, or the open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// Names of the media that fill it, as paths carry them.
    pub media: [u32; 2],
    /// Absorption a metre of the solid about it, R, G, B.
    pub absorption: [f32; 3],
    /// How often a metre that makes its colour of white: one over the depth at which it has it; 0 where no solid absorbs.
    pub tints: f32,
    /// Squared index of refraction: what paths carry is radiance over it.
    pub squared_index: f32,
}

impl Surroundings {
    /// Air, which takes nothing away.
    pub const OPEN: Self = Self { media: [0; 2], absorption: [0.0; 3], tints: 0.0, squared_index: 1.0 };
}

/// A ray for each lane.
#[derive(Clone, Copy, Debug)]
pub struct CameraRay<L: Lanes> {
    /// Where it starts, world space.
    pub origin: Vec3<L>,
    /// Unit direction.
    pub direction: Vec3<L>,
    /// Nearest distance that counts.
    pub t_min: F<L>,
    /// Farthest distance that counts.
    pub t_max: F<L>,
    /// Radians between neighbouring pixels' rays; zero for parallel ones.
    pub spread: F<L>,
    /// Width of a pixel at the ray's start in metres; zero for all but parallel ones.
    pub width: F<L>,
    /// Whether the lens maps the raster position at all; where it does not, nothing is seen and the ray is not to be traced.
    pub mapped: M<L>,
}

/// A ray in the camera's own space before the lens.
struct Aimed<L: Lanes> {
    start: Vec3<L>,
    /// What is sharp on this ray.
    through: Vec3<L>,
    /// Directions of the opening's x and y.
    opening: [Vec3<L>; 2],
    mapped: M<L>,
}

impl CameraTable {
    /// The ray through a raster position (pixels from the top left corner), `lens` in the unit square.
    #[inline(always)]
    pub fn ray<L: Lanes>(&self, l: L, raster: [F<L>; 2], lens: [F<L>; 2]) -> CameraRay<L> {
        let axes = [Vec3::splat(l, self.axes[0]), Vec3::splat(l, self.axes[1]), Vec3::splat(l, self.axes[2])];
        self.ray_from(l, raster, lens, axes, Vec3::splat(l, self.position))
    }

    /// The same for a camera with these axes at this position.
    #[inline(always)]
    fn ray_from<L: Lanes>(&self, l: L, raster: [F<L>; 2], lens: [F<L>; 2], axes: [Vec3<L>; 3], position: Vec3<L>) -> CameraRay<L> {
        let x = raster[0].mul_add(self.pixel[0], self.corner[0]);
        let y = raster[1].mul_add(-self.pixel[1], self.corner[1]);
        let aimed = self.aim(l, x, y);
        let mut start = aimed.start;
        if self.lens_radius > 0.0 {
            let [u, v] = self.aperture.sample(lens);
            start = start + aimed.opening[0] * (u * self.lens_radius) + aimed.opening[1] * (v * self.lens_radius);
        }
        let local = (aimed.through - start).normalize();
        let parallel = self.lens == Lens::Orthographic;
        let flat = parallel || self.lens == Lens::Perspective;
        let along = if flat { -local.z } else { l.f(1.0) };
        let pixel = self.pixel[1].abs();
        // Aside of the axis pixels are seen from farther off and aslant, by either side: the mean of the two angles, as Cycles has it.
        let sides = [x.mul_add(x, 1.0).sqrt(), y.mul_add(y, 1.0).sqrt()];
        let aslant = if self.lens == Lens::Perspective { (sides[0] + sides[1]) * 0.5 } else { l.f(1.0) };
        let mut limits = [l.f(self.clipping[0]) / along, (l.f(self.clipping[1]) / along).min(f32::MAX)];
        for plane in &self.planes {
            limits = planes::within(l, *plane, start, local, limits);
        }
        CameraRay {
            origin: position + start.transform(axes),
            direction: local.transform(axes).normalize(),
            t_min: limits[0],
            t_max: limits[1],
            spread: l.f(if parallel { 0.0 } else { pixel * self.angle_per_step() }) * along * along * aslant,
            width: l.f(if parallel { pixel } else { 0.0 }),
            mapped: aimed.mapped,
        }
    }

    /// The ray of a pinhole through a point of the image plane.
    #[inline(always)]
    fn aim<L: Lanes>(&self, l: L, x: F<L>, y: F<L>) -> Aimed<L> {
        let centre = Vec3::splat(l, [0.0; 3]);
        let opening = [Vec3::splat(l, [1.0, 0.0, 0.0]), Vec3::splat(l, [0.0, 1.0, 0.0])];
        let d = l.f(self.focus_distance);
        let flat = |start, through| Aimed { start, through, opening, mapped: l.m(true) };
        let (direction, mapped) = match self.lens {
            Lens::Perspective => return flat(centre, Vec3::new(x * d, y * d, -d)),
            Lens::Orthographic => return flat(Vec3::new(x, y, l.f(0.0)), Vec3::new(x, y, -d)),
            Lens::Equirectangular => (equirectangular(x, y), l.m(true)),
            Lens::Equidistant { limit } => equidistant(x, y, limit),
            Lens::Equisolid { limit } => equisolid(x, y, limit),
        };
        Aimed { start: centre, through: direction * d, opening: panorama::opening(l, direction), mapped }
    }

    /// Radians for a step on the plane, in the middle of the picture.
    fn angle_per_step(&self) -> f32 {
        if matches!(self.lens, Lens::Equisolid { .. }) { 2.0 } else { 1.0 }
    }
}
