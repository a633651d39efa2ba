//! The hair model of Chiang et al., A Practical and Controllable Hair and Fur Model for Production Path Tracing, 2016; as pbrt (4th edition,
//! section 9.9) and Cycles (Principled Hair) have it, with MaterialX' tints.
//!
//! Light that a dielectric cylinder reflects (R), lets pass (TT), reflects inside once (TRT) or more often (the rest), each with a lobe of its
//! own along and about the fibre. Where the ray meets the cylinder is read from the view about the normal: h = sin γo is its offset across it.

use super::super::fresnel::dielectric;
use super::{across, azimuthal, between, longitudinal, towards};
use core::f32::consts::PI;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// Lobes with an azimuth of their own.
const NAMED: usize = 3;
/// Their tilts in tilts of the cuticle's scales.
const TILTS: [f32; NAMED] = [2.0, -1.0, -4.0];

/// Scale of the logistic distribution over the width of the Gaussian that it stands for, √(π/8).
const LOGISTIC: f32 = 0.626_657_07;

/// What a fibre is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Appearance<L: Lanes> {
    /// Index of refraction.
    pub(crate) ior: F<L>,
    /// Absorption coefficient inside, in units of one over the radius.
    pub(crate) absorption: Spectrum<L>,
    /// Variances of R, TT, TRT along the fibre, in radians squared for small ones.
    pub(crate) variances: [F<L>; NAMED],
    /// Widths of the same about it, in radians: those of Gaussians that the logistic distributions stand for.
    pub(crate) scales: [F<L>; NAMED],
    /// Tilt of the cuticle's scales, radians.
    pub(crate) tilt: F<L>,
    /// Factors on R, TT and TRT; the rest takes the last.
    pub(crate) tints: [Spectrum<L>; NAMED],
}

/// The lobes seen from one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FibreLobe<L: Lanes> {
    /// Cosine and sine of the view's azimuth.
    azimuth: [F<L>; 2],
    /// Sines and cosines of the view's θ as each lobe sees it.
    views: [[F<L>; 2]; NAMED + 1],
    /// One over the variances; the rest has the last.
    narrow: [F<L>; NAMED],
    /// One over the scales.
    sharp: [F<L>; NAMED],
    /// Middles of the lobes about the fibre, from the view on.
    middles: [F<L>; NAMED],
    /// What each lobe scatters of the light.
    amounts: [Spectrum<L>; NAMED + 1],
    /// Norms of the lobes' distributions.
    norms: [F<L>; NAMED + 1],
}

impl<L: Lanes> FibreLobe<L> {
    /// The lobes seen from `wo`.
    #[inline(always)]
    pub(crate) fn new(wo: Vec3<L>, fibre: &Appearance<L>) -> Self {
        let l = wo.x.lanes();
        let (sin, (cos, azimuth)) = (wo.x.clamp(-1.0, 1.0), across(wo));
        let [h, cos_gamma] = [-azimuth[0], azimuth[1].max(0.0)];
        let ior = fibre.ior.max(1.0 + 1e-4);
        // Bravais' index: refraction about the fibre of light that runs along it.
        let sin_inner = (h * cos / (ior * ior - sin * sin).sqrt()).clamp(-1.0, 1.0);
        let cos_inner = (1.0 - sin_inner * sin_inner).safe_sqrt();
        let sin_along = sin / ior;
        let length = cos_inner * 2.0 / (1.0 - sin_along * sin_along).sqrt();
        let passed = (fibre.absorption.max(0.0) * -length).exp();
        let amounts = amounts(dielectric(cos * cos_gamma, ior), passed, &fibre.tints);
        let [outer, inner] = [h.clamp(-1.0, 1.0).asin(), sin_inner.asin()];
        let zero = l.f(0.0);
        let mut lobe = Self {
            azimuth,
            views: [[sin, cos]; NAMED + 1],
            narrow: [zero; NAMED],
            sharp: [zero; NAMED],
            middles: [zero; NAMED],
            amounts,
            norms: [zero; NAMED + 1],
        };
        for (p, times) in TILTS.iter().enumerate() {
            let (sin_tilt, cos_tilt) = (fibre.tilt * *times).sin_cos();
            let tilted = cos.mul_add(cos_tilt, -(sin * sin_tilt)).abs();
            lobe.views[p] = [sin.mul_add(cos_tilt, cos * sin_tilt), tilted];
            lobe.narrow[p] = fibre.variances[p].clamp(longitudinal::VARIANCES[0], longitudinal::VARIANCES[1]).recip();
            lobe.sharp[p] = (fibre.scales[p] * LOGISTIC).clamp(azimuthal::SCALES[0], azimuthal::SCALES[1]).recip();
            #[allow(clippy::cast_precision_loss, reason = "three lobes")]
            let times = p as f32;
            lobe.middles[p] = inner * (2.0 * times) - outer * 2.0 + PI * times;
            lobe.norms[p] = longitudinal::norm(lobe.narrow[p]) * azimuthal::norm(lobe.sharp[p]);
        }
        lobe.norms[NAMED] = longitudinal::norm(lobe.narrow[NAMED - 1]) * (0.5 / PI);
        lobe
    }
    /// Share of light that is scattered.
    #[inline(always)]
    pub(crate) fn albedo(&self) -> Spectrum<L> {
        let [r, tt, trt, rest] = self.amounts;
        r + tt + trt + rest
    }
    /// Roughness r about as wide as the narrowest lobe along the fibre.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        self.narrow[1].inverse_root().sqrt().saturate()
    }
    /// Value, which has the cosine in it, and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        eval(wi.x.lanes(), self, wi)
    }
    /// A direction with the pdf of [`Self::eval`], and whether it is not of the lobe that the surface reflects.
    #[inline(always)]
    pub(crate) fn sample(&self, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        sample(u[0].lanes(), self, u)
    }
    #[inline(always)]
    fn eval_lanes(&self, l: L, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let (cos, azimuth) = across(wi);
        let turn = between(self.azimuth, azimuth);
        let (phi, theta) = (turn[1].atan2(turn[0]), [wi.x.clamp(-1.0, 1.0), cos]);
        let (mut value, mut density, mut total) = (Spectrum::zero(l), l.f(0.0), l.f(0.0));
        for p in 0..=NAMED {
            let along = longitudinal::value(theta, self.views[p], self.narrow[p.min(NAMED - 1)]);
            let about = if p < NAMED { azimuthal::value(phi - self.middles[p], self.sharp[p]) } else { l.f(1.0) };
            let shape = along * about * self.norms[p];
            let share = self.amounts[p].mean();
            value += self.amounts[p] * shape;
            density = share.mul_add(shape, density);
            total += share;
        }
        (value, density / total.max(1e-20))
    }
    #[inline(always)]
    fn sample_lanes(&self, l: L, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        let mut point = u[0] * self.albedo().mean();
        let ([mut narrow, mut sharp, mut middle], mut view) = ([self.narrow[2], l.f(0.0), l.f(0.0)], self.views[NAMED]);
        // What is left over of the choice, as a number of its own.
        let (mut rest, mut found, mut reflected) = (l.f(0.5), l.m(false), l.m(false));
        for p in 0..=NAMED {
            let share = self.amounts[p].mean();
            let here = (if p < NAMED { point.lt(share) } else { l.m(true) }).and_not(found);
            found |= here;
            if p == 0 {
                reflected = here;
            }
            rest = here.select((point / share.max(1e-20)).clamp(1e-7, 1.0 - 1e-7), rest);
            point -= share;
            if p < NAMED {
                narrow = here.select(self.narrow[p], narrow);
                sharp = here.select(self.sharp[p], sharp);
                middle = here.select(self.middles[p], middle);
                view = [here.select(self.views[p][0], view[0]), here.select(self.views[p][1], view[1])];
            }
        }
        let even = sharp.eq(0.0);
        let about = azimuthal::sample(even.select(l.f(1.0), sharp), rest);
        let (sin_turn, cos_turn) = even.select((rest - 0.5) * (2.0 * PI), middle + about).sin_cos();
        let sin = longitudinal::sample(view, narrow, [u[1], u[2]]);
        let wi = towards([sin, (1.0 - sin * sin).safe_sqrt()], self.azimuth, [cos_turn, sin_turn]);
        (wi, !reflected)
    }
}

/// [`FibreLobe::eval`] as a function of its own: most surfaces should not carry its registers.
#[inline(never)]
fn eval<L: Lanes>(l: L, lobe: &FibreLobe<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || lobe.eval_lanes(l, wi),
    )
}

/// [`FibreLobe::sample`] as a function of its own.
#[inline(never)]
fn sample<L: Lanes>(l: L, lobe: &FibreLobe<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
    l.vectorize(
        #[inline(always)]
        || lobe.sample_lanes(l, u),
    )
}

/// What R, TT, TRT and the rest scatter, for reflectance `f` and what is left of light on one way through.
#[inline(always)]
fn amounts<L: Lanes>(f: F<L>, passed: Spectrum<L>, tints: &[Spectrum<L>; NAMED]) -> [Spectrum<L>; NAMED + 1] {
    let inside = passed * f;
    let tt = passed * (1.0 - f).squared();
    let trt = tt * inside;
    // The rest is a geometric series.
    let rest = trt * inside / (Spectrum::one(f.lanes()) - inside).max(1e-6);
    let [r_tint, tt_tint, trt_tint] = *tints;
    [r_tint.max(0.0) * f, tt * tt_tint.max(0.0), trt * trt_tint.max(0.0), rest * trt_tint.max(0.0)]
}
