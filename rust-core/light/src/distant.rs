//! Distant lights: every direction in a cone about +z of the light's axes.

use super::row::{Reader, field, flag};
use gonio_simd::{F, Frame, Lanes, M, Vec3};
use std::f32::consts::TAU;

/// A direction in the cone and its density; the axis and 1 for parallel light.
#[inline(always)]
pub(crate) fn sample<L: Lanes>(l: L, light: &Reader<'_, L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>) {
    let towards = -light.vector(field::AXIS);
    let one_minus_cosine = light.value(field::ONE_MINUS_COSINE);
    let fall = one_minus_cosine * u[0];
    let sine = (fall * (2.0 - fall)).safe_sqrt();
    let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
    let wi = Frame::from_normal(towards).to_world(Vec3::new(sine * cosine_turn, sine * sine_turn, 1.0 - fall));
    let parallel = light.flag(flag::DELTA);
    (parallel.select(towards, wi), parallel.select(l.f(1.0), (one_minus_cosine * TAU).recip()))
}

/// Whether a direction lies in the cone, and its density there; never for parallel light.
#[inline(always)]
pub(crate) fn density<L: Lanes>(light: &Reader<'_, L>, wi: Vec3<L>) -> (M<L>, F<L>) {
    let one_minus_cosine = light.value(field::ONE_MINUS_COSINE);
    // Half the squared chord is 1 − cos without its cancellation.
    let fall = (wi + light.vector(field::AXIS)).length_squared() * 0.5;
    let inside = fall.le(one_minus_cosine).and_not(light.flag(flag::DELTA));
    (inside, (one_minus_cosine * TAU).recip())
}
