//! Metal and the dielectric reflection of the base, with the widths and indices that the layers above leave them.

use super::energy;
use super::film::Film;
use super::fresnel::{self, Curve};
use super::lobes::{Normal, Shape, Side};
use super::microfacet::Widths;
use super::parameter as p;
use super::reflect::ReflectLobe;
use super::resolve::Layers;
use super::switches::{Anisotropy, Fresnel, Metal, Tint};
use super::turn::turned;
use gonio_simd::{F, Lanes, Spectrum};

/// The dielectric base at a hit.
pub(super) struct Base<L: Lanes> {
    /// Roughness r under the coat.
    pub(super) roughness: F<L>,
    pub(super) widths: Widths<L>,
    pub(super) turn: Option<[F<L>; 2]>,
    /// Index that bends transmitted light.
    pub(super) bending: F<L>,
    /// Reflection from above.
    pub(super) curve: Curve<L>,
    /// Index that shapes it.
    pub(super) eta: F<L>,
    /// Its ends.
    pub(super) ends: [Spectrum<L>; 2],
}

impl<L: Lanes> Layers<'_, '_, '_, L> {
    /// Roughness of the base under the coat.
    #[inline(always)]
    pub(super) fn base_roughness(&self) -> F<L> {
        let mut roughness = self.get(p::ROUGHNESS).saturate();
        if self.surface.lobes.coat {
            let (presence, coat) = (self.get(p::COAT_WEIGHT), self.get(p::COAT_ROUGHNESS).saturate());
            if self.surface.switches.coat_roughens {
                let widened = (roughness.squared().squared() + coat.squared().squared() * 2.0).min(1.0).sqrt().sqrt();
                roughness = roughness.lerp(widened, presence);
            }
            let affected = self.get(p::COAT_AFFECT_ROUGHNESS) * presence * coat;
            roughness = roughness.lerp(1.0, affected);
        }
        roughness
    }

    /// Widths and turn of metal and specular lobes.
    #[inline(always)]
    pub(super) fn widths(&self, roughness: F<L>) -> (Widths<L>, Option<[F<L>; 2]>) {
        let alpha = roughness * roughness;
        if !self.surface.lobes.anisotropic {
            return (Widths::isotropic(alpha), None);
        }
        let k = self.get(p::ANISOTROPY);
        let widths = match self.surface.switches.anisotropy {
            Anisotropy::OpenPbr => {
                let q = (1.0 - k).max(1e-3);
                let x = alpha * (2.0 / (q * q + 1.0)).sqrt();
                Widths { x, y: x * q }
            }
            Anisotropy::Principled => Widths::with_aspect(alpha, (1.0 - k.saturate() * 0.9).sqrt()),
            Anisotropy::StandardSurface => Widths::with_aspect(alpha, (1.0 - k.min(0.98)).sqrt()),
            Anisotropy::Gltf => Widths { x: alpha.lerp(1.0, k * k), y: alpha },
            Anisotropy::Glossy => {
                let q = 1.0 - k.abs().min(0.99);
                let (narrow, wide) = (alpha * q, (alpha / q).min(1.0));
                let along = k.ge(0.0);
                Widths { x: along.select(narrow, wide), y: along.select(wide, narrow) }
            }
        };
        if !self.surface.lobes.turned {
            return (widths, None);
        }
        let (sin, cos) = self.get(p::ROTATION).sin_cos_turns();
        (widths, Some([cos, sin]))
    }

    /// The film of metal, specular and transmission lobes, seen from a medium of index `near`.
    #[inline(always)]
    pub(super) fn film(&self, near: F<L>) -> Option<Film<L>> {
        if !self.surface.lobes.film {
            return None;
        }
        let numbers = [self.get(p::THIN_FILM_WEIGHT), self.get(p::THIN_FILM_IOR), self.get(p::THIN_FILM_THICKNESS)];
        Some(Film::new(numbers, near, self.wavelengths()))
    }

    /// Factor for scattering between facets of a reflection, and the lobe's albedo with it.
    #[inline(always)]
    pub(super) fn glossy(&self, curve: &Curve<L>, roughness: F<L>) -> [Spectrum<L>; 2] {
        let tinted = energy::tinted(self.l, curve, roughness, self.specular_mu);
        if !self.surface.switches.distribution.compensates() {
            return [self.white(), tinted];
        }
        let table = energy::reflect(self.l, roughness, self.specular_mu);
        let factor = energy::compensation(table, curve.mean(self.l));
        [factor, tinted * factor * table[0]]
    }

    /// A dielectric's reflection between two colours.
    #[inline(always)]
    pub(super) fn dielectric_curve(&self, eta: F<L>, f0: Spectrum<L>, f90: Spectrum<L>) -> Curve<L> {
        match self.surface.switches.fresnel {
            Fresnel::Exact => Curve::Dielectric { eta, f0, f90 },
            Fresnel::Schlick => Curve::Schlick { f0, f90 },
        }
    }

    /// The metal's reflectance.
    #[inline(always)]
    pub(super) fn metal_curve(&self) -> Curve<L> {
        let (base, edge) = (self.reflectance(p::BASE_COLOR).saturate(), self.reflectance(p::METAL_EDGE_TINT).saturate());
        let curve = match self.surface.switches.metal {
            Metal::F82 => Curve::f82(base, edge),
            Metal::Conductor => {
                let [n, k] = match self.surface.metal.and_then(
                    #[inline(always)]
                    |row| self.wavelengths().metal(row),
                ) {
                    Some(index) => index,
                    None => [self.coefficient(p::METAL_N), self.coefficient(p::METAL_K)],
                };
                Curve::Conductor { n, k }
            }
            Metal::Gulbrandsen => Curve::gulbrandsen(base, edge),
            Metal::Schlick => Curve::Schlick { f0: base, f90: edge },
        };
        match self.film(self.l.f(1.0)) {
            Some(film) => curve.filmed(film, self.l.f(1.0)),
            None => curve,
        }
    }

    /// A lobe with a metal's reflectance.
    #[inline(always)]
    pub(super) fn metal_lobe(&mut self, curve: Curve<L>, weight: Spectrum<L>) {
        let (widths, turn) = self.widths(self.base_roughness());
        let [factor, albedo] = self.glossy(&curve, widths.roughness());
        let lobe = ReflectLobe::new(turned(self.specular_wo, turn), widths, curve, self.surface.switches.distribution);
        self.push(Shape::Reflect(lobe), weight * factor, weight * albedo, turn, Side::Reflected, Normal::Specular);
    }

    #[inline(always)]
    pub(super) fn metal(&mut self) {
        let metalness = self.get(p::METALNESS).saturate();
        let curve = self.metal_curve();
        self.metal_lobe(curve, self.weight * metalness * self.get(p::METAL_WEIGHT));
        self.weight = self.weight * (1.0 - metalness);
    }

    /// The dielectric base: its indices, its reflection and its widths.
    #[inline(always)]
    pub(super) fn base(&self) -> Base<L> {
        let switches = self.surface.switches;
        let mut ior = self.get(p::IOR).max(1e-5);
        if self.surface.lobes.coat && switches.coat_lowers_ior {
            let relative = ior / self.get(p::COAT_IOR).max(1.0);
            ior = ior.lerp(relative.max(relative.recip()), self.get(p::COAT_WEIGHT));
        }
        let level = self.get(p::SPECULAR_WEIGHT).max(0.0);
        let normal = fresnel::normal_reflectance(ior) * level;
        let root = normal.clamp(0.0, 0.99).sqrt();
        let shaped = (1.0 + root) / (1.0 - root);
        let moved = ior.lt(1.0).select(shaped.recip(), shaped);
        let eta = level.eq(1.0).select(ior, moved);
        let (tint, scale) = (self.reflectance(p::SPECULAR_COLOR), self.get(p::SPECULAR_SCALE));
        let ends = match switches.tint {
            Tint::Normal => [(tint * normal).saturate() * scale, Spectrum::constant(scale)],
            Tint::WholeLobe => [tint * (normal.min(1.0) * scale), tint * scale],
        };
        let roughness = self.base_roughness();
        let (widths, turn) = self.widths(roughness);
        let curve = match (self.film(self.l.f(1.0)), switches.fresnel) {
            (Some(film), _) => Curve::Dielectric { eta, f0: ends[0], f90: ends[1] }.filmed(film, eta),
            (None, Fresnel::Exact) => Curve::Dielectric { eta, f0: ends[0], f90: ends[1] },
            (None, Fresnel::Schlick) => Curve::Schlick { f0: ends[0], f90: ends[1] },
        };
        let bending = if switches.weight_bends { eta } else { ior };
        Base { roughness, widths, turn, bending, curve, eta, ends }
    }

    #[inline(always)]
    pub(super) fn specular(&mut self, base: &Base<L>) {
        let [factor, albedo] = self.glossy(&base.curve, base.widths.roughness());
        // Equal indices show no interface at all, whatever the tint says of grazing angles; a film does.
        let mut present = (base.eta - 1.0).abs().gt(1e-6);
        if let Curve::FilmDielectric { film, .. } = &base.curve {
            present |= film.weight.gt(0.0);
        }
        let (factor, albedo) = (factor.keep_if(present), albedo.keep_if(present));
        let lobe = ReflectLobe::new(turned(self.specular_wo, base.turn), base.widths, base.curve, self.surface.switches.distribution);
        self.push(Shape::Reflect(lobe), self.weight * factor, self.weight * albedo, base.turn, Side::Reflected, Normal::Specular);
        self.attenuate(albedo);
    }
}
