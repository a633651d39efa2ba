//! Ways of rays through media, as lights are selected for.

use gonio_simd::{F, Lanes, Vec3};

/// A way: from a point along a unit direction, metres long.
#[derive(Clone, Copy, Debug)]
pub struct LightWay<L: Lanes> {
    /// Where it begins.
    pub origin: Vec3<L>,
    /// Unit direction.
    pub direction: Vec3<L>,
    /// Metres.
    pub length: F<L>,
}

impl<L: Lanes> LightWay<L> {
    /// The integral of one over the squared distance to a point, along the way; the point is no nearer than `least`.
    #[inline(always)]
    pub(crate) fn nearness(&self, point: Vec3<L>, least: F<L>) -> F<L> {
        let to = point - self.origin;
        let nearest = to.dot(self.direction);
        let apart = (to - self.direction * nearest).length().max(least).max(1e-6);
        let angle = (self.length - nearest).atan2(apart) - (-nearest).atan2(apart);
        angle.max(1e-7) / apart
    }

    /// The place after so many metres.
    #[inline(always)]
    pub fn place(&self, distance: F<L>) -> Vec3<L> {
        self.direction.mul_add(distance, self.origin)
    }
}
