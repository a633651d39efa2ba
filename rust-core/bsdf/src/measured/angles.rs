//! Angles of directions on lanes.

use crate::turn::turned as in_turned_frame;
use core::f32::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};
use gonio_simd::{F, Lanes, Vec3};

/// The angle from the normal of a unit vector, radians. Half a chord's arcsine keeps its precision near the normal, where the arccosine
/// loses half the digits.
#[inline(always)]
pub(super) fn elevation<L: Lanes>(d: Vec3<L>) -> F<L> {
    let below = d.z - 1.0;
    let chord = d.x.mul_add(d.x, d.y.mul_add(d.y, below * below)).sqrt();
    (chord * 0.5).min(1.0).asin() * 2.0
}

/// The distance from the normal's axis: the sine of the elevation of a unit vector.
#[inline(always)]
pub(super) fn sine<L: Lanes>(d: Vec3<L>) -> F<L> {
    d.x.mul_add(d.x, d.y * d.y).sqrt()
}

/// Cosine and sine of the azimuth; 1 and 0 on the axis.
#[inline(always)]
pub(super) fn azimuth<L: Lanes>(d: Vec3<L>) -> [F<L>; 2] {
    let sine = sine(d);
    let off = sine.gt(0.0);
    let scale = sine.max(1e-30).recip();
    [off.select(d.x * scale, d.x.lanes().f(1.0)), (d.y * scale).keep_if(off)]
}

/// `d` turned about the normal by minus an azimuth of this cosine and sine.
#[inline(always)]
pub(super) fn unturned<L: Lanes>(d: Vec3<L>, azimuth: [F<L>; 2]) -> Vec3<L> {
    in_turned_frame(d, Some(azimuth))
}

/// [`unturned`] undone.
#[inline(always)]
pub(super) fn turned<L: Lanes>(d: Vec3<L>, [cos, sin]: [F<L>; 2]) -> Vec3<L> {
    unturned(d, [cos, -sin])
}

/// The place in the unit square of a normal: `u = √(2θ/π)`, `v = (φ + π)/2π` (Dupuy and Jakob 2018).
#[inline(always)]
pub(super) fn square_of<L: Lanes>(normal: Vec3<L>) -> [F<L>; 2] {
    let turn = normal.y.atan2(normal.x) * TAU.recip() + 0.5;
    [(elevation(normal) * FRAC_2_PI).sqrt(), turn.saturate()]
}

/// The normal at a place in the unit square: [`square_of`] undone.
#[inline(always)]
pub(super) fn normal_of<L: Lanes>(square: [F<L>; 2]) -> Vec3<L> {
    let (sin, cos) = (square[0] * square[0] * FRAC_PI_2).sin_cos();
    // Half a turn back and a whole turn around are the same direction.
    let (across, along) = (square[1] - 0.5).sin_cos_turns();
    Vec3::new(sin * along, sin * across, cos)
}

/// Solid angle of normals for an area of the unit square: `2π² u sin θ`.
#[inline(always)]
pub(super) fn solid_angle_per_square<L: Lanes>(u: F<L>, sine: F<L>) -> F<L> {
    u * sine * (2.0 * PI * PI)
}

/// `d` on the other side of the surface.
#[inline(always)]
pub(super) fn through<L: Lanes>(d: Vec3<L>) -> Vec3<L> {
    Vec3::new(d.x, d.y, -d.z)
}
