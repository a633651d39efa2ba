//! UsdLux's size factors: what `normalize` divides by.

use super::light_kind::LightKind;
use super::vector::{Vector, add, cross, dot, length, principal_axes, scale, unit_or};
use std::f64::consts::{FRAC_PI_2, PI};

/// Thomsen's exponent; at most 1.42 % off.
const ELLIPSOID_EXPONENT: f64 = 1.6;

/// The divisor of a light whose `normalize` is on (UsdLux LightAPI): world-space area for shapes, projected solid angle for distant lights, 1 for domes
/// and points. `axes` are the columns that [`super::LightRecord::to_world`] would have, in stage units; `angle` is a distant light's full angle
/// in radians. 0 for lights without extent.
pub fn size_factor(kind: LightKind, axes: [[f64; 3]; 3], angle: f64) -> f64 {
    let [x, y, _] = axes;
    match kind {
        LightKind::Rectangle => 4.0 * length(cross(x, y)),
        LightKind::Disk => PI * length(cross(x, y)),
        LightKind::Triangle => length(cross(x, y)) / 2.0,
        LightKind::Sphere => ellipsoid_area(principal_axes(axes)),
        LightKind::Cylinder => cylinder_area(axes),
        LightKind::FacingDisk => PI * dot(x, x),
        LightKind::Distant => distant_factor(angle),
        LightKind::Dome | LightKind::Point => 1.0,
    }
}

fn distant_factor(angle: f64) -> f64 {
    let half = (angle / 2.0).clamp(0.0, PI);
    match half {
        half if half <= 0.0 => 1.0,
        half if half <= FRAC_PI_2 => PI * half.sin().powi(2),
        half => PI * (2.0 - half.sin().powi(2)),
    }
}

/// Thomsen's approximation (p = 1.6); exact for spheres.
fn ellipsoid_area([a, b, c]: [f64; 3]) -> f64 {
    let p = ELLIPSOID_EXPONENT;
    4.0 * PI * (((a * b).powf(p) + (a * c).powf(p) + (b * c).powf(p)) / 3.0).powf(1.0 / p)
}

/// Lateral area: the perimeter of the section at right angles to the axis, times the length.
fn cylinder_area([x, y, z]: [Vector; 3]) -> f64 {
    let along = unit_or(x, [0.0; 3]);
    let across = |v: Vector| add(v, scale(along, -dot(v, along)));
    let [a, b, _] = {
        let mut axes = principal_axes([across(y), across(z), [0.0; 3]]);
        axes.sort_by(|p, q| q.total_cmp(p));
        axes
    };
    2.0 * length(x) * ellipse_perimeter(a, b)
}

/// Perimeter of an ellipse by the arithmetic–geometric mean (Gauss), to rounding.
fn ellipse_perimeter(a: f64, b: f64) -> f64 {
    if a <= 0.0 {
        return 0.0;
    }
    let (mut x, mut y) = (a, b);
    let (mut sum, mut power) = (0.5 * (a * a + b * b), 0.5);
    for _ in 0..40 {
        let half_difference = 0.5 * (x - y);
        if y <= 0.0 || half_difference.abs() <= 1e-16 * a {
            break;
        }
        (x, y) = (0.5 * (x + y), (x * y).sqrt());
        power *= 2.0;
        sum -= power * half_difference * half_difference;
    }
    if b <= 0.0 { 4.0 * a } else { 2.0 * PI * sum / x }
}
