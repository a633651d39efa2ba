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
    /// Metres of it that may show light from infinity; in what has no end none arrives.
    pub open: F<L>,
}

impl<L: Lanes> LightWay<L> {
    /// How a point sees it, as if from no nearer than `least`.
    #[inline(always)]
    pub fn seen_from(&self, point: Vec3<L>, least: F<L>) -> Sight<L> {
        let to = point - self.origin;
        let nearest = to.dot(self.direction);
        let apart = (to - self.direction * nearest).length().max(least).max(1e-6);
        Sight { nearest, apart, angles: [(-nearest).atan2(apart), (self.length - nearest).atan2(apart)] }
    }

    /// The place after so many metres.
    #[inline(always)]
    pub fn place(&self, distance: F<L>) -> Vec3<L> {
        self.direction.mul_add(distance, self.origin)
    }
}

/// A way as a point sees it: places along it by their angle (equiangular sampling).
#[derive(Clone, Copy, Debug)]
pub struct Sight<L: Lanes> {
    /// Metres from the beginning of the way to what is nearest to the point, and from there to the point.
    nearest: F<L>,
    apart: F<L>,
    /// Angles of the way's ends.
    angles: [F<L>; 2],
}

impl<L: Lanes> Sight<L> {
    #[inline(always)]
    fn span(&self) -> F<L> {
        self.angles[1] - self.angles[0]
    }

    /// The integral of one over the squared distance to the point, along the way.
    #[inline(always)]
    pub(crate) fn nearness(&self) -> F<L> {
        self.span().max(1e-7) / self.apart
    }

    /// The place that a number in `[0, 1)` draws, metres from the way's beginning; rounding may lead beyond its ends.
    #[inline(always)]
    pub fn draw(&self, u: F<L>) -> F<L> {
        let (sin, cos) = self.angles[0].lerp(self.angles[1], u).sin_cos();
        (sin / cos.max(1e-7)).mul_add(self.apart, self.nearest)
    }

    /// The density of that, a metre.
    #[inline(always)]
    pub fn density(&self, distance: F<L>) -> F<L> {
        let off = distance - self.nearest;
        self.apart / (self.span().max(1e-6) * self.apart.mul_add(self.apart, off * off))
    }
}
