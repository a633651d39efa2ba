//! What hair models are told of a fibre, from numbers that artists choose (Chiang et al. 2016, equations 7 to 9).

use crate::finite::all_finite;
use gonio_simd::{F, Lanes};

/// Least roughness.
const LEAST: f32 = 1e-3;

/// Coefficients of x, x² and a high power.
const ALONG: [f32; 3] = [0.726, 0.812, 3.7];
/// The same about the fibre.
const ABOUT: [f32; 3] = [0.265, 1.194, 5.372];
/// Powers of the roughness about the fibre, from none on.
const ALBEDO: [f32; 6] = [5.969, -0.215, 2.532, -10.73, 5.574, 0.245];

/// Variance along the fibre and width about it of roughnesses 0 to 1.
#[inline(always)]
pub(crate) fn roughness<L: Lanes>(along: F<L>, about: F<L>) -> [F<L>; 2] {
    let width = widened(along, ALONG, 20.0);
    [width * width, widened(about, ABOUT, 22.0)]
}

#[inline(always)]
fn widened<L: Lanes>(x: F<L>, [first, second, last]: [f32; 3], power: f32) -> F<L> {
    let x = all_finite([x])[0].clamp(LEAST, 1.0);
    x.pow(power).mul_add(last, x.mul_add(second, first) * x)
}

/// The absorption coefficient with which much hair of a roughness about the fibre has a colour.
#[inline(always)]
pub(crate) fn absorption<L: Lanes>(colour: [F<L>; 3], about: F<L>) -> [F<L>; 3] {
    let about = all_finite([about])[0].saturate();
    let mut scale = about.lanes().f(ALBEDO[5]);
    for factor in ALBEDO[..5].iter().rev() {
        scale = scale.mul_add(about, *factor);
    }
    let mut absorption = all_finite(colour);
    for channel in &mut absorption {
        *channel = (channel.clamp(1e-3, 1.0).ln() / scale).squared();
    }
    absorption
}
