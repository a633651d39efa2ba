//! Transmission through the base: an interface between two media, or a sheet without inside.

use super::base::Base;
use super::energy;
use super::fresnel::{self, Curve};
use super::glass::{GlassLobe, Interface};
use super::lobes::{Shape, turned};
use super::microfacet::Widths;
use super::parameter as p;
use super::reflect::ReflectLobe;
use super::resolve::Layers;
use super::switches::{Fresnel, Tint};
use gonio_simd::{F, Lanes, Rgb};

impl<L: Lanes> Layers<'_, '_, L> {
    /// Widths of the transmission.
    #[inline(always)]
    pub(super) fn transmission_widths(&self, base: &Base<L>) -> (Widths<L>, Option<[F<L>; 2]>) {
        let roughness = (base.roughness + self.get(p::TRANSMISSION_EXTRA_ROUGHNESS)).saturate();
        if self.surface.switches.transmission_isotropic { (Widths::isotropic(roughness * roughness), None) } else { self.widths(roughness) }
    }

    #[inline(always)]
    pub(super) fn glass(&mut self, base: &Base<L>) {
        let l = self.l;
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let normal = fresnel::normal_reflectance(base.bending);
        let (tint, scale) = (self.rgb(p::SPECULAR_COLOR), self.get(p::SPECULAR_SCALE));
        let depth = self.get(p::TRANSMISSION_DEPTH).gt(0.0);
        let passed = depth.select(self.white(), self.rgb(p::TRANSMISSION_COLOR).max(0.0));
        // From inside, the tint of a whole lobe stays off: it colours what comes from above.
        let interface = match self.surface.switches.tint {
            Tint::Normal => {
                let f0 = (tint * normal).saturate();
                Interface { eta: base.bending, f0: f0 * scale, f90: Rgb::grey(scale), kept: f0, passed, schlick: false }
            }
            Tint::WholeLobe => {
                let above = self.entering.select(tint, self.white()) * scale;
                Interface { eta: base.bending, f0: above * normal, f90: above, kept: Rgb::grey(normal), passed, schlick: false }
            }
        };
        let eta = self.entering.select(interface.eta, interface.eta.recip());
        let interface = Interface { eta, schlick: self.surface.switches.fresnel == Fresnel::Schlick, ..interface };
        let (widths, turn) = self.transmission_widths(base);
        let mut factor = self.white();
        if self.surface.switches.multiscatter {
            factor = energy::compensation(energy::glass(l, widths.roughness(), self.mu, eta), passed.saturate());
        }
        let weight = self.weight * presence;
        let [reflected, refracted] = interface.split(self.mu);
        let lobe = GlassLobe::new(turned(self.wo, turn), widths, interface);
        self.push(Shape::Glass(lobe), weight * factor, weight * (reflected + refracted), turn, false);
        self.weight = self.weight * (1.0 - presence);
    }

    /// A sheet of dielectric: what its two interfaces reflect and pass in all, at the view's angle (OpenPBR 1.1, thin-walled case).
    #[inline(always)]
    pub(super) fn thin_wall(&mut self, base: &Base<L>) {
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let eta = base.bending.max(1.0);
        let first = base.ends[0].lerp(base.ends[1], fresnel::dielectric_share(self.mu, eta)).saturate();
        let cos = (1.0 - (1.0 - self.mu * self.mu) / (eta * eta)).max(1e-4).sqrt();
        let colour = self.rgb(p::TRANSMISSION_COLOR).saturate().max(1e-6);
        let path = cos.recip();
        let through = Rgb::new(colour.r.pow(path), colour.g.pow(path), colour.b.pow(path));
        let entered = self.white() - first;
        let inner = first * through;
        let passed = through * entered * entered / (self.white() - inner * inner).max(1e-6);
        let reflected = first + passed * inner;
        let weight = self.weight * presence;
        let (widths, turn) = self.transmission_widths(base);
        let spread = (((eta - 1.0) * (eta - 0.5).squared() * 3.4) / (eta * eta * eta)).safe_sqrt();
        let widened = Widths { x: (widths.x * spread).min(1.0), y: (widths.y * spread).min(1.0) };
        for (widths, colour, mirrored) in [(widths, reflected, false), (widened, passed, true)] {
            let [factor, _] = self.glossy(&Curve::One, widths.roughness());
            let lobe = ReflectLobe::new(turned(self.wo, turn), widths, Curve::One);
            self.push(Shape::Reflect(lobe), weight * colour * factor, weight * colour, turn, mirrored);
        }
        self.weight = self.weight * (1.0 - presence);
    }
}
