//! Integrals over the hemisphere.

use super::direction::{
    Direction, angles_of, combination, cosine_direction, dot, elevation, normalized, reflected, solid_angle_per_square, spherical,
    square_of,
};
use core::f64::consts::PI;

/// Strata of the quadrature along each side of the squares.
pub(crate) const STRATA: usize = 160;

/// A direction of a quadrature over the hemisphere, and its solid angle.
pub(crate) struct Node {
    pub(crate) direction: Direction,
    pub(crate) solid_angle: f64,
}

/// A quadrature over the upper hemisphere that follows both the cosine and a lobe about the mirror direction of `up`: the midpoints of two
/// squares, over projected solid angle and over half vectors, weighted with the balance heuristic (Veach 1997).
pub(crate) fn quadrature(up: Direction, strata: usize) -> impl Iterator<Item = Node> {
    let points = (strata * strata) as f64;
    // Rows are shifted by the golden ratio, because the horizon of a steep view runs along columns.
    let square = move |i: usize| {
        let row = i / strata;
        [(i % strata) as f64 + (0.618_034 * row as f64).fract(), row as f64 + 0.5].map(|x| x / strata as f64)
    };
    (0..strata * strata).flat_map(move |i| {
        let (theta, phi) = angles_of(square(i));
        let by_half = reflected(up, spherical(theta, phi));
        [cosine_direction(square(i)), by_half].into_iter().filter(|d| d[2] > 0.0).map(move |direction| {
            let densities = direction[2] / PI + half_vector_density(up, direction);
            Node { direction, solid_angle: 1.0 / (points * densities) }
        })
    })
}

/// The density per solid angle of a direction whose half vector is uniform in the square of normals; above the surface.
fn half_vector_density(up: Direction, direction: Direction) -> f64 {
    let half = normalized(combination(1.0, up, 1.0, direction)).unwrap_or([0.0, 0.0, 1.0]);
    let u = square_of(elevation(half), 0.0)[0];
    1.0 / (solid_angle_per_square(u).max(f64::MIN_POSITIVE) * 4.0 * dot(up, half).max(f64::MIN_POSITIVE))
}
