//! Clipping planes of a camera's own space.

use gonio_simd::{F, Lanes, M, Vec3};

/// The part of a ray's limits that lies on a plane's shown side; empty limits end before they begin.
#[inline(always)]
pub(crate) fn within<L: Lanes>(l: L, [a, b, c, d]: [f32; 4], start: Vec3<L>, direction: Vec3<L>, [near, far]: [F<L>; 2]) -> [F<L>; 2] {
    let normal = Vec3::splat(l, [a, b, c]);
    let (slope, height) = (normal.dot(direction), normal.dot(start) + d);
    let crossing = -height / slope;
    let (enters, leaves) = (slope.gt(0.0), slope.lt(0.0));
    // Rays along the plane lie on one side of it.
    let hidden = height.lt(0.0) & !(enters | leaves);
    let near = enters.select(near.max(crossing), near);
    let far = leaves.select(far.min(crossing), far);
    [near, hidden.select(l.f(-1.0), far)]
}

/// Whether a point lies on a plane's shown side.
#[inline(always)]
pub(crate) fn shows<L: Lanes>(l: L, [a, b, c, d]: [f32; 4], point: Vec3<L>) -> M<L> {
    (Vec3::splat(l, [a, b, c]).dot(point) + d).ge(0.0)
}
