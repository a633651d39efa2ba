//! The coat: a dielectric layer, its colour, and what its inner reflections take from the base.

use super::energy;
use super::fresnel::{self, Curve};
use super::lobes::{CoatTint, Normal, Shape, Side};
use super::measured::MeasuredLobe;
use super::microfacet::Widths;
use super::parameter as p;
use super::reflect::ReflectLobe;
use super::resolve::Layers;
use super::switches::{CoatPath, Distribution};
use gonio_simd::{F, Lanes, Spectrum};

impl<L: Lanes> Layers<'_, '_, '_, L> {
    #[inline(always)]
    pub(super) fn coat(&mut self) {
        let (l, switches) = (self.l, self.surface.switches);
        let presence = self.get(p::COAT_WEIGHT);
        let roughness = self.get(p::COAT_ROUGHNESS).saturate();
        let ior = self.get(if switches.coat_has_base_ior { p::IOR } else { p::COAT_IOR }).max(1.0);
        let curve = self.dielectric_curve(ior, Spectrum::constant(fresnel::normal_reflectance(ior)), self.white());
        let table = energy::reflect(l, roughness, self.coat_mu);
        let factor = energy::compensation(table, curve.mean(l));
        let albedo = energy::tinted(l, &curve, roughness, self.coat_mu) * factor * table[0] * presence;
        let lobe = ReflectLobe::new(self.coat_wo, Widths::isotropic(roughness * roughness), curve, Distribution::MultiGgx);
        self.push(Shape::Reflect(lobe), self.weight * factor * presence, self.weight * albedo, None, Side::Reflected, Normal::Coat);
        if switches.coat_darkens {
            self.weight = self.weight * self.darkening(presence, ior, &curve);
        }
        if self.surface.lobes.coat_tint {
            self.coat_tint(presence, ior);
        }
        self.attenuate(albedo);
    }

    #[inline(always)]
    pub(super) fn coat_tint(&mut self, presence: F<L>, ior: F<L>) {
        let colour = self.reflectance(p::COAT_COLOR).max(1e-6);
        let view = (1.0 - (1.0 - self.coat_mu * self.coat_mu) / (ior * ior)).max(1e-4).inverse_root();
        let tint = CoatTint { log: colour.ln(), weight: presence, ior, view };
        match self.surface.switches.coat_path {
            CoatPath::Both => {
                self.lobes.coat = Some(tint);
                self.coated = true;
            }
            CoatPath::View => self.weight = self.weight * tint.along(view),
            CoatPath::Flat => self.weight = self.weight * self.white().lerp(colour, presence),
        }
    }

    /// Loss to repeated reflection between base and coat (OpenPBR 1.1, coat darkening).
    #[inline(always)]
    pub(super) fn darkening(&self, presence: F<L>, ior: F<L>, coat: &Curve<L>) -> Spectrum<L> {
        let (below, rough_share) = match &self.surface.measured {
            Some(bsdf) => {
                let lobe = MeasuredLobe::new(bsdf, bsdf.front(self.l, self.entering), self.wavelengths());
                let albedo = lobe.albedo(self.coat_wo) * self.reflectance(p::BASE_COLOR) * self.get(p::SPECULAR_SCALE);
                (albedo.saturate(), self.l.f(lobe.roughness()))
            }
            None => self.base_albedo(),
        };
        let diffuse = 1.0 - (1.0 - coat.mean(self.l).constant_value()) / (ior * ior);
        let inside = coat.reflectance(self.coat_mu).constant_value().lerp(diffuse, rough_share);
        let kept = Spectrum::constant(1.0 - inside) / (self.white() - below * inside);
        self.white().lerp(kept, presence * self.get(p::COAT_DARKENING))
    }

    /// What the base gives back, and how far it spreads it: 0 is a mirror, 1 is diffuse.
    #[inline(always)]
    fn base_albedo(&self) -> (Spectrum<L>, F<L>) {
        let base = self.reflectance(p::BASE_COLOR).saturate();
        let metalness = self.get(p::METALNESS).saturate();
        let passed = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let body = base.lerp(self.reflectance(p::SUBSURFACE_COLOR).saturate(), self.get(p::SUBSURFACE_WEIGHT).saturate()) * (1.0 - passed);
        let below = body.lerp(base * self.get(p::METAL_WEIGHT).saturate(), metalness);
        let roughness = self.get(p::ROUGHNESS).saturate();
        let f0 = fresnel::normal_reflectance(self.get(p::IOR)) * self.get(p::SPECULAR_WEIGHT);
        (below, self.l.f(1.0).lerp(roughness, f0.saturate()).lerp(roughness, metalness))
    }
}
