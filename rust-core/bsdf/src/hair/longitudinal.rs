//! Scattering along the fibre: a wrapped Gaussian on the sphere (d'Eon et al., An Energy-Conserving Hair Reflectance Model, 2011, section 4).
//!
//! M(θi, θo) = e^(−(1 + sin θi sin θo) / v) I₀(cos θi cos θo / v) / (v (1 − e^(−2/v))), written so that no exponent is the difference of large
//! numbers: its integral over cos θi dθi is 1.

use gonio_simd::{F, Lanes};

/// Least and largest variance: narrower lobes than single precision can follow, and wider ones than any sphere shows.
pub(super) const VARIANCES: [f32; 2] = [1e-7, 200.0];

/// I₀(x) e^(−x) for x ≥ 0 (Abramowitz and Stegun, 9.8.1 and 9.8.2), times e^(−rest).
#[inline(always)]
fn scaled_bessel<L: Lanes>(x: F<L>, rest: F<L>) -> F<L> {
    const SMALL: [f32; 7] = [1.0, 3.515_622_9, 3.089_942_4, 1.206_749_2, 0.265_973_2, 0.036_076_8, 0.004_581_3];
    const LARGE: [f32; 9] =
        [0.398_942_3, 0.013_285_92, 0.002_253_19, -0.001_575_65, 0.009_162_81, -0.020_577_06, 0.026_355_37, -0.016_476_33, 0.003_923_77];
    let large = x.gt(3.75);
    let scale = (-(rest + large.select(x.lanes().f(0.0), x))).exp();
    let t = (x * (1.0 / 3.75)).squared().min(1.0);
    let mut near = x.lanes().f(SMALL[6]);
    for factor in SMALL[..6].iter().rev() {
        near = near.mul_add(t, *factor);
    }
    let t = 3.75 / x.max(3.75);
    let mut far = x.lanes().f(LARGE[8]);
    for factor in LARGE[..8].iter().rev() {
        far = far.mul_add(t, *factor);
    }
    scale * large.select(far * x.max(3.75).inverse_root(), near)
}

/// What makes [`value`] integrate to 1, for a variance within [`VARIANCES`].
#[inline(always)]
pub(super) fn norm<L: Lanes>(inverse: F<L>) -> F<L> {
    inverse / (1.0 - (inverse * -2.0).exp())
}

/// M without its norm at `[sin, cos]` of both angles; `inverse` is one over the variance.
#[inline(always)]
pub(super) fn value<L: Lanes>(i: [F<L>; 2], o: [F<L>; 2], inverse: F<L>) -> F<L> {
    // 1 − cos(θi + θo) from the chord to the mirror direction.
    let chord = (i[0] + o[0]).squared() + (i[1] - o[1]).squared();
    scaled_bessel(i[1] * o[1] * inverse, chord * 0.5 * inverse)
}

/// Sine of an angle θi with the density of [`value`] times cos θi.
#[inline(always)]
pub(super) fn sample<L: Lanes>(o: [F<L>; 2], inverse: F<L>, u: [F<L>; 2]) -> F<L> {
    // 1 − the cosine of the angle to the mirror direction.
    let whole = (inverse * -2.0).exp();
    let fall = -(u[0].max(1e-30).mul_add(1.0 - whole, whole).ln() / inverse);
    let fall = fall.clamp(0.0, 2.0);
    let sin = (fall * (2.0 - fall)).safe_sqrt();
    let (_, cos_turn) = u[1].sin_cos_turns();
    (sin * cos_turn).mul_add(o[1], -((1.0 - fall) * o[0])).clamp(-1.0, 1.0)
}
