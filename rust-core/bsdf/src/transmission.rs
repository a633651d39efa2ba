//! Transmission through the base: an interface between two media, or a sheet without inside.

use super::base::Base;
use super::energy;
use super::fresnel::{self, Curve};
use super::glass::{GlassLobe, Interface};
use super::lobes::{Normal, Shape, Side};
use super::microfacet::Widths;
use super::parameter as p;
use super::reflect::ReflectLobe;
use super::resolve::Layers;
use super::switches::{Fresnel, Tint};
use super::turn::turned;
use gonio_simd::{F, Lanes, Spectrum};

/// Wavelengths of the lines d, F and C, nm, by which indices and Abbe numbers are stated.
const D_LINE: f32 = 587.56;
const F_LINE: f32 = 486.13;
const C_LINE: f32 = 656.27;

impl<L: Lanes> Layers<'_, '_, '_, L> {
    /// Widths of the transmission.
    #[inline(always)]
    pub(super) fn transmission_widths(&self, base: &Base<L>) -> (Widths<L>, Option<[F<L>; 2]>) {
        let roughness = (base.roughness + self.get(p::TRANSMISSION_EXTRA_ROUGHNESS)).saturate();
        if self.surface.switches.transmission_isotropic { (Widths::isotropic(roughness * roughness), None) } else { self.widths(roughness) }
    }

    /// The index for the wavelength that goes on alone, by Cauchy's formula of two terms through the index at 587.56 nm and the Abbe number.
    #[inline(always)]
    pub(super) fn dispersed(&self, ior: F<L>) -> F<L> {
        let Some(hero) = &self.hero else { return ior };
        let squared = (hero.nanometres * hero.nanometres).recip();
        let along = (squared - 1.0 / (D_LINE * D_LINE)) * (1.0 / (1.0 / (F_LINE * F_LINE) - 1.0 / (C_LINE * C_LINE)));
        let rise = (ior - 1.0) * self.get(p::TRANSMISSION_DISPERSION);
        along.mul_add(rise, ior).max(1e-5)
    }

    #[inline(always)]
    pub(super) fn glass(&mut self, base: &Base<L>) {
        let l = self.l;
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let bending = self.dispersed(base.bending);
        let normal = fresnel::normal_reflectance(bending);
        let (tint, scale) = (self.reflectance(p::SPECULAR_COLOR), self.get(p::SPECULAR_SCALE));
        let depth = self.get(p::TRANSMISSION_DEPTH).gt(0.0);
        let passed = depth.select(self.white(), self.reflectance(p::TRANSMISSION_COLOR).max(0.0));
        // From inside, the tint of a whole lobe stays off: it colours what comes from above.
        let interface = match self.surface.switches.tint {
            Tint::Normal => {
                // The making up for rough glass knows no interface that reflects more than its index has it.
                let f0 = tint.saturate() * normal;
                Interface { eta: bending, f0: f0 * scale, f90: Spectrum::constant(scale), kept: f0, passed, ..Interface::clear(bending) }
            }
            Tint::WholeLobe => {
                let above = self.entering.select(tint, self.white()) * scale;
                Interface {
                    eta: bending,
                    f0: above * normal,
                    f90: above,
                    kept: Spectrum::constant(normal),
                    passed,
                    ..Interface::clear(bending)
                }
            }
        };
        let eta = self.entering.select(interface.eta, interface.eta.recip());
        let film = self.film(self.entering.select(l.f(1.0), bending));
        let interface = Interface { eta, schlick: self.surface.switches.fresnel == Fresnel::Schlick, film, ..interface };
        let (widths, turn) = self.transmission_widths(base);
        self.interface(self.weight * presence, widths, turn, interface);
        self.weight = self.weight * (1.0 - presence);
    }

    /// A lobe that reflects and refracts.
    #[inline(always)]
    pub(super) fn interface(&mut self, weight: Spectrum<L>, widths: Widths<L>, turn: Option<[F<L>; 2]>, interface: Interface<L>) {
        let distribution = self.surface.switches.distribution;
        let mut factor = self.white();
        if distribution.compensates() && !interface.refracts_only {
            let table = energy::glass(self.l, widths.roughness(), self.specular_mu, interface.eta);
            factor = energy::compensation(table, interface.passed.saturate());
        }
        let interface = match &self.hero {
            Some(hero) => Interface { passed: interface.passed * hero.factor, ..interface },
            None => interface,
        };
        let [reflected, refracted] = interface.split(self.specular_mu);
        let lobe = GlassLobe::new(turned(self.specular_wo, turn), widths, interface, distribution);
        // Some facets of rough ones let light pass beyond the critical angle of the whole.
        let refracted = if interface.refracts_only { lobe.delta.select(refracted, interface.passed) } else { refracted };
        self.push(Shape::Glass(lobe), weight * factor, weight * (reflected + refracted), turn, Side::Both, Normal::Specular);
    }

    /// A sheet of dielectric: what its two interfaces reflect and pass in all, at the view's angle (OpenPBR 1.1, thin-walled case), each polarisation
    /// by itself, for the second interface meets what the first one let pass.
    #[inline(always)]
    pub(super) fn thin_wall(&mut self, base: &Base<L>) {
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let eta = base.bending.max(1.0);
        let cos = (1.0 - (1.0 - self.specular_mu * self.specular_mu) / (eta * eta)).max(1e-4).sqrt();
        let colour = self.reflectance(p::TRANSMISSION_COLOR).saturate().max(1e-6);
        let path = cos.recip();
        let through = colour.pow(path);
        let normal = fresnel::normal_reflectance(eta);
        // Films are those of unpolarised light.
        let film = match self.film(self.l.f(1.0)) {
            Some(film) => Some((film.over_tinted(self.specular_mu, eta, base.ends[0], base.ends[1]), film.weight)),
            None => None,
        };
        let (mut reflected, mut passed) = (Spectrum::zero(self.l), Spectrum::zero(self.l));
        for reflectance in fresnel::dielectric_polarised(self.specular_mu, eta) {
            let mut first = base.ends[0].lerp(base.ends[1], (reflectance - normal) / (1.0 - normal)).saturate();
            if let Some((coloured, weight)) = film {
                first = first.lerp(coloured, weight);
            }
            let entered = self.white() - first;
            let inner = first * through;
            let both = through * entered * entered / (self.white() - inner * inner).max(1e-6);
            passed += both * 0.5;
            reflected += (first + both * inner) * 0.5;
        }
        let weight = self.weight * presence;
        let (widths, turn) = self.transmission_widths(base);
        let spread = (((eta - 1.0) * (eta - 0.5).squared() * 3.4) / (eta * eta * eta)).safe_sqrt();
        let widened = Widths { x: (widths.x * spread).min(1.0), y: (widths.y * spread).min(1.0) };
        for (widths, colour, side) in [(widths, reflected, Side::Reflected), (widened, passed, Side::Mirrored)] {
            let [factor, _] = self.glossy(&Curve::One, widths.roughness());
            let lobe = ReflectLobe::new(turned(self.specular_wo, turn), widths, Curve::One, self.surface.switches.distribution);
            self.push(Shape::Reflect(lobe), weight * colour * factor, weight * colour, turn, side, Normal::Specular);
        }
        self.weight = self.weight * (1.0 - presence);
    }
}
