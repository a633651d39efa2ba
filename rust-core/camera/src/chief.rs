//! Panoramas with a wide lens: the middle ray of the pencil that has a ray through a place of the opening to a point.

use crate::panorama::opening;
use gonio_simd::{F, Lanes, M, Vec3};
use std::f32::consts::{PI, TAU};

/// A pencil's middle, in the camera's own space.
pub(crate) struct Chief<L: Lanes> {
    /// Unit direction of the middle ray, by which the raster position goes.
    pub direction: Vec3<L>,
    /// Where on the opening the ray to the point starts.
    pub start: Vec3<L>,
    /// Solid angle of middle rays for an area across the ray at the point.
    pub density: F<L>,
    pub found: M<L>,
}

/// Through the middle of the lens.
#[inline(always)]
pub(crate) fn through_middle<L: Lanes>(l: L, point: Vec3<L>) -> Chief<L> {
    let squared = point.length_squared();
    Chief {
        direction: point * squared.inverse_root(),
        start: Vec3::splat(l, [0.0; 3]),
        density: squared.recip(),
        found: squared.gt(0.0) & squared.is_finite(),
    }
}

/// Through the place (`a`, `b`) of the opening, in metres. Points nearer to the middle than that place, which two pencils of opposite sides see,
/// are not found.
///
/// With the middle ray ω at the angle θ from the axis Z, and opening axes X towards Z and Y, the point is A X + B Y + C ω. Its distance from the
/// camera gives A, B and C. Its height over the middle, A sin θ + C cos θ, gives θ; there may be none or two, nearer to the axis than the lens
/// is wide. Moving ω over dω moves the point over (p · d) P / sin θ dω across the ray d, where P = C sin θ − A cos θ.
#[inline(always)]
pub(crate) fn chief_ray<L: Lanes>(l: L, point: Vec3<L>, [a, b]: [F<L>; 2], focus: f32, second: M<L>) -> Chief<L> {
    let (squared, reach) = (point.length_squared(), a * a + b * b);
    let away = focus.recip();
    let widening = 1.0 + reach * (away * away);
    let root = (squared * widening - reach).safe_sqrt();
    let c = reach.mul_add(away, root) / widening;
    let rest = 1.0 - c * away;
    let (lean, side) = (rest * a, rest * b);
    let aside = point.x * point.x + point.y * point.y;
    let across_squared = aside - side * side;
    let across = across_squared.safe_sqrt();
    let (turned, angle) = (lean.atan2(c), across.atan2(-point.z));
    let middle = reach.le(0.0);
    let (beyond, before) = (turned + angle, turned - angle);
    let before = before.lt(0.0).select(before + TAU, before);
    let (has_beyond, has_before) = (beyond.ge(0.0) & beyond.le(PI), before.le(PI) & !middle);
    let both = has_beyond & has_before;
    let takes_before = has_before & (second | !has_beyond);
    let (sine, cosine) = takes_before.select(before, beyond).sin_cos();
    let signed = takes_before.select(-across, across);
    let over = aside.gt(0.0).select(aside, l.f(1.0)).recip() * sine;
    let direction = Vec3::new((signed * point.x + side * point.y) * over, (signed * point.y - side * point.x) * over, -cosine).normalize();
    let [x, y] = opening(l, direction);
    let leverage = middle.select(squared.inverse_root(), sine / across);
    let clear = across_squared.gt(0.0) | middle;
    Chief {
        direction,
        start: x * a + y * b,
        density: both.select(l.f(2.0), l.f(1.0)) * leverage * widening.sqrt() / root,
        found: (has_beyond | has_before) & clear & squared.gt(reach) & squared.is_finite(),
    }
}
