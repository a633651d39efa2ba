//! Transmission through the base: an interface between two media, or a sheet without inside.

use super::base::Base;
use super::dispersion::Spread;
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

    /// The interface to glass of this index, where wavelengths part ways.
    #[inline(always)]
    pub(super) fn spread(&self, ior: F<L>) -> Option<Spread<L>> {
        let carried = self.carried?;
        let indices = if self.surface.glass.is_some() { self.glass_indices(ior)? } else { self.cauchy(ior)? };
        Some(Spread::new(self.entering.select(indices, indices.recip()), carried))
    }

    /// By wavelength, the index of the surface's glass where it has this one at 587.56 nm.
    #[inline(always)]
    fn glass_indices(&self, ior: F<L>) -> Option<Spectrum<L>> {
        Some(self.wavelengths().glass(self.surface.glass?)? * ior)
    }

    /// By wavelength, Cauchy's formula of two terms through the index at 587.56 nm and the Abbe number.
    #[inline(always)]
    fn cauchy(&self, ior: F<L>) -> Option<Spectrum<L>> {
        let nanometres = self.wavelengths().nanometres()?;
        let rise = (ior - 1.0) * self.get(p::TRANSMISSION_DISPERSION);
        Some(nanometres.map(
            #[inline(always)]
            |nanometres| {
                let squared = (nanometres * nanometres).recip();
                let along = (squared - 1.0 / (D_LINE * D_LINE)) * (1.0 / (1.0 / (F_LINE * F_LINE) - 1.0 / (C_LINE * C_LINE)));
                along.mul_add(rise, ior).max(1e-5)
            },
        ))
    }

    #[inline(always)]
    pub(super) fn glass(&mut self, base: &Base<L>) {
        let l = self.l;
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let bending = base.bending;
        let plain = Interface::clear(bending, self.spread(bending));
        let normal = plain.f0;
        let (tint, scale) = (self.reflectance(p::SPECULAR_COLOR), self.get(p::SPECULAR_SCALE));
        let depth = self.get(p::TRANSMISSION_DEPTH).gt(0.0);
        let passed = depth.select(self.white(), self.reflectance(p::TRANSMISSION_COLOR).max(0.0));
        // From inside, the tint of a whole lobe stays off: it colours what comes from above.
        let interface = match self.surface.switches.tint {
            Tint::Normal => {
                // The making up for rough glass knows no interface that reflects more than its index has it.
                let f0 = tint.saturate() * normal;
                Interface { f0: f0 * scale, f90: Spectrum::constant(scale), kept: f0, passed, ..plain }
            }
            Tint::WholeLobe => {
                let above = self.entering.select(tint, self.white()) * scale;
                Interface { f0: above * normal, f90: above, passed, ..plain }
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
            let passed = interface.passed.saturate();
            let (l, roughness, mu) = (self.l, widths.roughness(), self.specular_mu);
            factor = match &interface.spread {
                Some(Spread { etas, .. }) => {
                    let [factor] = etas.own(
                        *etas,
                        #[inline(always)]
                        |eta, _| [energy::compensation(energy::glass(l, roughness, mu, eta), passed)],
                    );
                    factor
                }
                None => energy::compensation(energy::glass(l, roughness, mu, interface.eta), passed),
            };
        }
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
        let [reflected, passed] = match self.glass_indices(base.bending) {
            Some(indices) => indices.own(
                indices,
                #[inline(always)]
                |index, _| {
                    let lighter = fresnel::normal_reflectance(index) / fresnel::normal_reflectance(base.bending).max(1e-20);
                    self.sheet(index.max(1.0), [base.ends[0] * lighter, base.ends[1]])
                },
            ),
            None => self.sheet(eta, base.ends),
        };
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

    /// What a sheet of an index reflects and passes, whose interfaces reflect from the first to the second of `ends` by the angle.
    #[inline(always)]
    fn sheet(&self, eta: F<L>, ends: [Spectrum<L>; 2]) -> [Spectrum<L>; 2] {
        let cos = (1.0 - (1.0 - self.specular_mu * self.specular_mu) / (eta * eta)).max(1e-4).sqrt();
        let colour = self.reflectance(p::TRANSMISSION_COLOR).saturate().max(1e-6);
        let path = cos.recip();
        let through = colour.pow(path);
        let normal = fresnel::normal_reflectance(eta);
        // Films are those of unpolarised light.
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        let film = match self.film(self.l.f(1.0)) {
            Some(film) => Some((film.over_tinted(self.specular_mu, eta, ends[0], ends[1]), film.weight)),
            None => None,
        };
        let (mut reflected, mut passed) = (Spectrum::zero(self.l), Spectrum::zero(self.l));
        for reflectance in fresnel::dielectric_polarised(self.specular_mu, eta) {
            let mut first = ends[0].lerp(ends[1], (reflectance - normal) / (1.0 - normal)).saturate();
            if let Some((coloured, weight)) = film {
                first = first.lerp(coloured, weight);
            }
            let entered = self.white() - first;
            let inner = first * through;
            let both = through * entered * entered / (self.white() - inner * inner).max(1e-6);
            passed += both * 0.5;
            reflected += (first + both * inner) * 0.5;
        }
        [reflected, passed]
    }
}
