//! Sine, cosine and tangent.

use super::polynomial;
use crate::{F, Lanes, U};
use core::f32::consts::{FRAC_2_PI, FRAC_PI_2};

/// `(sin r - r) / r³` in `r²` for |r| ≤ π/4; relative error of the sine 4.0e-9.
const SINE_OF_EIGHTH: [f32; 3] = [-0.166_666_55, 0.008_332_189, -0.000_195_182_92];
/// `(cos r - 1 + r²/2) / r⁴` in `r²` for |r| ≤ π/4; relative error of the cosine 1.3e-10.
const COSINE_OF_EIGHTH: [f32; 3] = [0.041_666_646, -0.001_388_731, 2.443_228_7e-5];

/// π/2 in three parts, the first two short enough that their multiples up to 2¹³ are exact (Cody and Waite, Software Manual for the Elementary
/// Functions, 1980; the parts are twice those of Moshier's Cephes library, `sinf.c`).
const HALF_PI: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// `x - quarters · π/2`.
#[inline(always)]
fn without_quarters<L: Lanes>(x: F<L>, quarters: F<L>) -> F<L> {
    quarters.mul_add(-HALF_PI[2], quarters.mul_add(-HALF_PI[1], quarters.mul_add(-HALF_PI[0], x)))
}

/// Sine and cosine of an angle in [-π/4, π/4].
#[inline(always)]
fn sin_cos_of_eighth<L: Lanes>(r: F<L>) -> (F<L>, F<L>) {
    let squared = r * r;
    let sin = polynomial(squared, SINE_OF_EIGHTH).mul_add(squared * r, r);
    let cos = polynomial(squared, COSINE_OF_EIGHTH).mul_add(squared * squared, squared.mul_add(-0.5, 1.0));
    (sin, cos)
}

/// Sine and cosine of `r` plus `quarters` quarter turns.
#[inline(always)]
fn sin_cos_after_quarters<L: Lanes>(r: F<L>, quarters: U<L>) -> (F<L>, F<L>) {
    let (sin, cos) = sin_cos_of_eighth(r);
    let swap = (quarters & 1).eq(1);
    let sin_sign = (quarters & 2) << 30;
    let cos_sign = ((quarters + 1) & 2) << 30;
    (swap.select(cos, sin).flip_sign(sin_sign), swap.select(sin, cos).flip_sign(cos_sign))
}

impl<L: Lanes> F<L> {
    /// The value with its sign bit inverted where `sign` has bit 31 set (and no other bit).
    #[inline(always)]
    fn flip_sign(self, sign: U<L>) -> Self {
        F::from_bits(self.to_bits() ^ sign)
    }

    /// Sine and cosine of an angle in radians; absolute error 1e-7 and magnitude at most 1 for |x| ≤ 10⁴, the sine within 2 ulp for
    /// |x| ≤ π/2; unspecified for larger |x|; NaN for ±∞ and NaN.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let quarters = (self * FRAC_2_PI).round();
        sin_cos_after_quarters(without_quarters(self, quarters), quarters.to_i32())
    }

    /// Sine and cosine of an angle in turns (1 is the full circle); absolute error 1.2e-7 for |x| < 2²⁸; NaN for ±∞ and NaN.
    #[inline(always)]
    pub fn sin_cos_turns(self) -> (Self, Self) {
        let in_quarters = self * 4.0;
        let quarters = in_quarters.round();
        sin_cos_after_quarters((in_quarters - quarters) * FRAC_PI_2, quarters.to_i32())
    }

    /// Sine of an angle in radians, as [`sin_cos`](Self::sin_cos) has it.
    #[inline(always)]
    pub fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// Cosine of an angle in radians, as [`sin_cos`](Self::sin_cos) has it.
    #[inline(always)]
    pub fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// Tangent of an angle in radians; relative error 4e-7 plus the poles' shift by the argument's reduction for |x| ≤ 10⁴, unspecified beyond;
    /// NaN for ±∞ and NaN.
    #[inline(always)]
    pub fn tan(self) -> Self {
        let quarters = (self * FRAC_2_PI).round();
        let (sin, cos) = sin_cos_of_eighth(without_quarters(self, quarters));
        let odd = quarters.to_i32() & 1;
        let swap = odd.eq(1);
        (swap.select(cos, sin) / swap.select(sin, cos)).flip_sign(odd << 31)
    }
}
