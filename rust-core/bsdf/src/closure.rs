//! Surfaces of a single lobe.

use super::fresnel::Curve;
use super::fuzz::FuzzLobe;
use super::glass::Interface;
use super::hair::{Appearance, EllipticLobe, Fibre, FibreLobe, MarschnerLobe, NUMBERS};
use super::lobes::{Normal, Shape, Side};
use super::measured::MeasuredLobe;
use super::microfacet::Widths;
use super::parameter as p;
use super::portal::Portal;
use super::reflect::ReflectLobe;
use super::resolve::Layers;
use super::switches::{Closure, Fuzz};
use super::toon::ToonLobe;
use super::turn::turned;
use gonio_simd::{Lanes, Spectrum, Vec3};

impl<L: Lanes> Layers<'_, '_, '_, L> {
    /// The lobe that the switches name.
    #[inline(always)]
    fn single(&mut self) {
        let colour = self.reflectance(p::BASE_COLOR).max(0.0);
        match self.surface.switches.closure {
            Closure::Diffuse => self.diffuse_lobe(colour, Side::Reflected, Normal::Base),
            Closure::Translucent => self.diffuse_lobe(colour, Side::Mirrored, Normal::Specular),
            Closure::Glossy => self.single_glossy(colour),
            Closure::Glass | Closure::Refraction => self.single_interface(colour),
            Closure::Metallic => {
                let curve = self.metal_curve();
                self.metal_lobe(curve, self.weight);
            }
            Closure::Sheen => self.single_fuzz(colour),
            Closure::DiffuseToon | Closure::GlossyToon => self.single_toon(colour),
            Closure::Subsurface => {
                if self.surface.lobes.walk {
                    let left = self.walk(colour.saturate(), self.l.f(1.0), self.get(p::SUBSURFACE_IOR));
                    self.diffuse_lobe(left, Side::Reflected, Normal::Base);
                } else {
                    self.diffuse_lobe(colour, Side::Reflected, Normal::Base);
                }
            }
            Closure::Transparent => self.push(Shape::Straight, colour, colour, None, Side::Mirrored, Normal::Base),
            Closure::Portal => self.single_portal(colour),
            Closure::Measured => self.measured(colour),
            Closure::Hair => self.fibre(),
            Closure::HairElliptic => self.elliptic(),
            Closure::HairReflection | Closure::HairTransmission => self.marschner(colour),
            Closure::Emission | Closure::Layered => {}
        }
    }

    /// A mirror of any roughness that has its colour at all angles; compensation deepens it.
    #[inline(always)]
    fn single_glossy(&mut self, colour: Spectrum<L>) {
        let (widths, turn) = self.widths(self.base_roughness());
        let [factor, albedo] = self.glossy(&Curve::Schlick { f0: colour, f90: colour }, widths.roughness());
        let lobe = ReflectLobe::new(turned(self.specular_wo, turn), widths, Curve::One, self.surface.switches.distribution);
        self.push(Shape::Reflect(lobe), colour * factor, albedo, turn, Side::Reflected, Normal::Specular);
    }

    /// Glass, or refraction alone.
    #[inline(always)]
    fn single_interface(&mut self, colour: Spectrum<L>) {
        let ior = self.get(p::IOR).max(1e-5);
        let eta = self.entering.select(ior, ior.recip());
        let film = self.film(self.entering.select(self.l.f(1.0), ior));
        let refracts_only = self.surface.switches.closure == Closure::Refraction;
        let plain = Interface::clear(eta, self.spread(ior));
        let interface = Interface { f0: plain.f0 * colour, f90: colour, passed: colour, refracts_only, film, ..plain };
        let roughness = self.base_roughness();
        self.interface(self.weight, Widths::isotropic(roughness * roughness), None, interface);
    }

    /// A measurement, tinted and scaled, under what lies above.
    #[inline(always)]
    pub(super) fn measured(&mut self, colour: Spectrum<L>) {
        let Some(bsdf) = &self.surface.measured else { return };
        let front = bsdf.front(self.l, self.entering);
        let turn = if self.surface.lobes.turned {
            // Seen from behind, the tangent turns the other way.
            let (sin, cos) = self.get(p::ROTATION).sin_cos_turns();
            Some([cos, front.select(sin, -sin)])
        } else {
            None
        };
        let weight = self.weight * colour * self.get(p::SPECULAR_SCALE).max(0.0);
        let lobe = MeasuredLobe::new(bsdf, front, self.wavelengths());
        self.push(Shape::Measured(lobe), weight, weight * lobe.albedo(self.specular_wo), turn, Side::Both, Normal::Specular);
    }

    /// A toon lobe.
    #[inline(always)]
    fn single_toon(&mut self, colour: Spectrum<L>) {
        let glossy = self.surface.switches.closure == Closure::GlossyToon;
        let lobe = ToonLobe::new(self.get(p::TOON_SIZE), self.get(p::TOON_SMOOTH), glossy);
        self.push(Shape::Toon(lobe), colour, colour * lobe.albedo(), None, Side::Reflected, Normal::Specular);
    }

    /// A fibre.
    #[inline(always)]
    fn fibre(&mut self) {
        let [variances, scales] = [self.vector(p::HAIR_VARIANCE), self.vector(p::HAIR_SCALE)];
        let appearance = Appearance {
            ior: self.get(p::IOR),
            absorption: self.coefficient(p::HAIR_ABSORPTION),
            variances: [variances.x, variances.y, variances.z],
            scales: [scales.x, scales.y, scales.z],
            tilt: self.get(p::HAIR_TILT),
            tints: self.tints(),
        };
        let lobe = FibreLobe::new(self.wo, &appearance);
        let albedo = lobe.albedo();
        self.push(Shape::Fibre(lobe), self.white(), albedo, None, Side::Both, Normal::Base);
    }

    /// Factors on what a fibre reflects, lets pass, and reflects inside.
    #[inline(always)]
    fn tints(&self) -> [Spectrum<L>; 3] {
        [self.reflectance(p::HAIR_TINT_R), self.reflectance(p::HAIR_TINT_TT), self.reflectance(p::HAIR_TINT_TRT)]
    }

    /// A fibre of elliptic section; there is none where the view passes beside the ellipse.
    #[inline(always)]
    fn elliptic(&mut self) {
        let roughness = self.base_roughness();
        let fibre = Fibre {
            ior: self.get(p::IOR),
            absorption: self.coefficient(p::HAIR_ABSORPTION),
            alpha: roughness * roughness,
            tilt: self.get(p::HAIR_TILT),
            aspect: self.get(p::HAIR_ASPECT),
            turn: self.get(p::HAIR_TURN),
            whole: self.get(p::HAIR_WHOLE).gt(0.5),
            tints: self.tints(),
        };
        let (lobe, present) = EllipticLobe::new(self.wo, &fibre, self.numbers.copied().unwrap_or([self.l.f(0.5); NUMBERS]));
        self.lobes.opacity = self.lobes.opacity.keep_if(present);
        let albedo = lobe.albedo();
        self.push(Shape::Elliptic(lobe), self.white(), albedo, None, Side::Both, Normal::Base);
    }

    /// One of the older lobes of fibres.
    #[inline(always)]
    fn marschner(&mut self, colour: Spectrum<L>) {
        let widths = [self.get(p::HAIR_WIDTHS), self.get(p::HAIR_WIDTHS + 1)];
        let passes = self.surface.switches.closure == Closure::HairTransmission;
        let lobe = MarschnerLobe::new(self.wo, widths, self.get(p::HAIR_TILT), passes);
        self.push(Shape::Marschner(lobe), colour, colour, None, Side::Both, Normal::Base);
    }

    /// Puts the portal in place.
    #[inline(always)]
    fn single_portal(&mut self, colour: Spectrum<L>) {
        let [position, direction] = [p::PORTAL_POSITION, p::PORTAL_DIRECTION];
        self.lobes.portal = Some(Portal { position: self.vector(position), direction: self.vector(direction), colour });
    }

    /// A parameter of three places that is no light.
    #[inline(always)]
    fn vector(&self, offset: usize) -> Vec3<L> {
        Vec3::new(self.get(offset), self.get(offset + 1), self.get(offset + 2))
    }

    /// Fuzz alone.
    #[inline(always)]
    fn single_fuzz(&mut self, colour: Spectrum<L>) {
        let roughness = self.get(p::FUZZ_ROUGHNESS).saturate();
        let (lobe, albedo) = match self.surface.switches.fuzz {
            Fuzz::Zeltner => FuzzLobe::zeltner(self.wo, roughness),
            Fuzz::Charlie => FuzzLobe::charlie(self.wo, roughness),
            Fuzz::Velvet => FuzzLobe::velvet(roughness),
        };
        self.push(Shape::Fuzz(lobe), colour, colour * albedo, None, Side::Reflected, Normal::Base);
    }
}

/// [`Layers::single`] as a function of its own.
#[inline(never)]
pub(super) fn single<L: Lanes>(l: L, layers: &mut Layers<'_, '_, '_, L>) {
    l.vectorize(
        #[inline(always)]
        || layers.single(),
    );
}
