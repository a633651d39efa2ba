//! What every finite emitter can do: sample a point of itself, and say with which density it would have been sampled.

use super::row::Reader;
use gonio_simd::{F, Lanes, Vec3};

/// A direction towards a point of an emitter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim<L: Lanes> {
    /// Unit direction.
    pub(crate) wi: Vec3<L>,
    /// Way to the point.
    pub(crate) distance: F<L>,
    /// Density per solid angle; zero, infinite or NaN where the point sends nothing here.
    pub(crate) pdf: F<L>,
    /// Place in the texture, from its first pixel.
    pub(crate) uv: [F<L>; 2],
}

impl<L: Lanes> Aim<L> {
    /// Along a vector from the lit point to the emitter's point; the density is left to the caller.
    #[inline(always)]
    pub(crate) fn towards(v: Vec3<L>) -> Self {
        let squared = v.length_squared();
        let (inverse, zero) = (squared.inverse_root(), squared.lanes().f(0.0));
        Self { wi: v * inverse, distance: squared * inverse, pdf: zero, uv: [zero; 2] }
    }
}

/// Sampling of one kind of emitter. Sidedness is the caller's business.
pub(crate) trait Emitter {
    /// Aims from `p` at a point of the emitter.
    fn sample<L: Lanes>(l: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L>;
    /// Density per solid angle at `from` of aiming along `wi` at the emitter's point `hit`, and that point's place in the texture.
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, hit: Vec3<L>) -> (F<L>, [F<L>; 2]);
}
