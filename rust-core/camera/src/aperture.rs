//! The opening of the lens: round or a regular polygon, squeezed by anamorphic lenses.

use gonio_simd::{F, Lanes};
use std::f32::consts::{FRAC_PI_4, PI};

/// The form of a lens opening of radius 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aperture {
    /// Corners of the polygon; fewer than 3 make a disk.
    pub blades: u32,
    /// Turn of the polygon against the clock as the camera looks, radians; at 0 the middle of an edge lies on +x.
    pub rotation: f32,
    /// Factor on the opening's width: the reciprocal of the anamorphic ratio.
    pub width: f32,
}

impl Default for Aperture {
    fn default() -> Self {
        Self { blades: 0, rotation: 0.0, width: 1.0 }
    }
}

impl Aperture {
    /// A uniform point of the opening.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, u: [F<L>; 2]) -> [F<L>; 2] {
        let [x, y] = if self.blades < 3 { concentric_disk(u) } else { regular_polygon(u, self.blades, self.rotation) };
        [x * self.width, y]
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

/// Uniform points of the regular polygon with corners on the unit circle, an edge's middle at `rotation` from +x: one of its triangles about the
/// centre by the first number, a point of it by what is left of that and the second.
#[inline(always)]
pub fn regular_polygon<L: Lanes>(u: [F<L>; 2], corners: u32, rotation: f32) -> [F<L>; 2] {
    let count = corners as f32;
    let place = u[0] * count;
    let triangle = place.floor().min(count - 1.0);
    let reach = (place - triangle).saturate().sqrt();
    let half_angle = PI / count;
    let (along, across) = (reach * half_angle.cos(), reach * (u[1] * 2.0 - 1.0) * half_angle.sin());
    let (sine, cosine) = triangle.mul_add(2.0 * half_angle, rotation).sin_cos();
    [along * cosine - across * sine, along * sine + across * cosine]
}
