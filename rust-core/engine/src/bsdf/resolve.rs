//! From parameters to lobes: layers from the outside in, each taking its albedo at the view from those under it.

use super::diffuse::DiffuseLobe;
use super::fuzz::FuzzLobe;
use super::lobes::{Lobes, Shape, Slot};
use super::parameter as p;
use super::surface::{ParameterValues, Surface};
use super::switches::{Attenuation, EmissionOrder, Fuzz, FuzzAttenuation, FuzzOrder};
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// The layers' state on the way in.
pub(super) struct Layers<'a, 'b, L: Lanes> {
    pub(super) l: L,
    pub(super) surface: &'a Surface,
    pub(super) values: &'a ParameterValues<'a>,
    pub(super) at: usize,
    pub(super) wo: Vec3<L>,
    /// Cosine of the view, kept off the tables' edge.
    pub(super) mu: F<L>,
    pub(super) entering: M<L>,
    /// What the layers above leave.
    pub(super) weight: Rgb<L>,
    /// Whether a coloured coat stands above.
    pub(super) coated: bool,
    pub(super) lobes: &'b mut Lobes<L>,
}

impl Surface {
    /// The lobes of the hits from `at` on, seen from `wo` in the shading frame on the viewer's side; `entering` tells the geometric front.
    #[inline(always)]
    pub fn resolve<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize, wo: Vec3<L>, entering: M<L>) -> Lobes<L> {
        let mut lobes = Lobes::empty(l);
        Layers {
            l,
            surface: self,
            values,
            at,
            wo,
            mu: wo.z.clamp(1e-4, 1.0),
            entering,
            weight: Rgb::grey(l.f(1.0)),
            coated: false,
            lobes: &mut lobes,
        }
        .run();
        lobes
    }

    /// What passes straight through towards a light: what opacity leaves open, and smooth thin walls.
    #[inline(always)]
    pub fn transmittance<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize, wo: Vec3<L>, entering: M<L>) -> Rgb<L> {
        if !(self.switches.thin_walled && self.lobes.transmission) {
            let open = if self.lobes.cut_out { 1.0 - values.get(l, p::OPACITY, at).saturate() } else { l.f(0.0) };
            return Rgb::grey(open);
        }
        self.resolve(l, values, at, wo, entering).transmittance(l, wo)
    }
}

impl<L: Lanes> Layers<'_, '_, L> {
    #[inline(always)]
    pub(super) fn get(&self, offset: usize) -> F<L> {
        self.values.get(self.l, offset, self.at)
    }

    #[inline(always)]
    pub(super) fn rgb(&self, offset: usize) -> Rgb<L> {
        self.values.rgb(self.l, offset, self.at)
    }

    #[inline(always)]
    pub(super) fn white(&self) -> Rgb<L> {
        Rgb::grey(self.l.f(1.0))
    }

    #[inline(always)]
    pub(super) fn run(&mut self) {
        let (set, switches) = (self.surface.lobes, self.surface.switches);
        if set.cut_out {
            self.lobes.opacity = self.get(p::OPACITY).saturate();
        }
        if set.emission && switches.emission_order == EmissionOrder::Top {
            self.lobes.emission = self.rgb(p::EMISSION_COLOR);
        }
        if set.fuzz && switches.fuzz_order == FuzzOrder::Top {
            self.fuzz();
        }
        if set.coat {
            self.coat();
        }
        if set.fuzz && switches.fuzz_order == FuzzOrder::UnderCoat {
            self.fuzz();
        }
        if set.emission && switches.emission_order == EmissionOrder::UnderCoat {
            let tint = match &self.lobes.coat {
                Some(coat) => coat.along(coat.view),
                None => self.white(),
            };
            self.lobes.emission = self.rgb(p::EMISSION_COLOR) * self.weight * tint;
        }
        if set.metal {
            self.metal();
        }
        if set.transmission || set.specular {
            let base = self.base();
            if set.transmission {
                if switches.thin_walled { self.thin_wall(&base) } else { self.glass(&base) }
            }
            if set.specular {
                self.specular(&base);
            }
        }
        if set.diffuse {
            if set.fuzz && switches.fuzz_order == FuzzOrder::UnderSpecular {
                self.fuzz();
            }
            self.diffuse();
        }
    }

    #[inline(always)]
    pub(super) fn push(&mut self, shape: Shape<L>, weight: Rgb<L>, albedo: Rgb<L>, turn: Option<[F<L>; 2]>, mirrored: bool) {
        let slot = Slot { shape, weight, share: self.l.f(0.0), turn, mirrored, coated: self.coated };
        self.lobes.push(slot, albedo);
    }

    /// Takes a layer's albedo (its share of what reaches it) from what lies under it.
    #[inline(always)]
    pub(super) fn attenuate(&mut self, albedo: Rgb<L>) {
        let left = match self.surface.switches.attenuation {
            Attenuation::PerChannel => (self.white() - albedo).saturate(),
            Attenuation::LargestChannel => Rgb::grey((1.0 - albedo.max_component()).saturate()),
        };
        self.weight = self.weight * left;
    }

    #[inline(always)]
    pub(super) fn fuzz(&mut self) {
        let switches = self.surface.switches;
        let roughness = self.get(p::FUZZ_ROUGHNESS).saturate();
        let (lobe, albedo) = match switches.fuzz {
            Fuzz::Zeltner => FuzzLobe::zeltner(self.wo, roughness),
            Fuzz::Charlie => FuzzLobe::charlie(self.wo, roughness),
        };
        let presence = self.get(p::FUZZ_WEIGHT);
        let colour = self.rgb(p::FUZZ_COLOR) * presence;
        self.push(Shape::Fuzz(lobe), self.weight * colour, self.weight * colour * albedo, None, false);
        self.attenuate(match switches.fuzz_attenuation {
            FuzzAttenuation::Grey => Rgb::grey(presence * albedo),
            FuzzAttenuation::Coloured => colour * albedo,
        });
    }

    #[inline(always)]
    pub(super) fn diffuse(&mut self) {
        let (set, switches) = (self.surface.lobes, self.surface.switches);
        let mut base = self.deepened(self.rgb(p::BASE_COLOR).max(0.0));
        let mut passed = None;
        if set.subsurface {
            let presence = self.get(p::SUBSURFACE_WEIGHT).saturate();
            let mut inner = self.deepened(self.rgb(p::SUBSURFACE_COLOR).max(0.0));
            if switches.thin_walled {
                let forward = (self.get(p::SUBSURFACE_ANISOTROPY) + 1.0) * 0.5;
                passed = Some(inner * (presence * forward));
                inner = inner * (1.0 - forward);
            }
            base = base.lerp(inner, presence);
        }
        self.diffuse_lobe(base, false);
        if let Some(colour) = passed {
            self.diffuse_lobe(colour, true);
        }
    }

    #[inline(always)]
    pub(super) fn diffuse_lobe(&mut self, colour: Rgb<L>, mirrored: bool) {
        let lobe = if self.surface.lobes.rough_diffuse {
            DiffuseLobe::rough(self.wo, colour, self.get(p::DIFFUSE_ROUGHNESS).saturate(), self.surface.switches.diffuse)
        } else {
            DiffuseLobe::lambert(colour)
        };
        self.push(Shape::Diffuse(lobe), self.weight, self.weight * colour, None, mirrored);
    }

    /// A colour raised to the power that the coat asks for.
    #[inline(always)]
    pub(super) fn deepened(&self, colour: Rgb<L>) -> Rgb<L> {
        if !self.surface.lobes.coat {
            return colour;
        }
        let power = self.get(p::COAT_AFFECT_COLOR).mul_add(self.get(p::COAT_WEIGHT), 1.0);
        let deepened = Rgb::new(colour.r.pow(power), colour.g.pow(power), colour.b.pow(power));
        power.eq(1.0).select(colour, deepened)
    }
}
