//! Light of the environment that rays meet on leaving the scene, weighed by MIS (multiple importance sampling).

use super::distant;
use super::light_kind::LightKind;
use super::mis::hit_weight;
use super::row::field;
use super::table::{InfiniteLight, LightTable};
use super::tree::LightCache;
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

impl LightTable {
    /// Light that a ray from `from` (normal `n` there, zero where there is no surface) along unit `wi` meets on leaving the scene: the sum of the infinite
    /// lights' radiances, each times its power-heuristic weight against `bsdf_pdf`. The weight is 1 where the ray is a camera ray (`first`,
    /// which sees visible lights alone) or was sent by a delta lobe (`delta`). Of `only` one of them, where that is asked for; of those alone that the
    /// class of `receiver`, which sent the ray, sees, and that rays of its `kind` (0 diffuse, 1 glossy, 2 transmitted) see.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "a ray and how it came to be")]
    pub fn eval_escaped<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        receiver: U<L>,
        from: Vec3<L>,
        n: Vec3<L>,
        wi: Vec3<L>,
        bsdf_pdf: F<L>,
        first: M<L>,
        delta: M<L>,
        only: Option<u32>,
        kind: U<L>,
    ) -> Spectrum<L> {
        let mut sum = Spectrum::zero(l);
        for infinite in self.infinite.iter().filter(|infinite| only.is_none_or(|only| infinite.light == only)) {
            let (radiance, pdf) = self.infinite_radiance(l, infinite, [from, n], wi);
            let weighed = (!(first | delta)) & pdf.gt(0.0);
            let mut weight = l.f(1.0);
            if weighed.any() {
                let pdf = pdf * self.light_pmf(l, light_cache, receiver, from, n, l.u(infinite.light));
                let pdf = if infinite.alone { l.f(f32::MAX) } else { pdf };
                weight = hit_weight(bsdf_pdf, pdf, weighed);
            }
            for (number, factor) in (0..3).zip(infinite.factors) {
                if factor != 1.0 {
                    weight = kind.eq(number).and_not(first).select(weight * factor, weight);
                }
            }
            let seen = (first & l.m(infinite.visible)) | l.m(infinite.scattered).and_not(first);
            sum += (radiance * weight).keep_if(seen & self.sees(l, receiver, l.u(infinite.light)));
        }
        sum
    }

    /// Radiance of one infinite light along `wi` and the density of its sampling.
    #[inline(always)]
    fn infinite_radiance<L: Lanes>(&self, l: L, infinite: &InfiniteLight, [from, n]: [Vec3<L>; 2], wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
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
