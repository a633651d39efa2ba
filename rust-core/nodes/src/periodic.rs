//! Remainders and sines of numbers that may be large.

use core::f32::consts::TAU;
use gonio_simd::{F, Lanes};

/// The bits of a float without the lower half of its mantissa.
const UPPER_HALF: u32 = 0xffff_f000;
/// Products of a number below this and half a mantissa are exact.
const EXACT_COUNT: f32 = 4096.0;

/// A full turn in three parts, the first two short enough that their multiples up to 2¹⁰ are exact.
const TURN: [f32; 3] = [6.281_25, 0.001_935_005_2, 3.019_916e-7];
/// Turns are counted in this many and in ones.
const MANY_TURNS: f32 = 1024.0;

/// `x` less a whole number of `period`s, of `x`'s sign and smaller than `period`, without rounding: C's `fmod`. NaN for ±∞ and NaN.
#[inline(always)]
pub(crate) fn remainder<L: Lanes>(x: F<L>, period: f32) -> F<L> {
    let size = x.abs();
    let count = (size / period).floor();
    let high = f32::from_bits(period.to_bits() & UPPER_HALF);
    let mut rest = size - count * high - count * (period - high);
    // A quotient just below a whole number may have been rounded up to it.
    rest = rest.lt(0.0).select(rest + period, rest);
    let far = count.ge(EXACT_COUNT);
    if far.any() {
        rest = far.select(one_by_one(size, period), rest);
    }
    rest.copysign(x)
}

/// The remainders of numbers of any size, one lane after the other.
#[inline(always)]
fn one_by_one<L: Lanes>(x: F<L>, period: f32) -> F<L> {
    let mut values = x.to_array();
    for value in &mut values {
        *value %= period;
    }
    x.lanes().load(&values, 0)
}

/// The angle less its whole turns, in [-π, π]: exact to 1e-7 for |x| ≤ 5·10⁶, some angle beyond, 0 for ±∞ and NaN.
#[inline(always)]
fn within_turn<L: Lanes>(x: F<L>) -> F<L> {
    let turns = (x * (1.0 / TAU)).round();
    let many = (turns * (1.0 / MANY_TURNS)).round() * MANY_TURNS;
    let few = turns - many;
    let [high, middle, low] = TURN;
    let coarse = x - many * high - few * high;
    let angle = coarse - many * middle - few * middle - turns * low;
    angle.keep_if(angle.abs().le(4.0))
}

/// The sine of an angle in radians of any size: absolute error 3e-7 for |x| ≤ 5·10⁶, some value in [-1, 1] beyond, 0 for ±∞ and NaN.
#[inline(always)]
pub(crate) fn sine<L: Lanes>(x: F<L>) -> F<L> {
    within_turn(x).sin()
}

/// The cosine of an angle in radians of any size, as [`sine`] has it, but 1 for ±∞ and NaN.
#[inline(always)]
pub(crate) fn cosine<L: Lanes>(x: F<L>) -> F<L> {
    within_turn(x).cos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_simd::{Execution, dispatch};

    fn sample(number: u32, reach: f32) -> f32 {
        let unit = number.wrapping_mul(2_654_435_761) as f32 / u32::MAX as f32;
        (2.0 * unit - 1.0) * reach
    }

    #[test]
    fn sines_of_large_angles_are_exact() {
        for execution in Execution::all() {
            for reach in [1.0, 10.0, 300.0, 1e4, 1e5, 5e6] {
                for number in 0..2000 {
                    let x = sample(number, reach);
                    let got = dispatch!(execution, l => sine(l.f(x)).to_array()[0]);
                    let error = f64::from(got) - f64::from(x).sin();
                    assert!(error.abs() < 3e-7, "{}: sine of {x} is {got}, off by {error}", execution.name());
                }
            }
        }
    }

    #[test]
    fn remainders_are_exact() {
        for execution in Execution::all() {
            for (reach, period) in [(10.0, TAU), (3e4, TAU), (1e9, TAU), (2e5, 1e5), (1e10, 1e5), (3e38, 1e5)] {
                for number in 0..2000 {
                    let x = sample(number, reach);
                    let got = dispatch!(execution, l => remainder(l.f(x), period).to_array()[0]);
                    assert_eq!(got, x % period, "{}: remainder of {x} by {period}", execution.name());
                }
            }
        }
    }

    #[test]
    fn what_is_not_finite_stays_within_bounds() {
        for x in [f32::MAX, -f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e20, -1e9] {
            for execution in Execution::all() {
                let got = dispatch!(execution, l => sine(l.f(x)).to_array()[0]);
                assert!(got.abs() <= 1.0, "{}: sine of {x} is {got}", execution.name());
            }
        }
    }
}
