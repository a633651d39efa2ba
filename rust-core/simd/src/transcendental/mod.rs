//! Elementary functions on lanes with stated error bounds, by range reduction and polynomials.
//!
//! Bounds hold at every level, with and without fused multiply-add; the tests measure them against `f64`. An ulp is 2⁻²³ of the result's
//! power of two. Coefficients without another source are minimax fits of our own: a Remez exchange in `f64` for the relative error of the whole
//! function on the reduced interval, rounded to `f32` and improved by a descent over neighbouring floats.

mod exponential;
mod inverse;
mod trigonometric;

use crate::{F, Lanes};

/// A polynomial by Horner's rule, lowest coefficient first.
#[inline(always)]
fn polynomial<L: Lanes, const K: usize>(x: F<L>, coefficients: [f32; K]) -> F<L> {
    let mut sum = x.lanes().f(coefficients[K - 1]);
    for k in (0..K - 1).rev() {
        sum = sum.mul_add(x, coefficients[k]);
    }
    sum
}
