//! Integer lanes: unsigned, wrapping; signed values travel as their bits.

use crate::{F, Lanes, M};
use core::ops::{Add, AddAssign, BitAnd, BitOr, BitXor, BitXorAssign, Mul, Shl, Shr, Sub};

/// A `u32` in each lane.
#[derive(Clone, Copy, Debug)]
pub struct U<L: Lanes>(pub L::U32);

/// An integer or lanes of them.
pub trait ToU<L: Lanes>: Copy {
    /// The value in every lane.
    fn to_u(self, l: L) -> U<L>;
}
impl<L: Lanes> ToU<L> for U<L> {
    #[inline(always)]
    fn to_u(self, _: L) -> U<L> {
        self
    }
}
impl<L: Lanes> ToU<L> for u32 {
    #[inline(always)]
    fn to_u(self, l: L) -> U<L> {
        l.u(self)
    }
}

impl<L: Lanes> U<L> {
    /// The lanes token.
    #[inline(always)]
    pub fn lanes(self) -> L {
        L::token_u(self.0)
    }
    /// Writes the lanes to `values[at..at + COUNT]`.
    #[inline(always)]
    pub fn store(self, values: &mut [u32], at: usize) {
        L::store_u(self.0, &mut values[at..at + L::COUNT]);
    }
    /// Writes the chosen lanes at `values[len..]`, which must have a register's room.
    #[inline(always)]
    pub fn append(self, mask: M<L>, values: &mut [u32], len: usize) {
        L::store_u(L::compress_u(self.0, mask.0), &mut values[len..len + L::COUNT]);
    }
    /// The lanes as an array of 16, zero behind `COUNT`.
    #[inline(always)]
    pub fn to_array(self) -> [u32; 16] {
        let mut array = [0; 16];
        L::store_u(self.0, &mut array[..L::COUNT]);
        array
    }
    /// Smaller of two.
    #[inline(always)]
    pub fn min(self, o: impl ToU<L>) -> Self {
        U(L::min_u(self.0, o.to_u(self.lanes()).0))
    }
    /// Larger of two.
    #[inline(always)]
    pub fn max(self, o: impl ToU<L>) -> Self {
        U(L::max_u(self.0, o.to_u(self.lanes()).0))
    }
    /// `self < o`.
    #[inline(always)]
    pub fn lt(self, o: impl ToU<L>) -> M<L> {
        M(L::lt_u(self.0, o.to_u(self.lanes()).0))
    }
    /// `self == o`.
    #[inline(always)]
    pub fn eq(self, o: impl ToU<L>) -> M<L> {
        M(L::eq_u(self.0, o.to_u(self.lanes()).0))
    }
    /// `self != o`.
    #[inline(always)]
    pub fn ne(self, o: impl ToU<L>) -> M<L> {
        !self.eq(o)
    }
    /// Arithmetic shift right, less than 32.
    #[inline(always)]
    pub fn sar(self, by: u32) -> Self {
        U(L::sar_u(self.0, by))
    }
    /// Unsigned values as floats.
    #[inline(always)]
    pub fn to_float(self) -> F<L> {
        F(L::u32_to_f(self.0))
    }
    /// Signed values (given as bits) as floats.
    #[inline(always)]
    pub fn i32_to_float(self) -> F<L> {
        F(L::i32_to_f(self.0))
    }
    /// The value where the mask is set, zero elsewhere.
    #[inline(always)]
    pub fn keep_if(self, mask: M<L>) -> Self {
        mask.select(self, self.lanes().u(0))
    }
    /// One more where the mask is set: how comparisons are counted.
    #[inline(always)]
    pub fn count_if(self, mask: M<L>) -> Self {
        // The mask's ones are -1, so that one subtraction does it.
        self - mask.to_ones()
    }
    /// The bits of each value in reverse order.
    #[inline(always)]
    pub fn reverse_bits(self) -> Self {
        let x = ((self & 0x5555_5555) << 1) | ((self >> 1) & 0x5555_5555);
        let x = ((x & 0x3333_3333) << 2) | ((x >> 2) & 0x3333_3333);
        let x = ((x & 0x0f0f_0f0f) << 4) | ((x >> 4) & 0x0f0f_0f0f);
        let x = ((x & 0x00ff_00ff) << 8) | ((x >> 8) & 0x00ff_00ff);
        (x << 16) | (x >> 16)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $primitive:ident) => {
        impl<L: Lanes> $trait for U<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                U(L::$primitive(self.0, o.0))
            }
        }
        impl<L: Lanes> $trait<u32> for U<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: u32) -> Self {
                U(L::$primitive(self.0, self.lanes().splat_u(o)))
            }
        }
    };
}
operator!(Add, add, add_u);
operator!(Sub, sub, sub_u);
operator!(Mul, mul, mul_u);
operator!(BitAnd, bitand, and_u);
operator!(BitOr, bitor, or_u);
operator!(BitXor, bitxor, xor_u);

impl<L: Lanes> Shl<u32> for U<L> {
    type Output = Self;
    #[inline(always)]
    fn shl(self, by: u32) -> Self {
        U(L::shl_u(self.0, by))
    }
}
impl<L: Lanes> Shr<u32> for U<L> {
    type Output = Self;
    #[inline(always)]
    fn shr(self, by: u32) -> Self {
        U(L::shr_u(self.0, by))
    }
}
impl<L: Lanes, T: ToU<L>> AddAssign<T> for U<L> {
    #[inline(always)]
    fn add_assign(&mut self, o: T) {
        *self = *self + o.to_u(self.lanes());
    }
}
impl<L: Lanes, T: ToU<L>> BitXorAssign<T> for U<L> {
    #[inline(always)]
    fn bitxor_assign(&mut self, o: T) {
        *self = *self ^ o.to_u(self.lanes());
    }
}
