//! Fibres: hair, fur and fine threads, which scatter about their tangent rather than about a normal.
//!
//! In all lobes here x is along the fibre, from root to tip, and z the normal of its round surface at the hit. Angles θ are measured from the
//! plane across the fibre, φ about it.

mod azimuthal;
mod chiang;
mod elliptic;
mod facets;
mod longitudinal;
mod marschner;
mod section;

pub(crate) use chiang::{Appearance, FibreLobe};
pub use elliptic::NUMBERS;
pub(crate) use elliptic::{EllipticLobe, Fibre};
pub(crate) use marschner::MarschnerLobe;

use gonio_simd::{F, Lanes, Vec3};

/// A direction's cosine of θ, and the cosine and sine of its azimuth from y towards z; the azimuth of directions along the fibre is z's.
#[inline(always)]
fn across<L: Lanes>(v: Vec3<L>) -> (F<L>, [F<L>; 2]) {
    let l = v.x.lanes();
    let cos = v.y.mul_add(v.y, v.z * v.z).sqrt();
    let known = cos.gt(1e-12);
    let scale = cos.max(1e-12).recip();
    (cos, [(v.y * scale).keep_if(known), known.select(v.z * scale, l.f(1.0))])
}

/// Cosine and sine of the angle about the fibre from one azimuth to another.
#[inline(always)]
fn between<L: Lanes>(from: [F<L>; 2], to: [F<L>; 2]) -> [F<L>; 2] {
    [from[0].mul_add(to[0], from[1] * to[1]), from[0].mul_add(to[1], -(from[1] * to[0]))]
}

/// The direction of sine and cosine of θ that lies at an angle about the fibre, given as cosine and sine, from an azimuth.
#[inline(always)]
fn towards<L: Lanes>([sin, cos]: [F<L>; 2], from: [F<L>; 2], turn: [F<L>; 2]) -> Vec3<L> {
    let y = from[0].mul_add(turn[0], -(from[1] * turn[1]));
    let z = from[1].mul_add(turn[0], from[0] * turn[1]);
    Vec3::new(sin, cos * y, cos * z)
}
