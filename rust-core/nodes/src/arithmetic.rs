//! What operations on single components compute, where it takes more than a line.

use gonio_simd::{F, Lanes};
use std::f32::consts::TAU;

/// Angles up to here are reduced with care, radians; larger ones in turns, as exactly as they are known.
const LARGEST_ANGLE: f32 = 1e4;

/// a to the power b: zero for negative bases, and for zero unless b is zero; denormals count as the smallest normal number.
#[inline(always)]
pub(crate) fn power<L: Lanes>(a: F<L>, b: F<L>) -> F<L> {
    let at_zero = a.lanes().f(1.0).keep_if(a.eq(0.0) & b.eq(0.0));
    a.gt(0.0).select(a.max(f32::MIN_POSITIVE).pow(b), at_zero)
}

/// The remainder with the sign of a; zero for a divisor of zero.
#[inline(always)]
pub(crate) fn modulo<L: Lanes>(a: F<L>, b: F<L>) -> F<L> {
    let (x, y) = (a.abs(), b.abs());
    // Where rounding has carried the quotient over an integer, the remainder is off by one divisor.
    let rough = (x / y).floor().mul_add(-y, x);
    let low = rough.lt(0.0).select(rough + y, rough);
    let held = low.ge(y).select(low - y, low);
    held.copysign(a).keep_if(y.gt(0.0))
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
