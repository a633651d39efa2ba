//! A rough or perfect mirror: GGX reflection with any Fresnel curve.

use super::fresnel::Curve;
use super::microfacet::{MIRROR, Widths};
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// The lobe at one view.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReflectLobe<L: Lanes> {
    widths: Widths<L>,
    curve: Curve<L>,
    /// Mirror lanes: evaluated nowhere, sampled exactly.
    pub(crate) delta: M<L>,
    bound: F<L>,
    stretch: F<L>,
}

impl<L: Lanes> ReflectLobe<L> {
    /// The lobe seen from `wo`.
    #[inline(always)]
    pub(crate) fn new(wo: Vec3<L>, widths: Widths<L>, curve: Curve<L>) -> Self {
        let delta = (widths.x * widths.y).le(MIRROR);
        let widths = Widths { x: widths.x.keep_if(!delta), y: widths.y.keep_if(!delta) };
        Self { widths, curve, delta, bound: widths.reflection_bound(wo), stretch: widths.stretch(wo) }
    }
    /// Roughness r.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        self.widths.roughness()
    }
    /// Value × cosine and pdf of a white lobe with the curve's colour.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let above = wo.z.gt(0.0) & wi.z.gt(0.0) & !self.delta;
        let l = wo.x.lanes();
        let h = (wo + wi).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
        let density = self.widths.distribution(h);
        let pair = self.stretch.mul_add(wi.z, self.widths.stretch(wi) * wo.z);
        let value = density * wi.z * 0.5 / pair;
        let pdf = density * 0.5 / self.bound.mul_add(wo.z, self.stretch);
        ((self.curve.reflectance(wo.dot(h).saturate()) * value).keep_if(above), pdf.keep_if(above))
    }
    /// A direction with the pdf of [`Self::eval`]; it may point under the surface, where the value is zero.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
        wo.reflect(self.widths.sample(wo, self.bound, u))
    }
    /// Value of the mirror lanes.
    #[inline(always)]
    pub(crate) fn mirror(&self, wo: Vec3<L>) -> Rgb<L> {
        self.curve.reflectance(wo.z.saturate()).keep_if(wo.z.gt(0.0))
    }
}
