//! Inverse trigonometric functions.

use super::polynomial;
use crate::{F, Lanes};
use core::f32::consts::{FRAC_PI_2, PI};

/// `(asin z - z) / z³` in `z²` for |z| ≤ 1/2; relative error of the arcsine 5.2e-9.
const ARCSINE: [f32; 5] = [0.166_667_52, 0.074_952_91, 0.045_471_635, 0.024_172_98, 0.042_178_29];
/// `(atan z - z) / z³` in `z²` for |z| ≤ 1; relative error of the arctangent 1.9e-8.
const ARCTANGENT: [f32; 8] =
    [-0.333_331_53, 0.199_937_73, -0.142_110_56, 0.106_660_046, -0.075_522_15, 0.043_211_866, -0.016_367_93, 0.002_920_691_9];

/// Arcsine of `z` whose square is given, |z| ≤ 1/2.
#[inline(always)]
fn asin_of_half<L: Lanes>(z: F<L>, squared: F<L>) -> F<L> {
    polynomial(squared, ARCSINE).mul_add(squared * z, z)
}

impl<L: Lanes> F<L> {
    /// `asin √((1 - |self|) / 2)` for |self| > 1/2, `asin |self|` below, and the mask of the former; beyond ±1 counts as ±1.
    #[inline(always)]
    fn arcsine_parts(self) -> (F<L>, crate::M<L>) {
        let x = self.abs();
        let folded = x.gt(0.5);
        let square = x.mul_add(-0.5, 0.5);
        // A comparison and not `max`, which may lose a NaN.
        let square = square.lt(0.0).select(self.lanes().f(0.0), square);
        let square = folded.select(square, x * x);
        (asin_of_half(folded.select(square.sqrt(), x), square), folded)
    }

    /// Arcsine in [-π/2, π/2]; absolute error 2e-7, relative 3e-7. Arguments beyond ±1 (by rounding) count as ±1; NaN for NaN.
    #[inline(always)]
    pub fn asin(self) -> Self {
        let (part, folded) = self.arcsine_parts();
        folded.select(part.mul_add(-2.0, FRAC_PI_2), part).copysign(self)
    }

    /// Arccosine in [0, π]; absolute error 3e-7, relative 4e-7 for positive arguments. Arguments beyond ±1 (by rounding) count as ±1; NaN for NaN.
    #[inline(always)]
    pub fn acos(self) -> Self {
        let l = self.lanes();
        let (part, folded) = self.arcsine_parts();
        let negative = self.lt(0.0);
        let twice = part * 2.0;
        let outer = negative.select(l.f(PI) - twice, twice);
        folded.select(outer, l.f(FRAC_PI_2) - part.copysign(self))
    }

    /// The angle of the point (`x`, `self`) in [-π, π]; absolute error 3e-7, relative 4e-7. Signs of zero as in `f32::atan2`, so 0 or ±π at the
    /// origin; NaN for NaN and where both are infinite.
    #[inline(always)]
    pub fn atan2(self, x: Self) -> Self {
        let l = self.lanes();
        let (across, along) = (self.abs(), x.abs());
        let steep = across.gt(along);
        let (low, high) = (steep.select(along, across), steep.select(across, along));
        // The origin divides zero by one.
        let ratio = low / high.eq(0.0).select(l.f(1.0), high);
        let squared = ratio * ratio;
        let angle = polynomial(squared, ARCTANGENT).mul_add(squared * ratio, ratio);
        let angle = steep.select(l.f(FRAC_PI_2) - angle, angle);
        // The sign bit decides, for -0 lies on the left.
        let left = l.f(1.0).copysign(x).lt(0.0);
        left.select(l.f(PI) - angle, angle).copysign(self)
    }
}
