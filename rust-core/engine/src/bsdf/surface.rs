//! A surface as compiled for a material, and the values of its parameters over a batch of hits.

use super::parameter::{self, COUNT};
use super::switches::Switches;
use gonio_simd::{F, Lanes, Rgb};

/// Which lobes and layers of a surface can ever differ from nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct LobeSet {
    /// Diffuse base, or subsurface shown as such.
    pub diffuse: bool,
    /// Diffuse base with roughness.
    pub rough_diffuse: bool,
    /// Subsurface scattering.
    pub subsurface: bool,
    /// Metal.
    pub metal: bool,
    /// Dielectric reflection over the opaque base.
    pub specular: bool,
    /// Transmission.
    pub transmission: bool,
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
}

impl Surface {
    /// Compiles a surface; `varying` marks the places that a column gives hit by hit.
    pub fn new(constants: [f32; COUNT], varying: &[bool; COUNT], switches: Switches) -> Self {
        let reach = Reach { constants: &constants, varying };
        let metal = reach.positive(parameter::METALNESS, 1) && reach.positive(parameter::METAL_WEIGHT, 1);
        let dielectric = !reach.is(parameter::METALNESS, 1.0);
        let transmission = dielectric && reach.positive(parameter::TRANSMISSION_WEIGHT, 1);
        let opaque = dielectric && !reach.is(parameter::TRANSMISSION_WEIGHT, 1.0);
        let subsurface = opaque && reach.positive(parameter::SUBSURFACE_WEIGHT, 1);
        let base = reach.positive(parameter::BASE_COLOR, 3) && !reach.is(parameter::SUBSURFACE_WEIGHT, 1.0);
        let diffuse = opaque && (base || (subsurface && reach.positive(parameter::SUBSURFACE_COLOR, 3)));
        let coat = reach.positive(parameter::COAT_WEIGHT, 1);
        let reflects = reach.positive(parameter::SPECULAR_WEIGHT, 1) && reach.positive(parameter::SPECULAR_SCALE, 1);
        let bends = !reach.is(parameter::IOR, 1.0) || (coat && switches.coat_lowers_ior);
        let anisotropic = !reach.is(parameter::ANISOTROPY, 0.0);
        let lobes = LobeSet {
            diffuse,
            rough_diffuse: diffuse && reach.positive(parameter::DIFFUSE_ROUGHNESS, 1),
            subsurface,
            metal,
            specular: opaque && reflects && bends,
            transmission,
            coat,
            coat_tint: coat && (0..3).any(|channel| !reach.is(parameter::COAT_COLOR + channel, 1.0)),
            fuzz: reach.positive(parameter::FUZZ_WEIGHT, 1),
            emission: reach.positive(parameter::EMISSION_COLOR, 3),
            cut_out: !reach.is(parameter::OPACITY, 1.0),
            anisotropic,
            turned: anisotropic && !reach.is(parameter::ROTATION, 0.0),
        };
        Self { constants, switches, lobes }
    }
}

impl Surface {
    /// Absorption coefficient of the inside, 1/m: the transmission colour is what is left of white light after the transmission depth.
    #[inline(always)]
    pub fn absorption<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize) -> Rgb<L> {
        let depth = values.get(l, parameter::TRANSMISSION_DEPTH, at);
        let colour = values.rgb(l, parameter::TRANSMISSION_COLOR, at).saturate().max(1e-6);
        let rate = (-depth.max(1e-9).recip()).keep_if(depth.gt(0.0));
        Rgb::new(colour.r.ln(), colour.g.ln(), colour.b.ln()) * rate
    }
}

/// What values a parameter can take.
struct Reach<'a> {
    constants: &'a [f32; COUNT],
    varying: &'a [bool; COUNT],
}

impl Reach<'_> {
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
}

impl<'a> ParameterValues<'a> {
    /// Values without any column.
    pub fn constant(constants: &'a [f32; COUNT]) -> Self {
        Self { constants, columns: [None; COUNT] }
    }
    /// A number for the hits from `at` on.
    #[inline(always)]
    pub fn get<L: Lanes>(&self, l: L, offset: usize, at: usize) -> F<L> {
        match self.columns[offset] {
            Some(column) => l.load(column, at),
            None => l.f(self.constants[offset]),
        }
    }
    /// A colour for the hits from `at` on.
    #[inline(always)]
    pub fn rgb<L: Lanes>(&self, l: L, offset: usize, at: usize) -> Rgb<L> {
        Rgb::new(self.get(l, offset, at), self.get(l, offset + 1, at), self.get(l, offset + 2, at))
    }
}
