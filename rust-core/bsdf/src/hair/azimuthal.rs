//! Scattering about the fibre: a logistic distribution cut off half a turn from its middle (Chiang et al. 2016, section 4.2).

use core::f32::consts::{PI, TAU};
use gonio_simd::{F, Lanes};

/// Least and largest scale: what single precision can follow, and what is even anyway.
pub(super) const SCALES: [f32; 2] = [1e-4, 100.0];

/// What makes [`value`] integrate to 1 over the circle; `inverse` is one over the scale.
#[inline(always)]
pub(super) fn norm<L: Lanes>(inverse: F<L>) -> F<L> {
    let end = (inverse * -PI).exp();
    inverse * (1.0 + end) / (1.0 - end)
}

/// The distribution without its norm at an angle from its middle, any number of turns away.
#[inline(always)]
pub(super) fn value<L: Lanes>(angle: F<L>, inverse: F<L>) -> F<L> {
    let x = angle - (angle * (1.0 / TAU)).round() * TAU;
    let e = (-(x.abs() * inverse)).exp();
    e / (1.0 + e).squared()
}

/// An angle from the middle with the density of [`value`].
#[inline(always)]
pub(super) fn sample<L: Lanes>(inverse: F<L>, u: F<L>) -> F<L> {
    // Each half by itself, from the middle outwards: small shares stay exact.
    let end = (inverse * -PI).exp();
    let half = (1.0 - end) / ((1.0 + end) * 2.0);
    let away = (u * 2.0 - 1.0).abs() * half;
    let x = ((0.5 + away) / (0.5 - away).max(1e-30)).ln() / inverse;
    x.min(PI).copysign(u - 0.5)
}
