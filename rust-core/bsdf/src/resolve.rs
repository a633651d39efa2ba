//! From parameters to lobes: layers from the outside in, each taking its albedo at the view from those under it.

use super::closure::single;
use super::diffuse::DiffuseLobe;
use super::fuzz::FuzzLobe;
use super::hair::NUMBERS;
use super::lobes::{Lobes, Normal, Shape, Side, Slot};
use super::normals::{Normals, Tilts, raised, raised_frame, tilted};
use super::parameter as p;
use super::subsurface::{EntryLobe, LEAST_RADIUS, medium};
use super::surface::{ParameterValues, Surface};
use super::switches::{Attenuation, Bump, Closure, EmissionOrder, Fuzz, FuzzAttenuation, FuzzOrder, SubsurfaceMethod};
use gonio_simd::{F, Lanes, M, Spectrum, Vec3, Wavelengths};

/// The layers' state on the way in.
pub(super) struct Layers<'s, 'a, 'b, L: Lanes> {
    pub(super) l: L,
    pub(super) surface: &'s Surface,
    pub(super) values: &'s ParameterValues<'s>,
    pub(super) at: usize,
    pub(super) wo: Vec3<L>,
    /// The view in the frame of specular lobes, and its cosine, kept off the tables' edge.
    pub(super) specular_wo: Vec3<L>,
    pub(super) specular_mu: F<L>,
    /// The same in the coat's frame.
    pub(super) coat_wo: Vec3<L>,
    pub(super) coat_mu: F<L>,
    pub(super) entering: M<L>,
    pub(super) numbers: Option<&'a [F<L>; NUMBERS]>,
    /// Whether light walks under the surface.
    pub(super) walks: bool,
    /// What the hits' paths carry, where the surface disperses.
    pub(super) carried: Option<Spectrum<L>>,
    /// What the layers above leave.
    pub(super) weight: Spectrum<L>,
    /// Whether a coloured coat stands above.
    pub(super) coated: bool,
    pub(super) lobes: &'b mut Lobes<'s, L>,
}

/// A register of hits to resolve.
#[derive(Clone, Copy, Debug)]
pub struct Hits<'s, 'a, L: Lanes> {
    /// Parameters of a chunk of hits.
    pub values: &'s ParameterValues<'s>,
    /// The first of the register's hits in the chunk.
    pub at: usize,
    /// The view in the shading frame, on the viewer's side.
    pub wo: Vec3<L>,
    /// Where the geometric front is seen.
    pub entering: M<L>,
    /// Normals beside the shading normal: for a coat's own normal, and for the bump rules of the switches.
    pub normals: Option<&'a Normals<L>>,
    /// Whether light walks under the surface; else it comes out where it went in.
    pub walks: bool,
    /// What the hits' paths carry, by which wavelengths draw ways through a surface that disperses. Without it all are bent alike.
    pub carried: Option<Spectrum<L>>,
    /// Random numbers of each hit, for surfaces that draw a way inside ([`LobeSet::drawn`](super::LobeSet)).
    pub numbers: Option<&'a [F<L>; NUMBERS]>,
}

impl<'s, L: Lanes> Hits<'s, '_, L> {
    /// Hits of which nothing is asked but what passes straight, or shines.
    #[inline(always)]
    fn plain(values: &'s ParameterValues<'s>, at: usize, wo: Vec3<L>, entering: M<L>) -> Self {
        Self { values, at, wo, entering, normals: None, walks: true, carried: None, numbers: None }
    }
}

/// [`Surface::layers`] as a function of its own, which all that resolve share.
#[inline(never)]
fn resolve<'s, L: Lanes>(l: L, surface: &'s Surface, hits: &Hits<'s, '_, L>, lobes: &mut Lobes<'s, L>) {
    l.vectorize(
        #[inline(always)]
        || surface.layers(l, hits, lobes),
    );
}

impl Surface {
    /// Makes `lobes` those of some hits. In place, for a list of lobes is long to copy.
    #[inline(always)]
    pub fn resolve<'s, L: Lanes>(&'s self, l: L, hits: &Hits<'s, '_, L>, lobes: &mut Lobes<'s, L>) {
        lobes.clear(l);
        resolve(l, self, hits, lobes);
    }

    #[inline(always)]
    fn layers<'s, L: Lanes>(&'s self, l: L, hits: &Hits<'s, '_, L>, lobes: &mut Lobes<'s, L>) {
        let Hits { values, at, wo, entering, normals, walks, carried, numbers } = *hits;
        if let Some(normals) = normals {
            let presence = values.get(l, p::COAT_WEIGHT, at).saturate();
            lobes.tilts = self.tilts(normals, wo, presence);
        }
        let specular_wo = lobes.tilts.seen(Normal::Specular, wo);
        let coat_wo = lobes.tilts.seen(Normal::Coat, wo);
        Layers {
            l,
            surface: self,
            values,
            at,
            wo,
            specular_wo,
            specular_mu: specular_wo.z.clamp(1e-4, 1.0),
            coat_wo,
            coat_mu: coat_wo.z.clamp(1e-4, 1.0),
            entering,
            numbers,
            walks,
            carried: carried.filter(|_| self.lobes.disperses),
            weight: Spectrum::one(l),
            coated: false,
            lobes,
        }
        .run();
    }

    /// The frames that the normals ask for.
    #[inline(always)]
    fn tilts<L: Lanes>(&self, normals: &Normals<L>, wo: Vec3<L>, coat_weight: F<L>) -> Tilts<L> {
        let mut tilts = Tilts::NONE;
        let base = Vec3::splat(wo.x.lanes(), [0.0, 0.0, 1.0]);
        let specular = raised_frame(normals.geometric, wo);
        tilts.specular = Some(specular);
        if self.switches.bump == Bump::Cycles {
            tilts.smooth = Some(normals.smooth);
        } else {
            tilts.fuzz = Some(specular);
        }
        let coat = if self.lobes.coat { normals.coat } else { None };
        if let Some(coat) = coat {
            tilts.coat = Some(tilted(raised(coat, normals.geometric, wo)));
            if self.lobes.fuzz {
                tilts.fuzz = Some(tilted((base + (coat - base) * coat_weight).normalize_or(base)));
            }
        } else {
            tilts.coat = tilts.specular;
        }
        tilts
    }

    /// Whether layers stand above what emits.
    pub fn covers_emission(&self) -> bool {
        let under = self.switches.closure == Closure::Layered && self.switches.emission_order == EmissionOrder::UnderCoat;
        under && (self.lobes.coat || self.lobes.fuzz)
    }

    /// What is emitted towards `wo` where the surface is there: not multiplied by its opacity.
    #[inline(always)]
    pub fn emitted<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize, wo: Vec3<L>, entering: M<L>) -> Spectrum<L> {
        if !self.covers_emission() {
            return self.own_emission(l, values, at);
        }
        let mut lobes = Lobes::empty(l);
        resolve(l, self, &Hits::plain(values, at, wo, entering), &mut lobes);
        lobes.emission()
    }

    /// What passes straight through towards a light: what opacity leaves open, and smooth thin walls.
    #[inline(always)]
    pub fn transmittance<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize, wo: Vec3<L>, entering: M<L>) -> Spectrum<L> {
        if !(self.lobes.straight || (self.switches.thin_walled && self.lobes.transmission)) {
            let open = if self.lobes.cut_out { 1.0 - values.get(l, p::OPACITY, at).saturate() } else { l.f(0.0) };
            return Spectrum::constant(open);
        }
        let mut lobes = Lobes::empty(l);
        resolve(l, self, &Hits::plain(values, at, wo, entering), &mut lobes);
        lobes.transmittance(l, wo)
    }
}

impl<'s, L: Lanes> Layers<'s, '_, '_, L> {
    #[inline(always)]
    pub(super) fn get(&self, offset: usize) -> F<L> {
        self.values.get(self.l, offset, self.at)
    }

    #[inline(always)]
    pub(super) fn reflectance(&self, offset: usize) -> Spectrum<L> {
        self.values.reflectance(self.l, offset, self.at)
    }

    #[inline(always)]
    pub(super) fn coefficient(&self, offset: usize) -> Spectrum<L> {
        self.values.coefficient(self.l, offset, self.at)
    }
    /// Those of the hits' paths.
    #[inline(always)]
    pub(super) fn wavelengths(&self) -> Wavelengths<'s, L> {
        self.values.wavelengths.load(self.l, self.at)
    }

    #[inline(always)]
    pub(super) fn white(&self) -> Spectrum<L> {
        Spectrum::one(self.l)
    }

    #[inline(always)]
    pub(super) fn run(&mut self) {
        let (set, switches) = (self.surface.lobes, self.surface.switches);
        if set.cut_out {
            self.lobes.opacity = self.get(p::OPACITY).saturate();
        }
        if set.emission && switches.emission_order == EmissionOrder::Top {
            self.lobes.emission = self.surface.own_emission(self.l, self.values, self.at);
        }
        if switches.closure != Closure::Layered {
            single(self.l, self);
            return;
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
            self.lobes.emission = self.surface.own_emission(self.l, self.values, self.at) * self.weight * tint;
        }
        if self.surface.measured.is_some() {
            self.measured(self.reflectance(p::BASE_COLOR).max(0.0));
            return;
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
    pub(super) fn push(
        &mut self,
        shape: Shape<'s, L>,
        weight: Spectrum<L>,
        albedo: Spectrum<L>,
        turn: Option<[F<L>; 2]>,
        side: Side,
        normal: Normal,
    ) {
        let slot = Slot { shape, weight, share: self.l.f(0.0), turn, side, normal, coated: self.coated };
        self.lobes.push(slot, albedo);
    }

    /// Takes a layer's albedo (its share of what reaches it) from what lies under it.
    #[inline(always)]
    pub(super) fn attenuate(&mut self, albedo: Spectrum<L>) {
        let left = match self.surface.switches.attenuation {
            Attenuation::PerChannel => (self.white() - albedo).saturate(),
            Attenuation::LargestChannel => Spectrum::constant((1.0 - albedo.max_component()).saturate()),
        };
        self.weight = self.weight * left;
    }

    #[inline(always)]
    pub(super) fn fuzz(&mut self) {
        let switches = self.surface.switches;
        let roughness = self.get(p::FUZZ_ROUGHNESS).saturate();
        let wo = self.lobes.tilts.seen(Normal::Fuzz, self.wo);
        let (lobe, albedo) = match switches.fuzz {
            Fuzz::Zeltner => FuzzLobe::zeltner(wo, roughness),
            Fuzz::Charlie => FuzzLobe::charlie(wo, roughness),
            Fuzz::Velvet => FuzzLobe::velvet(roughness),
        };
        let presence = self.get(p::FUZZ_WEIGHT);
        let colour = self.reflectance(p::FUZZ_COLOR) * presence;
        self.push(Shape::Fuzz(lobe), self.weight * colour, self.weight * colour * albedo, None, Side::Reflected, Normal::Fuzz);
        if switches.fuzz == Fuzz::Velvet {
            return;
        }
        self.attenuate(match switches.fuzz_attenuation {
            FuzzAttenuation::Grey => Spectrum::constant(presence * albedo),
            FuzzAttenuation::Coloured => colour * albedo,
        });
    }

    #[inline(always)]
    pub(super) fn diffuse(&mut self) {
        let (set, switches) = (self.surface.lobes, self.surface.switches);
        let mut base = self.deepened(self.reflectance(p::BASE_COLOR).max(0.0));
        let mut passed = None;
        if set.subsurface {
            let presence = self.get(p::SUBSURFACE_WEIGHT).saturate();
            let mut inner = self.deepened(self.reflectance(p::SUBSURFACE_COLOR).max(0.0));
            if switches.thin_walled {
                let forward = (self.get(p::SUBSURFACE_ANISOTROPY) + 1.0) * 0.5;
                passed = Some(inner * (presence * forward));
                inner = inner * (1.0 - forward);
            } else if set.walk {
                let eta =
                    if switches.subsurface == SubsurfaceMethod::RandomWalkSkin { self.get(p::SUBSURFACE_IOR) } else { self.base().eta };
                inner = self.walk(inner.saturate(), presence, eta);
            }
            base = base.lerp(inner, presence);
        }
        self.diffuse_lobe(base, Side::Reflected, Normal::Base);
        if let Some(colour) = passed {
            self.diffuse_lobe(colour, Side::Mirrored, Normal::Base);
        }
    }

    /// Adds the way into the medium of this colour, and returns the colour of the channels that have no radius: of all where nothing walks.
    #[inline(always)]
    pub(super) fn walk(&mut self, colour: Spectrum<L>, presence: F<L>, eta: F<L>) -> Spectrum<L> {
        if !self.walks {
            return colour;
        }
        let method = self.surface.switches.subsurface;
        let radius = self.coefficient(p::SUBSURFACE_RADIUS);
        let [scattered] = colour.zip(
            radius,
            #[inline(always)]
            |colour, radius| [colour.keep_if(radius.ge(LEAST_RADIUS))],
        );
        let (medium, factor) = medium(self.l, method, scattered, radius, self.get(p::SUBSURFACE_ANISOTROPY), eta);
        self.lobes.medium = Some(medium);
        let lobe = EntryLobe::new(method, self.base_roughness(), eta);
        let weight = self.weight * presence;
        self.push(Shape::Subsurface(lobe), weight * factor, weight * scattered, None, Side::Both, Normal::Specular);
        colour - scattered
    }

    #[inline(always)]
    pub(super) fn diffuse_lobe(&mut self, colour: Spectrum<L>, side: Side, normal: Normal) {
        let lobe = if self.surface.lobes.rough_diffuse {
            DiffuseLobe::rough(self.wo, colour, self.get(p::DIFFUSE_ROUGHNESS).saturate(), self.surface.switches.diffuse)
        } else {
            DiffuseLobe::lambert(colour)
        };
        self.push(Shape::Diffuse(lobe), self.weight, self.weight * colour, None, side, normal);
    }

    /// A colour raised to the power that the coat asks for.
    #[inline(always)]
    pub(super) fn deepened(&self, colour: Spectrum<L>) -> Spectrum<L> {
        if !self.surface.lobes.coat {
            return colour;
        }
        let power = self.get(p::COAT_AFFECT_COLOR).mul_add(self.get(p::COAT_WEIGHT), 1.0);
        power.eq(1.0).select(colour, colour.pow(power))
    }
}
