//! Camera rays on lanes: perspective with a thin lens, and orthographic.

use gonio_simd::{F, Lanes, Vec3};
use std::f32::consts::{FRAC_PI_4, PI};

/// A camera laid out for ray generation: an affine map from raster position to the image plane.
///
/// World space is the rebased one of the compiled scene, metres.
#[derive(Clone, Debug)]
pub struct CameraTable {
    /// Axes x, y, z (z points backwards) and position, world space; the axes are unit for perspective cameras.
    pub axes: [[f32; 3]; 3],
    /// Position, world space.
    pub position: [f32; 3],
    /// Plane coordinates of the raster's top left corner: at distance 1 for perspective, in metres for orthographic.
    pub corner: [f32; 2],
    /// Plane coordinates of a pixel's step to the right and down.
    pub pixel: [f32; 2],
    /// Parallel rays.
    pub orthographic: bool,
    /// Lens radius in metres.
    pub lens_radius: f32,
    /// Distance along the axis of what is sharp, metres.
    pub focus_distance: f32,
    /// Limits along the axis, metres.
    pub clipping: [f32; 2],
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
    /// Radians (perspective) between neighbouring pixels' rays.
    pub spread: F<L>,
    /// Width of a pixel at the ray's start, metres; zero for perspective.
    pub width: F<L>,
    /// Cosine to the camera's axis: depth along the axis is distance times this.
    pub cosine: F<L>,
}

impl CameraTable {
    /// The ray through a raster position (pixels from the top left corner), `lens` in the unit square.
    #[inline(always)]
    pub fn ray<L: Lanes>(&self, l: L, raster: [F<L>; 2], lens: [F<L>; 2]) -> CameraRay<L> {
        let x = raster[0].mul_add(self.pixel[0], self.corner[0]);
        let y = raster[1].mul_add(-self.pixel[1], self.corner[1]);
        let [ax, ay, az] = [0, 1, 2].map(|i| Vec3::splat(l, self.axes[i]));
        let position = Vec3::splat(l, self.position);
        let (start, through) = if self.orthographic {
            (Vec3::new(x, y, l.f(0.0)), Vec3::new(x, y, l.f(-self.focus_distance)))
        } else {
            let d = l.f(self.focus_distance);
            (Vec3::splat(l, [0.0; 3]), Vec3::new(x * d, y * d, -d))
        };
        let start = if self.lens_radius > 0.0 {
            let [u, v] = concentric_disk(lens);
            start + Vec3::new(u * self.lens_radius, v * self.lens_radius, l.f(0.0))
        } else {
            start
        };
        let local = (through - start).normalize();
        let cosine = -local.z;
        CameraRay {
            origin: position + start.transform([ax, ay, az]),
            direction: local.transform([ax, ay, az]).normalize(),
            t_min: l.f(self.clipping[0]) / cosine,
            t_max: (l.f(self.clipping[1]) / cosine).min(f32::MAX),
            spread: l.f(if self.orthographic { 0.0 } else { self.pixel[1] }) * cosine * cosine,
            width: l.f(if self.orthographic { self.pixel[1] } else { 0.0 }),
            cosine,
        }
    }
}

/// Uniform points of the unit disk (Shirley and Chiu, 1997).
#[inline(always)]
pub fn concentric_disk<L: Lanes>(u: [F<L>; 2]) -> [F<L>; 2] {
    let [a, b] = [u[0].mul_add(2.0, -1.0), u[1].mul_add(2.0, -1.0)];
    let wide = a.abs().gt(b.abs());
    let radius = wide.select(a, b);
    let l = a.lanes();
    let ratio = wide.select(b, a) / radius.eq(0.0).select(l.f(1.0), radius);
    let angle = wide.select(ratio * FRAC_PI_4, l.f(PI * 0.5) - ratio * FRAC_PI_4);
    let (sin, cos) = angle.sin_cos();
    [radius * cos, radius * sin]
}
