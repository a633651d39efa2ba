//! Solid angles of triangles, for solid angle sampling, and when not to sample by them.

use gonio_simd::{F, Lanes, Vec3};

/// Below this solid angle points are drawn by area: the two differ little and area is the steadier.
pub(super) const BY_AREA_BELOW: f32 = 1e-3;

/// The solid angle of the triangle of three vectors, and what it is made of.
pub(super) struct SolidAngle<L: Lanes> {
    pub(super) value: F<L>,
    /// Cosines between the unit vectors a and b, a and c, b and c.
    pub(super) cosines: [F<L>; 3],
    /// Of the unit vectors.
    pub(super) determinant: F<L>,
}

impl<L: Lanes> SolidAngle<L> {
    /// Of vectors whose triple product is `volume` ≥ 0 and whose lengths' reciprocals are `inverse` (Van Oosterom and Strackee 1983).
    #[inline(always)]
    pub(super) fn new(volume: F<L>, [a, b, c]: [Vec3<L>; 3], [ia, ib, ic]: [F<L>; 3]) -> Self {
        let cosines = [a.dot(b) * (ia * ib), a.dot(c) * (ia * ic), b.dot(c) * (ib * ic)];
        let determinant = volume * (ia * ib * ic);
        let value = determinant.atan2(cosines[0] + cosines[1] + cosines[2] + 1.0) * 2.0;
        Self { value, cosines, determinant }
    }
}
