//! What operations on single components compute, where it takes more than a line.

use gonio_simd::{F, Lanes};
use std::f32::consts::TAU;

/// Angles up to here are reduced with care, radians; larger ones in turns, as exactly as they are known.
const LARGEST_ANGLE: f32 = 1e4;

/// a to the power b: negative bases have powers with whole exponents alone, others are zero; zero has the power one for zero, else zero.
/// Denormals count as the smallest normal number.
#[inline(always)]
pub(crate) fn power<L: Lanes>(a: F<L>, b: F<L>) -> F<L> {
    let l = a.lanes();
    let at_zero = l.f(1.0).keep_if(b.eq(0.0));
    let magnitude = a.abs().max(f32::MIN_POSITIVE).pow(b);
    let whole = b.floor().eq(b);
    let half = b * 0.5;
    let is_odd = whole & !half.floor().eq(half);
    let signed = (a.lt(0.0) & is_odd).select(-magnitude, magnitude);
    a.eq(0.0).select(at_zero, signed.keep_if(a.gt(0.0) | whole))
}

/// The remainder with the sign of a; zero for a divisor of zero.
#[inline(always)]
pub(crate) fn modulo<L: Lanes>(a: F<L>, b: F<L>) -> F<L> {
    let y = b.abs();
    let mut rest = a.abs();
    // Quotients of more than 24 bits take more than one round.
    for _ in 0..3 {
        let quotient = (rest / y).floor();
        let [high, low] = product(quotient, y);
        rest = (rest - high) - low;
    }
    // Where rounding has carried a quotient over an integer, the remainder is off by one divisor.
    let rest = rest.lt(0.0).select(rest + y, rest);
    let rest = rest.ge(y).select(rest - y, rest);
    rest.copysign(a).keep_if(y.gt(0.0) & rest.is_finite())
}

/// A product and its rounding error (Dekker, 1971), at levels without fused operations too.
#[inline(always)]
fn product<L: Lanes>(a: F<L>, b: F<L>) -> [F<L>; 2] {
    let high = a * b;
    let [a_high, a_low] = halves(a);
    let [b_high, b_low] = halves(b);
    let error = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
    [high, error]
}

/// The upper and the lower twelve bits of a mantissa.
#[inline(always)]
fn halves<L: Lanes>(x: F<L>) -> [F<L>; 2] {
    let high = F::from_bits(x.to_bits() & 0xffff_f000);
    [high, x - high]
}

/// Sine and cosine of any finite angle.
#[inline(always)]
pub(crate) fn sin_cos<L: Lanes>(angle: F<L>) -> [F<L>; 2] {
    let large = angle.abs().gt(LARGEST_ANGLE);
    let (sin, cos) = angle.sin_cos();
    if !large.any() {
        return [sin, cos];
    }
    let turns = angle * TAU.recip();
    let (far_sin, far_cos) = (turns - turns.floor()).sin_cos_turns();
    [large.select(far_sin, sin), large.select(far_cos, cos)]
}

/// A divisor that is never zero.
#[inline(always)]
fn or_one<L: Lanes>(l: L, x: F<L>) -> F<L> {
    x.eq(0.0).select(l.f(1.0), x)
}

/// Reflectance of a smooth dielectric for unpolarised light at |`cosine`|; `eta` is the far side's index over the near side's.
#[inline(always)]
pub(crate) fn fresnel<L: Lanes>(l: L, cosine: F<L>, eta: F<L>) -> F<L> {
    let one = l.f(1.0);
    let c = cosine.abs();
    let excess = (eta - 1.0) * (eta + 1.0);
    let squared = c.mul_add(c, excess);
    let root = squared.safe_sqrt();
    let sum = or_one(l, root + c);
    // root − c without cancellation.
    let difference = excess / sum;
    let perpendicular = difference / sum;
    let ratio = c.mul_add(root + c, -1.0) / or_one(l, c.mul_add(difference, 1.0));
    let reflectance = perpendicular * perpendicular * 0.5 * ratio.mul_add(ratio, 1.0);
    squared.gt(0.0).select(reflectance, one)
}
