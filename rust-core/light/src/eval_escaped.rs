//! Light of the environment that rays meet on leaving the scene, weighed by MIS (multiple importance sampling).

use super::context::LightSampleContext;
use super::distant;
use super::light_kind::LightKind;
use super::mis::hit_weight;
use super::row::field;
use super::table::{InfiniteLight, LightTable};
use super::tree::LightCache;
use gonio_simd::{F, Lanes, M, Rgb, Spectrum, U, Vec3, Wavelengths};

/// A ray that left the scene.
#[derive(Clone, Copy, Debug)]
pub struct EscapedRay<L: Lanes> {
    /// Unit direction.
    pub direction: Vec3<L>,
    /// Density per solid angle with which scattering found it.
    pub pdf: F<L>,
    /// Whether it is a camera ray, which sees visible lights alone.
    pub first: M<L>,
    /// Whether a delta lobe sent it.
    pub delta: M<L>,
    /// What scattered it: 0 diffuse, 1 glossy, 2 transmitted.
    pub kind: U<L>,
}

impl LightTable {
    /// Light that a ray from a point meets on leaving the scene: the sum of the infinite lights' radiances, each times its power-heuristic weight against
    /// the ray's density. The weight is 1 where the ray is a camera ray or was sent by a delta lobe. Of `only` one of them, where that is asked for; of
    /// those alone that the point, which sent the ray, and rays of its kind see.
    #[inline(always)]
    pub fn eval_escaped<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        from: &LightSampleContext<L>,
        ray: &EscapedRay<L>,
        only: Option<u32>,
        wavelengths: Wavelengths<'_, L>,
    ) -> Spectrum<L> {
        let EscapedRay { direction: wi, pdf: bsdf_pdf, first, delta, kind } = *ray;
        let mut sum = Spectrum::zero(l);
        for infinite in self.infinite.iter().filter(|infinite| only.is_none_or(|only| infinite.light == only)) {
            let (radiance, pdf) = self.infinite_radiance(l, infinite, [from.position, from.normal], wi);
            let weighed = (!(first | delta)) & pdf.gt(0.0);
            let mut weight = l.f(1.0);
            if weighed.any() {
                let pdf = pdf * self.light_pmf(l, light_cache, from, l.u(infinite.light));
                let pdf = if infinite.alone { l.f(f32::MAX) } else { pdf };
                weight = hit_weight(bsdf_pdf, pdf, weighed);
            }
            for (number, factor) in (0..4).zip(infinite.factors) {
                if factor != 1.0 {
                    weight = kind.eq(number).and_not(first).select(weight * factor, weight);
                }
            }
            let seen = (first & l.m(infinite.visible)) | l.m(infinite.scattered).and_not(first);
            let radiance = self.light(wavelengths, l.u(infinite.light), radiance);
            sum += (radiance * weight).keep_if(seen & self.sees(l, from.receiver, l.u(infinite.light)));
        }
        sum
    }

    /// Radiance of one infinite light along `wi` and the density of its sampling.
    #[inline(always)]
    fn infinite_radiance<L: Lanes>(&self, l: L, infinite: &InfiniteLight, [from, n]: [Vec3<L>; 2], wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let light = self.reader(l, l.u(infinite.light));
        if infinite.kind == LightKind::Distant {
            let (inside, density) = distant::density(&light, wi);
            return (light.colour(field::RADIANCE).keep_if(inside), density.keep_if(inside));
        }
        let (mut pdf, place) = self.dome_density(l, infinite, n, wi);
        if let Some(portals) = self.portals_at(l, from) {
            pdf = self.portal_density(l, &portals, from, wi, pdf);
        }
        (self.le(l, &light, wi, place), pdf)
    }
}
