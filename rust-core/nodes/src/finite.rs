//! Results that later nodes can bear.

use gonio_simd::{F, Lanes};

/// The value, 0 where it is infinite or NaN.
#[inline(always)]
pub(crate) fn finite<L: Lanes>(x: F<L>) -> F<L> {
    x.keep_if(x.is_finite())
}

/// Several at once.
#[inline(always)]
pub(crate) fn all_finite<L: Lanes, const N: usize>(mut values: [F<L>; N]) -> [F<L>; N] {
    for value in &mut values {
        *value = finite(*value);
    }
    values
}
