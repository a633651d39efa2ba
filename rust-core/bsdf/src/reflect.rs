//! A rough or perfect mirror: reflection by facets of any distribution with any Fresnel curve.

use super::fresnel::Curve;
use super::microfacet::{MIRROR, Widths, beckmann, phong, sample_phong};
use super::switches::Distribution;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// The lobe at one view.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReflectLobe<L: Lanes> {
    widths: Widths<L>,
    distribution: Distribution,
    curve: Curve<L>,
    /// Mirror lanes: evaluated nowhere, sampled exactly.
    pub(crate) delta: M<L>,
    bound: F<L>,
    stretch: F<L>,
}

impl<L: Lanes> ReflectLobe<L> {
    /// The lobe seen from `wo`.
    #[inline(always)]
    pub(crate) fn new(wo: Vec3<L>, widths: Widths<L>, curve: Curve<L>, distribution: Distribution) -> Self {
        let delta = (widths.x * widths.y).le(MIRROR);
        let widths = Widths { x: widths.x.keep_if(!delta), y: widths.y.keep_if(!delta) };
        Self { widths, distribution, curve, delta, bound: widths.reflection_bound(wo), stretch: widths.stretch(wo) }
    }
    /// Roughness r.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        self.widths.roughness()
    }
    /// Value × cosine and pdf of a white lobe with the curve's colour.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let above = wo.z.gt(0.0) & wi.z.gt(0.0) & !self.delta;
        let l = wo.x.lanes();
        let h = (wo + wi).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
        let cos = wo.dot(h).saturate();
        let (value, pdf) = match self.distribution {
            Distribution::MultiGgx | Distribution::Ggx => {
                let density = self.widths.distribution(h);
                let pair = self.stretch.mul_add(wi.z, self.widths.stretch(wi) * wo.z);
                (density * wi.z * 0.5 / pair, self.visible_pdf(wo, h))
            }
            Distribution::Beckmann => {
                // GGX has the heavier tail: its visible normals serve here, at a weight of 4/e at most for the densities.
                (beckmann(l, &self.widths, wo, wi, h) * 0.25, self.visible_pdf(wo, h))
            }
            Distribution::AshikhminShirley => {
                let pdf = phong(l, &self.widths, h) * 0.25 / cos.max(1e-6);
                (pdf * wi.z / wo.z.max(wi.z), pdf)
            }
        };
        ((self.curve.reflectance(cos) * value).keep_if(above), pdf.keep_if(above))
    }
    /// Pdf of mirroring the view at visible normals of GGX.
    #[inline(always)]
    fn visible_pdf(&self, wo: Vec3<L>, h: Vec3<L>) -> F<L> {
        self.widths.distribution(h) * 0.5 / self.bound.mul_add(wo.z, self.stretch)
    }
    /// A direction with the pdf of [`Self::eval`]; it may point under the surface, where the value is zero.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
        let h = match self.distribution {
            Distribution::AshikhminShirley => {
                let l = wo.x.lanes();
                self.delta.select(Vec3::splat(l, [0.0, 0.0, 1.0]), sample_phong(l, &self.widths, u))
            }
            _ => self.widths.sample(wo, self.bound, u),
        };
        wo.reflect(h)
    }
    /// Value of the mirror lanes.
    #[inline(always)]
    pub(crate) fn mirror(&self, wo: Vec3<L>) -> Spectrum<L> {
        self.curve.reflectance(wo.z.saturate()).keep_if(wo.z.gt(0.0))
    }
}
