//! Truth values by lane.

use crate::{F, Lanes, U};
use core::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, Not};

/// A truth value in each lane.
#[derive(Clone, Copy)]
pub struct M<L: Lanes>(pub L::Mask);

impl<L: Lanes> core::fmt::Debug for M<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "M({:#b})", self.bits())
    }
}

/// A value that a mask can choose lane by lane.
pub trait Select<L: Lanes>: Copy {
    /// `if_true` where the mask is set, `if_false` elsewhere.
    fn select(mask: M<L>, if_true: Self, if_false: Self) -> Self;
}

impl<L: Lanes> Select<L> for F<L> {
    #[inline(always)]
    fn select(mask: M<L>, if_true: Self, if_false: Self) -> Self {
        F(L::select_f(mask.0, if_true.0, if_false.0))
    }
}
impl<L: Lanes> Select<L> for U<L> {
    #[inline(always)]
    fn select(mask: M<L>, if_true: Self, if_false: Self) -> Self {
        U(L::select_u(mask.0, if_true.0, if_false.0))
    }
}
impl<L: Lanes> Select<L> for M<L> {
    #[inline(always)]
    fn select(mask: M<L>, if_true: Self, if_false: Self) -> Self {
        (mask & if_true) | (!mask & if_false)
    }
}

impl<L: Lanes> M<L> {
    /// `if_true` where set, `if_false` elsewhere.
    #[inline(always)]
    pub fn select<T: Select<L>>(self, if_true: T, if_false: T) -> T {
        T::select(self, if_true, if_false)
    }
    /// Bit `i` is lane `i`.
    #[inline(always)]
    pub fn bits(self) -> u64 {
        L::bits_m(self.0)
    }
    /// Whether any lane is set.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.bits() != 0
    }
    /// Whether every lane is set.
    #[inline(always)]
    pub fn all(self) -> bool {
        self.bits() == (1 << L::COUNT) - 1
    }
    /// Lanes set.
    #[inline(always)]
    pub fn count(self) -> usize {
        self.bits().count_ones() as usize
    }
    /// 1 where set, 0 elsewhere. To count, see [`U::count_if`].
    #[inline(always)]
    pub fn to_integers(self) -> U<L> {
        let l = L::token_m(self.0);
        self.select(l.u(1), l.u(0))
    }
    /// All ones where set, 0 elsewhere.
    #[inline(always)]
    pub fn to_ones(self) -> U<L> {
        U(L::ones_m(self.0))
    }
    /// Set here and not in `other`.
    #[inline(always)]
    pub fn and_not(self, other: Self) -> Self {
        self & !other
    }
}

impl<L: Lanes> BitAnd for M<L> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        M(L::and_m(self.0, o.0))
    }
}
impl<L: Lanes> BitOr for M<L> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        M(L::or_m(self.0, o.0))
    }
}
impl<L: Lanes> Not for M<L> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        M(L::not_m(self.0))
    }
}
impl<L: Lanes> BitAndAssign for M<L> {
    #[inline(always)]
    fn bitand_assign(&mut self, o: Self) {
        *self = *self & o;
    }
}
impl<L: Lanes> BitOrAssign for M<L> {
    #[inline(always)]
    fn bitor_assign(&mut self, o: Self) {
        *self = *self | o;
    }
}
