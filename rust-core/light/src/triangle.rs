//! Triangles, sampled by solid angle: a great circle through the first corner cuts off a share of it, and a point is drawn on the arc from the second
//! corner to that circle (Arvo, Stratified Sampling of Spherical Triangles, SIGGRAPH 1995). Tangents of half the solid angle take the place of the
//! paper's angles, as in Peters, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), 2021, so that little cancels and no arc is computed.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use super::solid_angle::{BY_AREA_BELOW, SolidAngle};
use gonio_simd::{F, Lanes, M, Vec3};

/// Triangles of emitting meshes.
pub(crate) struct Triangle;

/// The triangle as seen from a point.
struct Seen<L: Lanes> {
    /// To its corners, and the reciprocals of their distances.
    corners: [Vec3<L>; 3],
    inverse: [F<L>; 3],
    /// A normal, as long as twice its area, and the volume that it spans with the corners.
    normal: Vec3<L>,
    volume: F<L>,
    angle: SolidAngle<L>,
}

impl<L: Lanes> Seen<L> {
    #[inline(always)]
    fn new(light: &Reader<'_, L>, from: Vec3<L>) -> Self {
        let [x, y, _] = light.frame();
        let a = light.vector(field::ORIGIN) - from;
        let (b, c) = (a + x, a + y);
        let normal = x.cross(y);
        let volume = normal.dot(a).abs();
        let inverse = [a.length_squared().inverse_root(), b.length_squared().inverse_root(), c.length_squared().inverse_root()];
        Self { corners: [a, b, c], inverse, normal, volume, angle: SolidAngle::new(volume, [a, b, c], inverse) }
    }
    #[inline(always)]
    fn by_area(&self) -> M<L> {
        self.angle.value.lt(BY_AREA_BELOW)
    }
    /// Density per solid angle towards a point at such a distance, where points are drawn by area.
    #[inline(always)]
    fn density_by_area(&self, distance: F<L>) -> F<L> {
        distance * distance * distance * 2.0 / self.volume
    }
    /// A point, uniform over the area.
    #[inline(always)]
    fn aim_by_area(&self, [x, y]: [Vec3<L>; 2], u: [F<L>; 2]) -> Aim<L> {
        // Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
        let upper = u[0].lt(u[1]);
        let (small, large) = (u[0].min(u[1]) * 0.5, u[0].max(u[1]));
        let (a, b) = (upper.select(small, large - small), upper.select(large - small, small));
        let aim = Aim::towards(y.mul_add(b, x.mul_add(a, self.corners[0])));
        Aim { pdf: self.density_by_area(aim.distance), ..aim }
    }
    /// A direction, uniform over the solid angle.
    #[inline(always)]
    fn aim(&self, u: [F<L>; 2]) -> Aim<L> {
        let ([a, b, c], [ia, ib, ic], [ab, ac, bc]) = (self.corners, self.inverse, self.angle.cosines);
        let (a, b, c) = (a * ia, b * ib, c * ic);
        // The share cut off by a corner on the circle of a and c, where a mirrored at x a + y c ends: the tangent of its half is
        // y det(a, b, c) / (x (1 + a·b) + y (a + b)·c).
        let (sine, cosine) = (self.angle.value * u[0] * 0.5).sin_cos();
        let (x, y) = (self.angle.determinant * cosine - (ac + bc) * sine, (ab + 1.0) * sine);
        let scale = (x * x + y * (y + x * ac * 2.0)).recip();
        let corner = a * ((x - y) * (x + y) * scale) + c * (y * (x + y * ac) * (scale * 2.0));
        // 1 − cos of the arc and of its part, which keep their digits where it is short.
        let arc = (corner - b).length_squared() * 0.5;
        let part = arc * u[1];
        let share = (u[1] * (2.0 - part) / (2.0 - arc).max(f32::MIN_POSITIVE)).safe_sqrt();
        let wi = corner * share + b * (1.0 - part - share * (1.0 - arc));
        let zero = part.lanes().f(0.0);
        Aim { wi, distance: self.volume / self.normal.dot(wi).abs(), pdf: self.angle.value.recip(), uv: [zero; 2] }
    }
}

impl Emitter for Triangle {
    #[inline(always)]
    fn sample<L: Lanes>(_: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let seen = Seen::new(light, p);
        let by_area = seen.by_area();
        let [x, y, _] = light.frame();
        if by_area.all() {
            return seen.aim_by_area([x, y], u);
        }
        let aim = seen.aim(u);
        if !by_area.any() {
            return aim;
        }
        let near = seen.aim_by_area([x, y], u);
        let wi = by_area.select(near.wi, aim.wi);
        Aim { wi, distance: by_area.select(near.distance, aim.distance), pdf: by_area.select(near.pdf, aim.pdf), ..aim }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, _: Vec3<L>, hit: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let seen = Seen::new(light, from);
        let pdf = seen.by_area().select(seen.density_by_area((hit - from).length()), seen.angle.value.recip());
        (pdf, [l.f(0.0); 2])
    }
}
