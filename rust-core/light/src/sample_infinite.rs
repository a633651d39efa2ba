//! Sampling directions to infinite lights: domes (environments) and distant lights.

use super::context::LightSampleContext;
use super::emitter::Aim;
use super::light_kind::LightKind;
use super::portal::Portals;
use super::row::{Reader, flag};
use super::table::{InfiniteLight, LightTable};
use super::{distant, dome};
use gonio_simd::{F, Lanes, U, Vec3};

impl InfiniteLight {
    /// The normal about which an even dome is sampled: none where light sampling alone has to find what comes from behind the surface too.
    #[inline(always)]
    fn normal<L: Lanes>(&self, l: L, n: Vec3<L>) -> Vec3<L> {
        if self.alone { Vec3::splat(l, [0.0; 3]) } else { n }
    }
}

impl LightTable {
    /// Samples a direction to infinite lights.
    #[inline(always)]
    pub(super) fn sample_infinite<L: Lanes>(
        &self,
        l: L,
        light: &Reader<'_, L>,
        index: U<L>,
        from: &LightSampleContext<L>,
        u: &[F<L>; 2],
        aim: &mut Aim<L>,
    ) {
        if !light.flag(flag::INFINITE).any() {
            return;
        }
        let (p, n, u) = (from.position, from.normal, *u);
        if self.has(LightKind::Distant) {
            let of_kind = light.is_kind(LightKind::Distant);
            let (wi, pdf) = distant::sample(l, light, u);
            aim.wi = of_kind.select(wi, aim.wi);
            aim.pdf = of_kind.select(pdf, aim.pdf);
        }
        for infinite in self.infinite.iter().filter(|infinite| infinite.kind == LightKind::Dome) {
            let chosen = index.eq(infinite.light);
            if !chosen.any() {
                continue;
            }
            let (wi, pdf, place) = match self.portals_at(l, p) {
                Some(portals) => self.sample_dome_with_portals(l, infinite, &portals, [p, n], u),
                None => self.sample_dome(l, infinite, n, u),
            };
            aim.wi = chosen.select(wi, aim.wi);
            aim.pdf = chosen.select(pdf, aim.pdf);
            aim.uv = [chosen.select(place[0], aim.uv[0]), chosen.select(place[1], aim.uv[1])];
        }
    }

    /// A direction to a dome by its own brightness, its density and its place in the image.
    #[inline(always)]
    fn sample_dome<L: Lanes>(&self, l: L, infinite: &InfiniteLight, n: Vec3<L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>, [F<L>; 2]) {
        match &infinite.distribution {
            Some(distribution) => {
                let (local, pdf, place) = distribution.sample(l, u);
                (local.transform(self.reader(l, l.u(infinite.light)).frame()), pdf, place)
            }
            None => {
                let (wi, pdf) = dome::sample_constant(l, infinite.normal(l, n), u);
                (wi, pdf, [l.f(0.0); 2])
            }
        }
    }

    /// The same where some directions go through portals.
    #[inline(always)]
    fn sample_dome_with_portals<L: Lanes>(
        &self,
        l: L,
        infinite: &InfiniteLight,
        portals: &Portals<L>,
        [p, n]: [Vec3<L>; 2],
        u: [F<L>; 2],
    ) -> (Vec3<L>, F<L>, [F<L>; 2]) {
        let (through, of_portal, of_dome) = self.split_by_portal(portals, u[0]);
        let (wi, _, _) = self.sample_dome(l, infinite, n, [of_dome, u[1]]);
        let wi = through.select(self.sample_portal(l, portals, p, [of_portal, u[1]]), wi);
        let (pdf, place) = self.dome_density(l, infinite, n, wi);
        (wi, self.portal_density(l, portals, p, wi, pdf), place)
    }

    /// Density of a direction to a dome by its own brightness, and its place in the image.
    #[inline(always)]
    pub(super) fn dome_density<L: Lanes>(&self, l: L, infinite: &InfiniteLight, n: Vec3<L>, wi: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        match &infinite.distribution {
            Some(distribution) => {
                let local = self.reader(l, l.u(infinite.light)).in_frame(wi);
                let place = dome::place(local);
                (distribution.pdf(l, local, place), place)
            }
            None => (dome::pdf_constant(l, infinite.normal(l, n), wi), [l.f(0.0); 2]),
        }
    }
}
