//! Light of a finite emitter that a ray hit, and the pdf with which NEE samples it, for MIS (multiple importance sampling).

use super::context::LightSampleContext;
use super::cylinder::Cylinder;
use super::disk::Disk;
use super::emitter::Emitter;
use super::facing_disk::FacingDisk;
use super::light_kind::LightKind;
use super::rectangle::Rectangle;
use super::row::{Reader, flag};
use super::sphere::Sphere;
use super::table::LightTable;
use super::tree::LightCache;
use super::triangle::Triangle;
use gonio_simd::{F, Lanes, M, Rgb, U, Vec3};

impl LightTable {
    /// Radiance towards `context` of the light's point `hit`, which a ray along unit `wi` met. With it the pdf per solid angle with which
    /// [`Self::sample_li`] would have sampled that point from there, endless for lights that light sampling alone finds. Both zero outside `mask`, on
    /// sides that do not emit, for lights that rays cannot hit, and for those that the receiver does not see.
    #[inline(always)]
    pub fn eval_hit<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        context: &LightSampleContext<L>,
        light: U<L>,
        [wi, hit]: [Vec3<L>; 2],
        mask: M<L>,
    ) -> (Rgb<L>, F<L>) {
        if self.count == 0 || !mask.any() {
            return (Rgb::zero(l), l.f(0.0));
        }
        let from = context.position;
        // Lanes left out follow the first one left in, so that they do not spoil a light common to all others.
        let index = mask.select(light, l.u(light.to_array()[mask.bits().trailing_zeros() as usize]));
        let light = self.reader(l, index);
        let (pdf, uv) = self.densities(l, &light, from, [wi, hit]);
        let valid = mask
            & pdf.gt(0.0)
            & pdf.is_finite()
            & self.faces(&light, from, wi)
            & light.flag(flag::LIT)
            & self.sees(l, context.receiver, index);
        let probability = self.light_pmf(l, light_cache, context, index);
        let mut pdf = pdf * probability;
        if self.any_alone {
            pdf = light.flag(flag::ALONE).select(l.f(f32::MAX), pdf);
        }
        let sent = self.fallen(l, index, hit - from, self.le(l, &light, wi, uv));
        let sent = self.filtered(l, index, hit, -wi, (hit - from).length(), sent);
        let sent = self.seen_outside(l, index, sent);
        (sent.keep_if(valid), pdf.keep_if(valid))
    }

    /// The pdf per solid angle, before lights are chosen, with which a hit point is sampled on its own light, and where on it the point lies.
    #[inline(always)]
    fn densities<L: Lanes>(&self, l: L, light: &Reader<'_, L>, from: Vec3<L>, [wi, hit]: [Vec3<L>; 2]) -> (F<L>, [F<L>; 2]) {
        let mut density = (l.f(0.0), [l.f(0.0); 2]);
        self.density_kind(
            LightKind::Rectangle,
            light,
            &mut density,
            #[inline(always)]
            || Rectangle::density(l, light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Disk,
            light,
            &mut density,
            #[inline(always)]
            || Disk::density(l, light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Sphere,
            light,
            &mut density,
            #[inline(always)]
            || Sphere::density(l, light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Cylinder,
            light,
            &mut density,
            #[inline(always)]
            || Cylinder::density(l, light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Triangle,
            light,
            &mut density,
            #[inline(always)]
            || Triangle::density(l, light, from, wi, hit),
        );
        self.density_kind(
            LightKind::FacingDisk,
            light,
            &mut density,
            #[inline(always)]
            || FacingDisk::density(l, light, from, wi, hit),
        );
        density
    }

    /// Runs one kind's density where some lane has it.
    #[inline(always)]
    fn density_kind<L: Lanes>(
        &self,
        kind: LightKind,
        light: &Reader<'_, L>,
        density: &mut (F<L>, [F<L>; 2]),
        evaluate: impl FnOnce() -> (F<L>, [F<L>; 2]),
    ) {
        if !self.has(kind) {
            return;
        }
        let of_kind = light.is_kind(kind);
        if of_kind.any() {
            let (pdf, uv) = evaluate();
            density.0 = of_kind.select(pdf, density.0);
            density.1 = [of_kind.select(uv[0], density.1[0]), of_kind.select(uv[1], density.1[1])];
        }
    }
}
