//! Directions of panoramas in the camera's own space: x to the right, y up, −z ahead.

use gonio_simd::{F, Lanes, M, Vec3};

/// Sine of the angle to a direction that a whole line of the picture shows, below which a direction has no place in it.
const POLE: f32 = 1e-6;

/// Latitude and longitude.
#[inline(always)]
pub(super) fn equirectangular<L: Lanes>(longitude: F<L>, latitude: F<L>) -> Vec3<L> {
    let (sin_longitude, cos_longitude) = longitude.sin_cos();
    let (height, circle) = latitude.sin_cos();
    Vec3::new(circle * sin_longitude, height, -(circle * cos_longitude))
}

/// θ = r (equidistant fisheye); nothing beyond `limit`.
#[inline(always)]
pub(super) fn equidistant<L: Lanes>(x: F<L>, y: F<L>, limit: f32) -> (Vec3<L>, M<L>) {
    let l = x.lanes();
    let angle = (x * x + y * y).sqrt();
    let (sine, cosine) = angle.sin_cos();
    let off = angle.gt(0.0);
    let ratio = off.select(sine / off.select(angle, l.f(1.0)), l.f(1.0));
    (Vec3::new(x * ratio, y * ratio, -cosine), angle.le(limit))
}

/// sin(θ/2) = r (equisolid-angle fisheye); nothing beyond `limit`.
#[inline(always)]
pub(super) fn equisolid<L: Lanes>(x: F<L>, y: F<L>, limit: f32) -> (Vec3<L>, M<L>) {
    let square = x * x + y * y;
    // sin θ = 2 sin(θ/2) cos(θ/2) and cos θ = 1 − 2 sin²(θ/2).
    let ratio = (1.0 - square).safe_sqrt() * 2.0;
    let mapped = square.le(limit * limit);
    (Vec3::new(x * ratio, y * ratio, square.min(1.0) * 2.0 - 1.0), mapped)
}

/// The directions of the lens opening's x and y for a panorama's ray: across the ray, x leaning towards what lies ahead of the camera.
#[inline(always)]
pub(super) fn opening<L: Lanes>(l: L, direction: Vec3<L>) -> [Vec3<L>; 2] {
    let ahead = Vec3::splat(l, [0.0, 0.0, -1.0]);
    let across = ahead - direction * ahead.dot(direction);
    let squared = across.length_squared();
    let clear = squared.gt(1e-12);
    let x = clear.select(across * squared.max(1e-12).inverse_root(), Vec3::splat(l, [1.0, 0.0, 0.0]));
    [x, direction.cross(x)]
}

/// Longitude and latitude of a unit direction, their area for a solid angle, and whether they are known.
#[inline(always)]
pub(super) fn equirectangular_place<L: Lanes>(direction: Vec3<L>) -> ([F<L>; 2], F<L>, M<L>) {
    let circle = (direction.x * direction.x + direction.z * direction.z).sqrt();
    let mapped = circle.gt(POLE);
    ([direction.x.atan2(-direction.z), direction.y.atan2(circle)], mapped.select(circle, circle.lanes().f(1.0)).recip(), mapped)
}

/// The place of a unit direction in an equidistant fisheye's picture, its area for a solid angle, and whether it is there.
#[inline(always)]
pub(super) fn equidistant_place<L: Lanes>(direction: Vec3<L>, limit: f32) -> ([F<L>; 2], F<L>, M<L>) {
    let sine = (direction.x * direction.x + direction.y * direction.y).sqrt();
    let angle = sine.atan2(-direction.z);
    let off = sine.gt(0.0);
    let one = sine.lanes().f(1.0);
    let ratio = off.select(angle / off.select(sine, one), one);
    ([direction.x * ratio, direction.y * ratio], ratio, angle.le(limit) & (sine.gt(POLE) | direction.z.lt(0.0)))
}

/// The place of a unit direction in an equisolid-angle fisheye's picture, its area for a solid angle, and whether it is there.
#[inline(always)]
pub(super) fn equisolid_place<L: Lanes>(direction: Vec3<L>, limit: f32) -> ([F<L>; 2], F<L>, M<L>) {
    let sine = (direction.x * direction.x + direction.y * direction.y).sqrt();
    let radius = (sine.atan2(-direction.z) * 0.5).sin();
    let off = sine.gt(0.0);
    let l = sine.lanes();
    let ratio = off.select(radius / off.select(sine, l.f(1.0)), l.f(0.5));
    let mapped = radius.le(limit) & (sine.gt(POLE) | direction.z.lt(0.0));
    ([direction.x * ratio, direction.y * ratio], l.f(0.25), mapped)
}
