//! Operations that treat each component alike.

use super::{Arithmetic, Source, evaluate::read_component};
use gonio_simd::{F, Lanes, PADDING};
use std::f32::consts::TAU;

/// Largest argument of the exponential; beyond it the result would not be finite.
const LARGEST_EXPONENT: f32 = 88.0;
/// Angles up to here are reduced with care, radians; larger ones in turns, as exactly as they are known.
const LARGEST_ANGLE: f32 = 1e4;

/// Runs an operation for the step `number`: component by component, or once for all where the inputs are `even`.
#[inline(always)]
pub(super) fn arithmetic<L: Lanes>(l: L, operation: Arithmetic, inputs: [Source; 3], even: bool, registers: &mut [f32], number: usize) {
    let width = if even { 1 } else { 4 };
    let mut result = l.f(0.0);
    for i in 0..width {
        let input = |k: usize| read_component(l, registers, inputs[k], i);
        result = component(l, operation, input(0), input(1), input(2));
        result.store(registers, (number * 4 + i) * PADDING);
    }
    for i in width..4 {
        result.store(registers, (number * 4 + i) * PADDING);
    }
}

/// One component's value.
#[inline(always)]
fn component<L: Lanes>(l: L, operation: Arithmetic, a: F<L>, b: F<L>, c: F<L>) -> F<L> {
    let (zero, one) = (l.f(0.0), l.f(1.0));
    match operation {
        Arithmetic::Add => a + b,
        Arithmetic::Subtract => a - b,
        Arithmetic::Multiply => a * b,
        Arithmetic::Divide => b.eq(0.0).select(zero, a / b),
        Arithmetic::Mix => a.lerp(b, c),
        Arithmetic::Power => power(a, b),
        Arithmetic::Invert => b - a,
        Arithmetic::Clamp => a.max(b).min(c),
        Arithmetic::Minimum => a.min(b),
        Arithmetic::Maximum => a.max(b),
        Arithmetic::Absolute => a.abs(),
        Arithmetic::Sign => a.gt(0.0).select(one, (-one).keep_if(a.lt(0.0))),
        Arithmetic::Floor => a.floor(),
        Arithmetic::SquareRoot => a.max(0.0).sqrt(),
        Arithmetic::Exponential => a.min(LARGEST_EXPONENT).exp(),
        // Denormals count as the smallest normal number, so that results are finite.
        Arithmetic::Logarithm => a.max(f32::MIN_POSITIVE).ln().keep_if(a.gt(0.0)),
        Arithmetic::Sine => sin_cos(a)[0],
        Arithmetic::Cosine => sin_cos(a)[1],
        Arithmetic::ArcSine => a.clamp(-1.0, 1.0).asin(),
        Arithmetic::ArcCosine => a.clamp(-1.0, 1.0).acos(),
        Arithmetic::ArcTangent2 => a.atan2(b),
        Arithmetic::Less => one.keep_if(a.lt(b)),
        Arithmetic::Fresnel => fresnel(l, a, b),
    }
}

/// a to the power b: zero for negative bases, and for zero unless b is zero; denormals count as the smallest normal number.
#[inline(always)]
fn power<L: Lanes>(a: F<L>, b: F<L>) -> F<L> {
    let at_zero = a.lanes().f(1.0).keep_if(a.eq(0.0) & b.eq(0.0));
    a.gt(0.0).select(a.max(f32::MIN_POSITIVE).pow(b), at_zero)
}

/// Sine and cosine of any finite angle.
#[inline(always)]
fn sin_cos<L: Lanes>(angle: F<L>) -> [F<L>; 2] {
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
fn fresnel<L: Lanes>(l: L, cosine: F<L>, eta: F<L>) -> F<L> {
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
