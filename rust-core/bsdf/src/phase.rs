//! Phase functions: how what floats in a medium scatters light, per solid angle, by the cosine between the directions before and after.
//!
//! Their integral over all directions is 1. Henyey and Greenstein, Diffuse Radiation in the Galaxy (1941). [`Phase`] names all of them, and
//! [`PhaseTable`] evaluates and draws those that a scene has.

mod kind;
mod table;

use core::f32::consts::PI;
use gonio_simd::{F, Frame, Lanes, Vec3};
pub use kind::Phase;
pub use table::PhaseTable;

/// Mean cosines nearer to 0 than this scatter evenly.
const EVEN: f32 = 1e-3;

/// Henyey and Greenstein's function of a mean cosine g above −1 and below 1.
#[inline(always)]
pub fn henyey_greenstein<L: Lanes>(g: F<L>, cos: F<L>) -> F<L> {
    let base = (g.mul_add(g, 1.0) - g * cos * 2.0).max(1e-9);
    (1.0 - g * g) / (base * base.sqrt()) * (0.25 / PI)
}

/// A direction after such a scattering of light that goes along `direction`; its density is the function, so that no factor remains.
#[inline(always)]
pub fn sample_henyey_greenstein<L: Lanes>(g: F<L>, direction: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
    let even = g.abs().lt(EVEN);
    let safe = even.select(g.lanes().f(0.5), g);
    let part = (1.0 - safe * safe) / (1.0 - safe + safe * u[0] * 2.0);
    let cos = even.select(1.0 - u[0] * 2.0, (safe.mul_add(safe, 1.0) - part * part) / (safe * 2.0)).clamp(-1.0, 1.0);
    turned(direction, cos, (1.0 - cos * cos).safe_sqrt(), u[1])
}

/// A direction at an angle to another, so many turns about it.
#[inline(always)]
fn turned<L: Lanes>(direction: Vec3<L>, cos: F<L>, sin: F<L>, turns: F<L>) -> Vec3<L> {
    let (sin_phi, cos_phi) = turns.sin_cos_turns();
    Frame::from_normal(direction).to_world(Vec3::new(sin * cos_phi, sin * sin_phi, cos)).normalize()
}
