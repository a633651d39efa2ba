//! Directions of the shading frame: unit vectors, z along the front's normal, pointing away from the surface.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// A unit vector in the shading frame.
pub type Direction = [f64; 3];

/// The product of lengths and cosine.
pub(crate) fn dot(a: Direction, b: Direction) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
pub(crate) fn cross(a: Direction, b: Direction) -> Direction {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a` and `b` added, each with its factor.
pub(crate) fn combination(s: f64, a: Direction, t: f64, b: Direction) -> Direction {
    [s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]]
}

/// The unit vector along `v`, if `v` has a length.
pub(crate) fn normalized(v: Direction) -> Option<Direction> {
    let length = dot(v, v).sqrt();
    (length > 0.0).then(|| v.map(|x| x / length))
}

/// The angle from the normal, radians. Half a chord's arcsine keeps its precision near the normal, where the arccosine loses half the digits.
pub(crate) fn elevation(d: Direction) -> f64 {
    let chord = (d[0] * d[0] + d[1] * d[1] + (d[2] - 1.0) * (d[2] - 1.0)).sqrt();
    2.0 * (0.5 * chord).min(1.0).asin()
}

/// The angle about the normal from x towards y, radians in (−π, π].
pub(crate) fn azimuth(d: Direction) -> f64 {
    d[1].atan2(d[0])
}

/// The direction at an angle from the normal and one about it, radians.
pub(crate) fn spherical(theta: f64, phi: f64) -> Direction {
    [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
}

/// `d` on the other side of the surface.
pub(crate) fn through(d: Direction) -> Direction {
    [d[0], d[1], -d[2]]
}

/// `d` mirrored at the normal `m`.
pub(crate) fn reflected(d: Direction, m: Direction) -> Direction {
    combination(2.0 * dot(d, m), m, -1.0, d)
}

/// `x` moved by whole periods into `[start, start + period)`.
pub(crate) fn wrapped(x: f64, start: f64, period: f64) -> f64 {
    let rest = (x - start).rem_euclid(period);
    // The remainder of a tiny negative number rounds to the period itself.
    start + if rest < period { rest } else { 0.0 }
}

/// The place in the unit square of a normal's angles, as in Dupuy and Jakob, An Adaptive Parameterization for Efficient Material
/// Acquisition and Rendering (2018): `u = √(2θ/π)`, `v = (φ + π)/2π`.
pub(crate) fn square_of(theta: f64, phi: f64) -> [f64; 2] {
    [(theta / FRAC_PI_2).sqrt(), wrapped((phi + PI) / TAU, 0.0, 1.0)]
}

/// The angles of a normal at a place in the unit square: [`square_of`] undone.
pub(crate) fn angles_of(square: [f64; 2]) -> (f64, f64) {
    (square[0] * square[0] * FRAC_PI_2, (2.0 * square[1] - 1.0) * PI)
}

/// Solid angle of normals for an area of the unit square: `2π² u sin θ`.
pub(crate) fn solid_angle_per_square(u: f64) -> f64 {
    2.0 * PI * PI * u * (u * u * FRAC_PI_2).sin()
}

/// The direction that a place in the unit square gives when directions are spread in proportion to the cosine: equal areas of the square
/// are equal projected solid angles, rings along the first coordinate.
pub(crate) fn cosine_direction(u: [f64; 2]) -> Direction {
    let (radius, phi) = (u[0].sqrt(), TAU * u[1]);
    [radius * phi.cos(), radius * phi.sin(), (1.0 - u[0]).max(0.0).sqrt()]
}
