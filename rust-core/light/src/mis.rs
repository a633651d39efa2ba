//! Multiple importance sampling (MIS): how light counts that next event estimation (NEE) and BSDF sampling both may find.
//!
//! Weights are Veach's power heuristic with exponent 2: Robust Monte Carlo Methods for Light Transport Simulation (1997), section 9.2.4.

use super::sample::LightSample;
use gonio_simd::{F, Lanes, M};

/// MIS weight by the power heuristic for the first of two densities, safe for any magnitude.
#[inline(always)]
pub fn power_heuristic<L: Lanes>(own: F<L>, other: F<L>) -> F<L> {
    let ratio = other / own.max(f32::MIN_POSITIVE);
    (ratio * ratio + 1.0).recip()
}

/// The weight of a light sample.
#[derive(Clone, Copy, Debug)]
pub enum SampleWeight {
    /// Against BSDF sampling, which may find the same light. Delta lights count whole: no ray hits them.
    Mis,
    /// Its share in the mean of several fixed samples, which find all of the light.
    Fixed(f32),
}

impl SampleWeight {
    /// The weight, where BSDF sampling has the density `bsdf_pdf` towards the sample.
    #[inline(always)]
    pub fn of<L: Lanes>(self, sample: &LightSample<L>, bsdf_pdf: F<L>) -> F<L> {
        let l = bsdf_pdf.lanes();
        match self {
            Self::Mis => sample.delta.select(l.f(1.0), power_heuristic(sample.pdf, bsdf_pdf)),
            Self::Fixed(share) => l.f(share),
        }
    }
}

/// The weight of light that a ray of density `bsdf_pdf` met, and that NEE finds with density `light_pdf` where it `could_sample` it.
#[inline(always)]
pub fn hit_weight<L: Lanes>(bsdf_pdf: F<L>, light_pdf: F<L>, could_sample: M<L>) -> F<L> {
    could_sample.select(power_heuristic(bsdf_pdf, light_pdf), bsdf_pdf.lanes().f(1.0))
}
