//! One lobe of a fibre, reflected or transmitted, after Marschner et al. 2003, as Cycles' Hair BSDF has it: a Cauchy distribution of the half
//! angle along the fibre; about it a cosine for what is reflected, and a Cauchy distribution for what passes.

use super::{across, between, towards};
use core::f32::consts::{FRAC_PI_2, PI};
use gonio_simd::{F, Lanes, M, Vec3};

/// Least width, radians.
const LEAST: f32 = 1e-3;
/// Directions nearer than this to the fibre's own, in radians, count as along it.
const ALONG: f32 = 1e-3;

/// The lobe seen from one direction; its colour is the slot's weight, its value and its density are one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MarschnerLobe<L: Lanes> {
    passes: bool,
    /// Widths along and about the fibre, radians.
    widths: [F<L>; 2],
    /// Tilt of the scales, radians.
    tilt: F<L>,
    /// The view's θ, and cosine and sine of its azimuth.
    theta: F<L>,
    azimuth: [F<L>; 2],
    /// The half angle's range as the distribution's arcs: the first, and how many.
    arcs: [F<L>; 2],
}

impl<L: Lanes> MarschnerLobe<L> {
    /// The lobe seen from `wo`.
    #[inline(always)]
    pub(crate) fn new(wo: Vec3<L>, widths: [F<L>; 2], tilt: F<L>, passes: bool) -> Self {
        let widths = [widths[0].clamp(LEAST, 1.0), widths[1].clamp(LEAST, 1.0)];
        let (cos, azimuth) = across(wo);
        let theta = wo.x.atan2(cos);
        let first = ((theta - FRAC_PI_2) * 0.5 - tilt).atan2(widths[0]);
        let last = ((theta + FRAC_PI_2) * 0.5 - tilt).atan2(widths[0]);
        Self { passes, widths, tilt, theta, azimuth, arcs: [first, last - first] }
    }
    /// Whether it is of what passes.
    #[inline(always)]
    pub(crate) fn passes(&self) -> bool {
        self.passes
    }
    /// Roughness r about as wide as the lobe.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        self.widths[0].sqrt()
    }
    /// Value, which has the cosine in it and is the pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wi: Vec3<L>) -> F<L> {
        let (cos, azimuth) = across(wi);
        let theta = wi.x.atan2(cos);
        let turn = between(self.azimuth, azimuth);
        let phi = turn[1].atan2(turn[0]).abs();
        let beside = theta.abs().lt(FRAC_PI_2 - ALONG);
        let away = (theta + self.theta) * 0.5 - self.tilt;
        let along = self.cauchy(away, 0, self.arcs[1]) * 0.5 / cos.max(1e-6);
        (along * self.about(phi)).keep_if(beside)
    }
    /// A direction with the pdf of [`Self::eval`], and whether there is one.
    #[inline(always)]
    pub(crate) fn sample(&self, u: [F<L>; 2]) -> (Vec3<L>, M<L>) {
        let (sin_arc, cos_arc) = u[0].mul_add(self.arcs[1], self.arcs[0]).sin_cos();
        let half = self.widths[0] * sin_arc / cos_arc.max(1e-7) + self.tilt;
        let theta = half * 2.0 - self.theta;
        let phi = if self.passes {
            let (sin, cos) = ((u[1] - 0.5) * self.round_arcs()).sin_cos();
            self.widths[1] * sin / cos.max(1e-7) + PI
        } else {
            (1.0 - u[1] * 2.0).clamp(-1.0, 1.0).asin() * 2.0 * self.widths[1]
        };
        let ((sin, cos), (sin_turn, cos_turn)) = (theta.sin_cos(), phi.sin_cos());
        (towards([sin, cos], self.azimuth, [cos_turn, sin_turn]), theta.abs().lt(FRAC_PI_2 - ALONG))
    }
    /// A Cauchy density of one of the widths over so many arcs.
    #[inline(always)]
    fn cauchy(&self, x: F<L>, which: usize, arcs: F<L>) -> F<L> {
        let width = self.widths[which];
        width / (x.mul_add(x, width * width) * arcs)
    }
    /// Arcs of the distribution about the fibre of what passes.
    #[inline(always)]
    fn round_arcs(&self) -> F<L> {
        self.widths[1].lanes().f(FRAC_PI_2).atan2(self.widths[1]) * 2.0
    }
    /// Density about the fibre.
    #[inline(always)]
    fn about(&self, phi: F<L>) -> F<L> {
        if self.passes {
            return self.cauchy(PI - phi, 1, self.round_arcs()).keep_if(phi.gt(FRAC_PI_2));
        }
        let width = self.widths[1];
        let x = phi / width;
        (x * 0.5).cos().keep_if(x.lt(PI)) * 0.25 / width
    }
}
