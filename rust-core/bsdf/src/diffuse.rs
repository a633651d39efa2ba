//! Diffuse reflection: Lambert, and Fujii's Oren–Nayar with the scattering between facets given back (EON; Portsmouth, Kutz, Hill 2025).
//!
//! With c = 1/2 − 2/(3π) and κ = σ / (1 + σ c), the albedo of single scattering is 1 − κ (c − G(μ)/π): every difference from 1 is formed
//! without cancellation.

use super::switches::Diffuse;
use core::f32::consts::FRAC_1_PI;
use gonio_simd::{F, Lanes, Spectrum, Vec3};

/// 1/2 − 2/(3π).
const C: f32 = 0.287_793_4;
/// (2π − 5.6) / (3π), the cosine mean of G/π.
const MEAN: f32 = 0.072_488_21;

/// The terms of a rough lobe at one view.
#[derive(Clone, Copy, Debug)]
struct Rough<L: Lanes> {
    /// A and B of single scattering, 1/π in them.
    single: [F<L>; 2],
    /// Factor of the light's c − G/π in scattering between facets, colour in it.
    between: Spectrum<L>,
}

/// The lobe at one view.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiffuseLobe<L: Lanes> {
    colour: Spectrum<L>,
    rough: Option<Rough<L>>,
}

/// G(μ)/π of the albedo of single scattering.
#[inline(always)]
fn spread<L: Lanes>(mu: F<L>) -> F<L> {
    let sin = (1.0 - mu * mu).safe_sqrt();
    let tail = sin * mu * sin.mul_add(sin + 1.0, 1.0) / (sin + 1.0);
    (sin * (mu.acos() - 2.0 / 3.0 - sin * mu) + tail * (2.0 / 3.0)) * FRAC_1_PI
}

impl<L: Lanes> DiffuseLobe<L> {
    /// Lambert's lobe.
    #[inline(always)]
    pub(crate) fn lambert(colour: Spectrum<L>) -> Self {
        Self { colour, rough: None }
    }
    /// The rough lobe of roughness `sigma` seen from `wo`.
    #[inline(always)]
    pub(crate) fn rough(wo: Vec3<L>, colour: Spectrum<L>, sigma: F<L>, model: Diffuse) -> Self {
        let l = sigma.lanes();
        let kappa = sigma / (sigma * C + 1.0);
        let a = (sigma * C + 1.0).recip() * FRAC_1_PI;
        let rho = colour.saturate();
        let lost = kappa * (C - MEAN);
        let white = Spectrum::one(l);
        let bounces = rho * rho * (1.0 - lost) / (white - rho * lost);
        let view = kappa * (C - spread(wo.z.saturate())) * (FRAC_1_PI / (C - MEAN));
        let between = match model {
            Diffuse::Eon => bounces * view,
            Diffuse::EonCubed => bounces * rho * view,
            Diffuse::OrenNayar => Spectrum::zero(l),
        };
        Self { colour, rough: Some(Rough { single: [a, a * sigma], between }) }
    }
    /// Value × cosine and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let cos = wi.z.max(0.0);
        let pdf = cos * FRAC_1_PI;
        let Some(rough) = self.rough else { return (self.colour * pdf, pdf) };
        let s = wo.x.mul_add(wi.x, wo.y * wi.y);
        let t = s.gt(0.0).select(s / wo.z.max(wi.z).max(1e-6), s);
        let single = rough.single[1].mul_add(t, rough.single[0]);
        let value = (self.colour * single + rough.between * (C - spread(cos.min(1.0)))) * cos;
        (value, pdf)
    }
    /// A cosine-distributed direction.
    #[inline(always)]
    pub(crate) fn sample(u: [F<L>; 2]) -> Vec3<L> {
        let radius = u[0].sqrt();
        let (sin, cos) = u[1].sin_cos_turns();
        Vec3::new(radius * cos, radius * sin, (1.0 - u[0]).safe_sqrt())
    }
}
