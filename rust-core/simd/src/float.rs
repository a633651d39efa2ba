//! Floating-point lanes.

use crate::{Lanes, M, U};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// An `f32` in each lane.
#[derive(Clone, Copy, Debug)]
pub struct F<L: Lanes>(pub L::F32);

/// A number or lanes of them: what comparisons and arithmetic take on their right.
pub trait ToF<L: Lanes>: Copy {
    /// The value in every lane.
    fn to_f(self, l: L) -> F<L>;
}
impl<L: Lanes> ToF<L> for F<L> {
    #[inline(always)]
    fn to_f(self, _: L) -> F<L> {
        self
    }
}
impl<L: Lanes> ToF<L> for f32 {
    #[inline(always)]
    fn to_f(self, l: L) -> F<L> {
        l.f(self)
    }
}

impl<L: Lanes> F<L> {
    /// The lanes token.
    #[inline(always)]
    pub fn lanes(self) -> L {
        L::token(self.0)
    }
    /// Writes the lanes to `values[at..at + COUNT]`.
    #[inline(always)]
    pub fn store(self, values: &mut [f32], at: usize) {
        L::store_f(self.0, &mut values[at..at + L::COUNT]);
    }
    /// Appends the chosen lanes at `values[*len..]`, which must have a register's room, and advances `len`.
    #[inline(always)]
    pub fn append(self, mask: M<L>, values: &mut [f32], len: usize) {
        L::store_f(L::compress_f(self.0, mask.0), &mut values[len..len + L::COUNT]);
    }
    /// The lanes as an array of 16, zero behind `COUNT`; for scalar decisions and tests.
    #[inline(always)]
    pub fn to_array(self) -> [f32; 16] {
        let mut array = [0.0; 16];
        L::store_f(self.0, &mut array[..L::COUNT]);
        array
    }
    /// `self * a + b`, fused where the level has the instruction.
    #[inline(always)]
    pub fn mul_add(self, a: impl ToF<L>, b: impl ToF<L>) -> Self {
        let l = self.lanes();
        F(L::mul_add_f(self.0, a.to_f(l).0, b.to_f(l).0))
    }
    /// Square root.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        F(L::sqrt_f(self.0))
    }
    /// Square root of the value raised to zero where negative.
    #[inline(always)]
    pub fn safe_sqrt(self) -> Self {
        self.max(0.0).sqrt()
    }
    /// `1 / √self` within two units in the last place: infinite for zero, NaN below. No level's estimate, so that all give the same bits.
    #[inline(always)]
    pub fn inverse_root(self) -> Self {
        self.sqrt().recip()
    }
    /// `1 / self`, exact division.
    #[inline(always)]
    pub fn recip(self) -> Self {
        self.lanes().f(1.0) / self
    }
    /// Absolute value.
    #[inline(always)]
    pub fn abs(self) -> Self {
        F(L::abs_f(self.0))
    }
    /// Smaller of two; NaN lanes are left to the hardware.
    #[inline(always)]
    pub fn min(self, o: impl ToF<L>) -> Self {
        F(L::min_f(self.0, o.to_f(self.lanes()).0))
    }
    /// Larger of two; NaN lanes are left to the hardware.
    #[inline(always)]
    pub fn max(self, o: impl ToF<L>) -> Self {
        F(L::max_f(self.0, o.to_f(self.lanes()).0))
    }
    /// The value held in `[low, high]`.
    #[inline(always)]
    pub fn clamp(self, low: impl ToF<L>, high: impl ToF<L>) -> Self {
        self.max(low).min(high)
    }
    /// The part that the value is of a whole, 0 where there is none.
    #[inline(always)]
    pub fn share_of(self, whole: Self) -> Self {
        (self / whole.max(f32::MIN_POSITIVE)).keep_if(whole.gt(0.0))
    }
    /// The value held in `[0, 1]`.
    #[inline(always)]
    pub fn saturate(self) -> Self {
        self.clamp(0.0, 1.0)
    }
    /// Largest integer not above.
    #[inline(always)]
    pub fn floor(self) -> Self {
        F(L::floor_f(self.0))
    }
    /// Nearest integer, ties to even.
    #[inline(always)]
    pub fn round(self) -> Self {
        F(L::round_f(self.0))
    }
    /// Magnitude of `self`, sign of `o`.
    #[inline(always)]
    pub fn copysign(self, o: Self) -> Self {
        F(L::copysign_f(self.0, o.0))
    }
    /// The square.
    #[inline(always)]
    pub fn squared(self) -> Self {
        self * self
    }
    /// `self` at 0, `to` at 1.
    #[inline(always)]
    pub fn lerp(self, to: impl ToF<L>, t: impl ToF<L>) -> Self {
        let l = self.lanes();
        (to.to_f(l) - self).mul_add(t, self)
    }
    /// The value where the mask is set, zero elsewhere.
    #[inline(always)]
    pub fn keep_if(self, mask: M<L>) -> Self {
        mask.select(self, self.lanes().f(0.0))
    }
    /// `self < o`; false for NaN.
    #[inline(always)]
    pub fn lt(self, o: impl ToF<L>) -> M<L> {
        M(L::lt_f(self.0, o.to_f(self.lanes()).0))
    }
    /// `self <= o`; false for NaN.
    #[inline(always)]
    pub fn le(self, o: impl ToF<L>) -> M<L> {
        M(L::le_f(self.0, o.to_f(self.lanes()).0))
    }
    /// `self > o`; false for NaN.
    #[inline(always)]
    pub fn gt(self, o: impl ToF<L>) -> M<L> {
        M(L::lt_f(o.to_f(self.lanes()).0, self.0))
    }
    /// `self >= o`; false for NaN.
    #[inline(always)]
    pub fn ge(self, o: impl ToF<L>) -> M<L> {
        M(L::le_f(o.to_f(self.lanes()).0, self.0))
    }
    /// `self == o`; false for NaN.
    #[inline(always)]
    pub fn eq(self, o: impl ToF<L>) -> M<L> {
        M(L::eq_f(self.0, o.to_f(self.lanes()).0))
    }
    /// Neither infinite nor NaN.
    #[inline(always)]
    pub fn is_finite(self) -> M<L> {
        self.abs().le(f32::MAX)
    }
    /// The bits.
    #[inline(always)]
    pub fn to_bits(self) -> U<L> {
        U(L::bits_f(self.0))
    }
    /// Floats from their bits.
    #[inline(always)]
    pub fn from_bits(bits: U<L>) -> Self {
        F(L::from_bits_f(bits.0))
    }
    /// Truncates towards zero to `i32`, given as its bits; the value must fit.
    #[inline(always)]
    pub fn to_i32(self) -> U<L> {
        U(L::to_i32(self.0))
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign:ident, $primitive:ident) => {
        impl<L: Lanes> $trait for F<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                F(L::$primitive(self.0, o.0))
            }
        }
        impl<L: Lanes> $trait<f32> for F<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: f32) -> Self {
                F(L::$primitive(self.0, self.lanes().splat_f(o)))
            }
        }
        impl<L: Lanes> $trait<F<L>> for f32 {
            type Output = F<L>;
            #[inline(always)]
            fn $method(self, o: F<L>) -> F<L> {
                F(L::$primitive(o.lanes().splat_f(self), o.0))
            }
        }
        impl<L: Lanes, T: ToF<L>> $assign_trait<T> for F<L> {
            #[inline(always)]
            fn $assign(&mut self, o: T) {
                *self = F(L::$primitive(self.0, o.to_f(self.lanes()).0));
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign, add_f);
operator!(Sub, sub, SubAssign, sub_assign, sub_f);
operator!(Mul, mul, MulAssign, mul_assign, mul_f);
operator!(Div, div, DivAssign, div_assign, div_f);

impl<L: Lanes> Neg for F<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        F(L::neg_f(self.0))
    }
}
