//! Exponentials, logarithms and powers.

use super::polynomial;
use crate::{F, Lanes, ToF, U};
use core::f32::consts::{LN_2, LOG2_E};

/// `(2^f - 1) / f` for |f| ≤ 1/2; relative error of the power 5.3e-9.
const EXP2: [f32; 6] = [0.693_147_24, 0.240_226_55, 0.055_502_728, 0.009_617_065, 0.001_341_769_6, 0.000_158_249_27];
/// `(e^r - 1 - r) / r²` for |r| ≤ ln(2)/2; relative error of the power 3.3e-9.
const EXP: [f32; 5] = [0.499_999_94, 0.166_665_17, 0.041_668_102, 0.008_369_217, 0.001_383_942];
/// `log2(1 + f) / f - 1` for √½ - 1 ≤ f < √2 - 1; relative error of the logarithm 3.5e-8.
const LOG2: [f32; 9] =
    [0.442_695, -0.721_347_33, 0.480_910_78, -0.360_704_4, 0.287_917_2, -0.238_944_81, 0.215_715_6, -0.207_269_76, 0.125_837_06];

/// ln 2 in two parts, the first short enough that its multiples up to 2⁸ are exact (Moshier's Cephes library, `expf.c`).
const LN_2_PARTS: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];
/// The bits of √½, at which the mantissa's range [√½, √2) begins.
const ROOT_HALF_BITS: u32 = 0x3f35_04f3;
const MANTISSA_BITS: u32 = 23;

/// `x · 2^exponent` (signed, given as bits) for normal `x` and a normal result.
#[inline(always)]
fn scale_by_power<L: Lanes>(x: F<L>, exponent: U<L>) -> F<L> {
    F::from_bits(x.to_bits() + (exponent << MANTISSA_BITS))
}

/// The result of an exponential, set to zero below and infinity above its domain.
#[inline(always)]
fn within_domain<L: Lanes>(result: F<L>, x: F<L>, low: f32, high: f32) -> F<L> {
    let l = x.lanes();
    x.lt(low).select(l.f(0.0), x.gt(high).select(l.f(f32::INFINITY), result))
}

impl<L: Lanes> F<L> {
    /// 2 to the power of `self`; error 2 ulp, exact for integers. Results below 2⁻¹²⁶ (denormals) are 0, above `f32::MAX` ∞; NaN for NaN.
    #[inline(always)]
    pub fn exp2(self) -> Self {
        within_domain(self.normal_exp2(), self, -126.0, 128.0_f32.next_down())
    }

    /// [`exp2`](Self::exp2) where that is normal and finite.
    #[inline(always)]
    fn normal_exp2(self) -> Self {
        let whole = self.round();
        let f = self - whole;
        let power = polynomial(f, EXP2).mul_add(f, 1.0);
        // The exponent is added to the bits, for 2^128 as a factor would be infinite.
        scale_by_power(power, whole.to_i32())
    }

    /// e to the power of `self`; error 2 ulp. Results below 2⁻¹²⁶ (denormals) are 0, above `f32::MAX` ∞; NaN for NaN.
    #[inline(always)]
    pub fn exp(self) -> Self {
        const LOW: f32 = -87.336_54;
        const HIGH: f32 = 88.722_83;
        let whole = (self * LOG2_E).round();
        let r = whole.mul_add(-LN_2_PARTS[1], whole.mul_add(-LN_2_PARTS[0], self));
        let power = polynomial(r, EXP).mul_add(r * r, r) + 1.0;
        within_domain(scale_by_power(power, whole.to_i32()), self, LOW, HIGH)
    }

    /// Binary logarithm; relative error 1.8e-7 (near 1 as well, where the result vanishes), exact for powers of two. -∞ for ±0 and positive
    /// denormals, ∞ for ∞, NaN for negative numbers and NaN.
    #[inline(always)]
    pub fn log2(self) -> Self {
        self.logarithm_or_special(self.normal_log2())
    }

    /// [`log2`](Self::log2) of a positive, normal and finite number.
    #[inline(always)]
    fn normal_log2(self) -> Self {
        let bits = self.to_bits();
        let exponent = (bits - ROOT_HALF_BITS).sar(MANTISSA_BITS);
        let f = F::from_bits(bits - (exponent << MANTISSA_BITS)) - 1.0;
        // f is kept outside the polynomial, so that its rounding errors shrink with log2(1 + f) / f - 1.
        let fraction = polynomial(f, LOG2).mul_add(f, f);
        exponent.i32_to_float() + fraction
    }

    /// `logarithm` where `self` is positive, normal and finite; the limits of the logarithm elsewhere.
    #[inline(always)]
    fn logarithm_or_special(self, logarithm: Self) -> Self {
        let l = self.lanes();
        let below = self.lt(0.0).select(l.f(f32::NAN), l.f(f32::NEG_INFINITY));
        let limited = self.le(f32::MAX).select(logarithm, self);
        self.lt(f32::MIN_POSITIVE).select(below, limited)
    }

    /// Natural logarithm, [`log2`](Self::log2) times ln 2; relative error 2.4e-7 (near 1 as well); special values as for `log2`.
    #[inline(always)]
    pub fn ln(self) -> Self {
        self.log2() * LN_2
    }

    /// `self` to the power of a finite `y`, for `self` ≥ 0: 2^(y log2 self). Relative error 2e-7 + 1.8e-7 |y ln self|, so 1e-5 for results in 2^±30.
    ///
    /// `pow(x, 0)` is 1 for all x; `pow(0, y)` is 0 for y > 0 and ∞ for y < 0; denormals count as 0; NaN for negative `self`.
    #[inline(always)]
    pub fn pow(self, y: impl ToF<L>) -> Self {
        let l = self.lanes();
        let y = y.to_f(l);
        y.eq(0.0).select(l.f(1.0), (y * self.log2()).exp2())
    }

    /// [`pow`](Self::pow) for positive, normal and finite `self`, where the result is so too; unspecified elsewhere.
    #[inline(always)]
    pub fn normal_pow(self, y: impl ToF<L>) -> Self {
        (y.to_f(self.lanes()) * self.normal_log2()).normal_exp2()
    }
}
