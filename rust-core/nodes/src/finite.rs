//! Results that later nodes can bear.

use crate::periodic;
use gonio_simd::{F, Lanes};

/// The values, 0 where they are infinite or NaN.
#[inline(always)]
pub(crate) fn finite<L: Lanes, const N: usize>(values: [F<L>; N]) -> [F<L>; N] {
    let mut finite = values;
    for value in &mut finite {
        *value = periodic::finite(*value);
    }
    finite
}
