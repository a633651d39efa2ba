//! A surface as compiled for a material, and the values of its parameters over a batch of hits.

use super::measured::MeasuredBsdf;
use super::parameter::{self as p, COUNT};
use super::switches::{Closure, SubsurfaceMethod, Switches};
use gonio_simd::{F, Lanes, Rgb, Spectrum, WavelengthColumn};
use std::sync::Arc;

/// Which lobes and layers of a surface can ever differ from nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct LobeSet {
    /// Diffuse base, or subsurface shown as such.
    pub diffuse: bool,
    /// Diffuse base with roughness.
    pub rough_diffuse: bool,
    /// Subsurface scattering.
    pub subsurface: bool,
    /// Subsurface scattering as a walk under the surface: samples may be marked as entered.
    pub walk: bool,
    /// A thin film on metal, specular or transmission.
    pub film: bool,
    /// Nothing but a colour straight through.
    pub straight: bool,
    /// A portal.
    pub portal: bool,
    /// A fibre, which scatters about its tangent.
    pub fibre: bool,
    /// A fibre whose hits draw a way inside.
    pub drawn: bool,
    /// A fibre that may be narrower than its outline: paths pass beside it. Shadow rays do not ask.
    pub narrow: bool,
    /// Metal.
    pub metal: bool,
    /// Dielectric reflection over the opaque base.
    pub specular: bool,
    /// Transmission.
    pub transmission: bool,
    /// Whether what passes is bent by its wavelength.
    pub disperses: bool,
    /// Coat.
    pub coat: bool,
    /// Tint of the coat.
    pub coat_tint: bool,
    /// Fuzz.
    pub fuzz: bool,
    /// Emission.
    pub emission: bool,
    /// Opacity below 1.
    pub cut_out: bool,
    /// Unequal widths of metal and specular lobes.
    pub anisotropic: bool,
    /// Turned tangent.
    pub turned: bool,
    /// Metal or transmission that may be smooth: what it sends on casts caustics.
    pub smooth: bool,
}

impl LobeSet {
    /// Whether paths may pass straight where nothing of the surface is there.
    pub fn has_gaps(&self) -> bool {
        self.cut_out || self.narrow
    }
}

/// What is known before any hit: constants, which of them a graph overrides, and the model's choices.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Values of the parameters that do not vary.
    pub constants: [f32; COUNT],
    /// The model's choices.
    pub switches: Switches,
    /// What can ever be seen of the surface.
    pub lobes: LobeSet,
    /// What [`Closure::Measured`] shows, or what lies under the layers.
    pub measured: Option<Arc<MeasuredBsdf>>,
    /// The row of its metal in the table of wavelengths; without one, and where light is colour, n and k are parameters.
    pub metal: Option<u32>,
    /// The row of its glass there; without one the index is the stated one, and differs by the Abbe number.
    pub glass: Option<u32>,
    /// The number of the spectrum of what it sends in the table of wavelengths, counted from 1; 0 is none.
    pub spectrum: u32,
}

impl Surface {
    /// Compiles a surface; `varying` marks the places that a column gives hit by hit.
    pub fn new(constants: [f32; COUNT], varying: &[bool; COUNT], switches: Switches) -> Self {
        let reach = Reach { constants: &constants, varying };
        let lobes = if switches.closure == Closure::Layered { reach.layered(&switches) } else { reach.single(&switches) };
        Self { constants, switches, lobes, measured: None, metal: None, glass: None, spectrum: 0 }
    }

    /// The surface with the glass of a row, where there is one.
    pub fn of_glass(mut self, row: Option<u32>) -> Self {
        self.glass = row;
        self.lobes.disperses |= row.is_some() && self.lobes.transmission && !self.switches.thin_walled;
        self
    }

    /// Compiles a surface that shows a measurement: alone, or under the coat and the fuzz of a layered one in place of the base.
    pub fn measured(constants: [f32; COUNT], varying: &[bool; COUNT], switches: Switches, measured: Arc<MeasuredBsdf>) -> Self {
        let over = Self::new(constants, varying, switches);
        let LobeSet { coat, coat_tint, fuzz, emission, cut_out, .. } = over.lobes;
        let anisotropic = !measured.is_isotropic();
        let turned = anisotropic && !(Reach { constants: &constants, varying }).is(p::ROTATION, 0.0);
        let lobes = LobeSet { coat, coat_tint, fuzz, emission, cut_out, anisotropic, turned, ..LobeSet::default() };
        Self { lobes, measured: Some(measured), ..over }
    }
}

impl Surface {
    /// What it sends before anything covers it.
    #[inline(always)]
    pub fn own_emission<L: Lanes>(&self, l: L, values: &ParameterValues<'_>, at: usize) -> Spectrum<L> {
        values.wavelengths.load(l, at).lamp(l.u(self.spectrum), values.colour(l, p::EMISSION_COLOR, at))
    }
    /// Whether light may pass straight through, so that shadow rays ask [`Self::transmittance`].
    pub fn is_see_through(&self) -> bool {
        self.lobes.cut_out || self.lobes.straight || (self.switches.thin_walled && self.lobes.transmission)
    }
    /// Whether light comes out of it on the other side, bent or scattered: glass, thin sheets, and solids that scatter.
    pub fn lets_light_through(&self) -> bool {
        let lobes = &self.lobes;
        lobes.transmission || lobes.cut_out || lobes.straight || lobes.subsurface || self.switches.closure == Closure::Translucent
    }
    /// Whether it bounds a solid: it bends what goes in. Behind thin walls and what lets light through diffusely lies what is before them.
    pub fn is_solid(&self) -> bool {
        self.lobes.transmission && !self.switches.thin_walled
    }
    /// Absorption coefficient of the inside, 1/m: the transmission colour is what is left of white light after the transmission depth.
    #[inline(always)]
    pub fn absorption<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize) -> Spectrum<L> {
        if !self.is_solid() {
            return Spectrum::zero(l);
        }
        let colour = values.reflectance(l, p::TRANSMISSION_COLOR, at).saturate().max(LEAST_LEFT);
        colour.ln() * -self.tints(l, values, at)
    }
    /// How often a metre of the inside takes of light what leaves it the transmission colour: one over the transmission depth, 0 without one.
    #[inline(always)]
    pub fn tints<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize) -> F<L> {
        if !self.is_solid() {
            return l.f(0.0);
        }
        let depth = values.get(l, p::TRANSMISSION_DEPTH, at);
        depth.max(1e-9).recip().keep_if(depth.gt(0.0))
    }
}

/// What is left of light at least of the colour that solids make of it.
const LEAST_LEFT: f32 = 1e-6;
/// Roughness below this may make a delta lobe, however it is stretched.
const SMOOTH: f32 = 5e-3;

/// What values a parameter can take.
struct Reach<'a> {
    constants: &'a [f32; COUNT],
    varying: &'a [bool; COUNT],
}

impl Reach<'_> {
    /// What a layered surface can show.
    fn layered(&self, switches: &Switches) -> LobeSet {
        let metal = self.positive(p::METALNESS, 1) && self.positive(p::METAL_WEIGHT, 1);
        let dielectric = !self.is(p::METALNESS, 1.0);
        let transmission = dielectric && self.positive(p::TRANSMISSION_WEIGHT, 1);
        let opaque = dielectric && !self.is(p::TRANSMISSION_WEIGHT, 1.0);
        let subsurface = opaque && self.positive(p::SUBSURFACE_WEIGHT, 1);
        let base = self.positive(p::BASE_COLOR, 3) && !self.is(p::SUBSURFACE_WEIGHT, 1.0);
        let diffuse = opaque && (base || (subsurface && self.positive(p::SUBSURFACE_COLOR, 3)));
        let coat = self.positive(p::COAT_WEIGHT, 1);
        let reflects = self.positive(p::SPECULAR_WEIGHT, 1) && self.positive(p::SPECULAR_SCALE, 1);
        let bends = !self.is(p::IOR, 1.0) || (coat && switches.coat_lowers_ior);
        let anisotropic = !self.is(p::ANISOTROPY, 0.0);
        LobeSet {
            diffuse,
            rough_diffuse: diffuse && self.positive(p::DIFFUSE_ROUGHNESS, 1),
            subsurface,
            walk: subsurface && !switches.thin_walled && switches.subsurface != SubsurfaceMethod::Diffuse,
            film: self.film(),
            metal,
            specular: opaque && reflects && bends,
            transmission,
            disperses: transmission && !switches.thin_walled && self.positive(p::TRANSMISSION_DISPERSION, 1),
            coat,
            coat_tint: coat && (0..3).any(|channel| !self.is(p::COAT_COLOR + channel, 1.0)),
            fuzz: self.positive(p::FUZZ_WEIGHT, 1),
            emission: self.shines(),
            cut_out: !self.is(p::OPACITY, 1.0),
            anisotropic,
            turned: anisotropic && !self.is(p::ROTATION, 0.0),
            smooth: (metal || transmission) && self.smooth(),
            straight: false,
            portal: false,
            fibre: false,
            drawn: false,
            narrow: false,
        }
    }
    /// What a single lobe can show, with the places that it reads.
    fn single(&self, switches: &Switches) -> LobeSet {
        let closure = switches.closure;
        let colour = self.positive(p::BASE_COLOR, 3);
        let reflects = matches!(closure, Closure::Glossy | Closure::Metallic);
        let fibre = closure.is_fibre();
        let stretched = reflects && !self.is(p::ANISOTROPY, 0.0);
        let subsurface = closure == Closure::Subsurface && colour;
        LobeSet {
            diffuse: (matches!(closure, Closure::Diffuse | Closure::Translucent) && colour) || subsurface,
            rough_diffuse: closure == Closure::Diffuse && self.positive(p::DIFFUSE_ROUGHNESS, 1),
            subsurface,
            walk: subsurface && switches.subsurface != SubsurfaceMethod::Diffuse,
            metal: reflects,
            transmission: matches!(closure, Closure::Glass | Closure::Refraction),
            disperses: matches!(closure, Closure::Glass | Closure::Refraction) && self.positive(p::TRANSMISSION_DISPERSION, 1),
            fuzz: closure == Closure::Sheen && colour,
            emission: self.shines(),
            cut_out: !self.is(p::OPACITY, 1.0),
            anisotropic: stretched || fibre,
            turned: stretched && !self.is(p::ROTATION, 0.0),
            fibre,
            drawn: closure == Closure::HairElliptic,
            narrow: closure == Closure::HairElliptic && !self.is(p::HAIR_ASPECT, 1.0),
            film: matches!(closure, Closure::Glass | Closure::Metallic) && self.film(),
            straight: closure == Closure::Transparent,
            smooth: (reflects || matches!(closure, Closure::Glass | Closure::Refraction)) && self.smooth(),
            portal: closure == Closure::Portal,
            ..LobeSet::default()
        }
    }
    /// Whether facets can be so even that they mirror.
    fn smooth(&self) -> bool {
        self.varying[p::ROUGHNESS] || self.constants[p::ROUGHNESS] < SMOOTH
    }
    /// Whether a film can be there.
    fn film(&self) -> bool {
        self.positive(p::THIN_FILM_WEIGHT, 1) && self.positive(p::THIN_FILM_THICKNESS, 1)
    }
    /// Whether it can bring light, or take it away.
    fn shines(&self) -> bool {
        (p::EMISSION_COLOR..p::EMISSION_COLOR + 3).any(|place| self.varying[place] || self.constants[place] != 0.0)
    }
    /// Whether any of `width` places can be above zero.
    fn positive(&self, offset: usize, width: usize) -> bool {
        (offset..offset + width).any(|place| self.varying[place] || self.constants[place] > 0.0)
    }
    /// Whether a place has this value always.
    #[allow(clippy::float_cmp, reason = "switching off is exact")]
    fn is(&self, offset: usize, value: f32) -> bool {
        !self.varying[offset] && self.constants[offset] == value
    }
}

/// Parameter values over a batch: a constant, or a column with one value a hit.
#[derive(Clone, Copy, Debug)]
pub struct ParameterValues<'a> {
    /// Values of the places without a column.
    pub constants: &'a [f32; COUNT],
    /// Columns, padded to whole registers.
    pub columns: [Option<&'a [f32]>; COUNT],
    /// Wavelengths of the hits' paths.
    pub wavelengths: WavelengthColumn<'a>,
}

impl<'a> ParameterValues<'a> {
    /// Values without any column.
    pub fn constant(constants: &'a [f32; COUNT]) -> Self {
        Self { constants, columns: [None; COUNT], wavelengths: WavelengthColumn::default() }
    }
    /// A number for the hits from `at` on.
    #[inline(always)]
    pub fn get<L: Lanes>(&self, l: L, offset: usize, at: usize) -> F<L> {
        match self.columns[offset] {
            Some(column) => l.load(column, at),
            None => l.f(self.constants[offset]),
        }
    }
    #[inline(always)]
    fn colour<L: Lanes>(&self, l: L, offset: usize, at: usize) -> Rgb<L> {
        Rgb::new(self.get(l, offset, at), self.get(l, offset + 1, at), self.get(l, offset + 2, at))
    }
    /// A colour for the hits from `at` on, as what it does to light.
    #[inline(always)]
    pub fn reflectance<L: Lanes>(&self, l: L, offset: usize, at: usize) -> Spectrum<L> {
        self.wavelengths.load(l, at).reflectance(self.colour(l, offset, at))
    }
    /// Another parameter that differs by wavelength.
    #[inline(always)]
    pub fn coefficient<L: Lanes>(&self, l: L, offset: usize, at: usize) -> Spectrum<L> {
        self.wavelengths.load(l, at).coefficient(self.colour(l, offset, at))
    }
}
