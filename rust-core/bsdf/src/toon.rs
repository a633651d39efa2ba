//! Toon: light from a cone of even brightness about the normal or the mirror direction, which fades at its edge (Cycles' Toon BSDF).
//!
//! The value is the density of even directions in the whole cone times the brightness, whatever the cosine: wide cones keep their edge.

use core::f32::consts::{FRAC_1_PI, FRAC_PI_2};
use gonio_simd::{F, Lanes, M, Vec3};

/// Least angles of the cone and of its fading edge, radians: where less is asked for, single precision would lose the samples.
const LEAST: [f32; 2] = [2e-4, 1e-5];

/// The lobe; its colour is the slot's weight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToonLobe<L: Lanes> {
    /// Whether it is about the mirror direction.
    glossy: bool,
    /// Angle of even brightness, radians.
    full: F<L>,
    /// Angle over which it fades.
    fading: F<L>,
    /// Angle from which on it is dark, a right angle at most.
    dark: F<L>,
    /// 1 − its cosine.
    height: F<L>,
}

impl<L: Lanes> ToonLobe<L> {
    /// The lobe of size and smoothness 0 to 1, in right angles.
    #[inline(always)]
    pub(crate) fn new(size: F<L>, smooth: F<L>, glossy: bool) -> Self {
        let full = (size.saturate() * FRAC_PI_2).max(LEAST[0]);
        let fading = (smooth.saturate() * FRAC_PI_2).max(LEAST[1]);
        let dark = (full + fading).min(FRAC_PI_2);
        Self { glossy, full, fading, dark, height: versine(dark) }
    }
    /// Whether it is about the mirror direction.
    #[inline(always)]
    pub(crate) fn is_glossy(&self) -> bool {
        self.glossy
    }
    /// Albedo of the whole cone; the mirror direction's may lie partly under the surface.
    #[inline(always)]
    pub(crate) fn albedo(&self) -> F<L> {
        let ((sin_full, cos_full), (sin_dark, cos_dark)) = (self.full.sin_cos(), self.dark.sin_cos());
        let fading = cos_full - self.brightness(self.dark) * cos_dark - (sin_dark - sin_full) / self.fading;
        ((versine(self.full) + fading) / self.height).saturate()
    }
    /// Roughness r as wide as the cone.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        if self.glossy { (self.dark * (1.0 / FRAC_PI_2)).sqrt() } else { self.dark.lanes().f(1.0) }
    }
    /// The share of full brightness at an angle from the axis.
    #[inline(always)]
    fn brightness(&self, angle: F<L>) -> F<L> {
        (1.0 - (angle - self.full) / self.fading).saturate()
    }
    /// The cone's axis seen from `wo`.
    #[inline(always)]
    fn axis(&self, wo: Vec3<L>) -> Vec3<L> {
        let l = wo.x.lanes();
        if self.glossy { Vec3::new(-wo.x, -wo.y, wo.z) } else { Vec3::splat(l, [0.0, 0.0, 1.0]) }
    }
    /// Value × cosine and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (F<L>, F<L>) {
        let axis = self.axis(wo);
        // Half the angle from the chord, which is exact where cosines are not.
        let angle = ((wi - axis).length() * 0.5).min(1.0).asin() * 2.0;
        let mut inside = angle.lt(self.dark) & wi.z.ge(0.0);
        if self.glossy {
            inside &= wo.z.gt(0.0);
        }
        let pdf = (self.height.recip() * (0.5 * FRAC_1_PI)).keep_if(inside);
        (pdf * self.brightness(angle), pdf)
    }
    /// A direction with the pdf of [`Self::eval`], and whether it is over the surface.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 2]) -> (Vec3<L>, M<L>) {
        let below = self.height * u[0];
        let sin = (below * (2.0 - below)).safe_sqrt();
        let (sin_phi, cos_phi) = u[1].sin_cos_turns();
        let local = Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - below);
        if !self.glossy {
            return (local, local.z.ge(0.0));
        }
        let wi = gonio_simd::Frame::from_normal(self.axis(wo)).to_world(local);
        (wi, wi.z.gt(0.0) & wo.z.gt(0.0))
    }
}

/// 1 − the cosine of an angle, without cancellation.
#[inline(always)]
fn versine<L: Lanes>(angle: F<L>) -> F<L> {
    let (sin, _) = (angle * 0.5).sin_cos();
    sin * sin * 2.0
}
