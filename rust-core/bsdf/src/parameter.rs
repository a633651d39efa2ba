//! The internal parameter block: one place for each number of a layered surface, with OpenPBR's names and meanings where it has them.
//!
//! Front ends and node graphs address places by name through [`NAMES`]; kernels by the constants. Colours take three places.

use super::switches::{Closure, Switches, Tint};
use core::f32::consts::TAU;

/// A named run of places in the block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name, in snake case.
    pub name: &'static str,
    /// First place.
    pub offset: usize,
    /// Value when nothing is said; its length is the number of places.
    pub default: &'static [f32],
    /// The least and the greatest value of each place: what lies outside is held here. See [`Parameter::range_of`].
    pub range: [f32; 2],
}

/// Of shares, and of colours that nothing reflects or lets pass more than.
const SHARE: [f32; 2] = [0.0, 1.0];
/// Of indices of refraction.
const INDEX: [f32; 2] = [1e-3, 1e3];
/// Of lengths, metres.
const LENGTH: [f32; 2] = [0.0, 1e30];
/// Of places and directions.
const PLACE: [f32; 2] = [-1e30, 1e30];
/// Of light, cd/m²: what sums over pixels and samples can hold. Parts of a colour may take light away.
pub const LIGHT: [f32; 2] = [-1e30, 1e30];
/// Without bounds but those of numbers.
const ABOVE_ZERO: [f32; 2] = [0.0, f32::MAX];

impl Parameter {
    /// Places taken: 1 for a number, 3 for a colour.
    pub const fn width(&self) -> usize {
        self.default.len()
    }
    /// Its range in a surface of these switches. A tint of the normal reflectance alone may be above 1, for the reflectance is held; so may factors on
    /// measured values.
    pub fn range_of(&self, switches: &Switches, measured: bool) -> [f32; 2] {
        match self.offset {
            SPECULAR_COLOR if switches.tint == Tint::Normal => ABOVE_ZERO,
            BASE_COLOR | SPECULAR_SCALE if measured => ABOVE_ZERO,
            // What passes straight may be coloured at will, as in Cycles.
            BASE_COLOR if matches!(switches.closure, Closure::Transparent | Closure::Portal) => ABOVE_ZERO,
            _ => self.range,
        }
    }
    /// A value held within `range`; what is no number is the default of its place.
    pub fn held(&self, place: usize, value: f32, [low, high]: [f32; 2]) -> f32 {
        if value.is_nan() { self.default[place] } else { value.clamp(low, high) }
    }
}

macro_rules! block {
    (@place $at:expr;) => {
        /// Places in the block.
        pub const COUNT: usize = $at;
    };
    (@place $at:expr; $(#[$doc:meta])* $constant:ident $name:literal $default:expr, $range:expr; $($rest:tt)*) => {
        $(#[$doc])*
        pub const $constant: usize = $at;
        block!(@place $constant + { const DEFAULT: &[f32] = &$default; DEFAULT.len() }; $($rest)*);
    };
    ($($(#[$doc:meta])* $constant:ident $name:literal $default:expr, $range:expr;)*) => {
        block!(@place 0; $($(#[$doc])* $constant $name $default, $range;)*);
        /// All parameters in the order of their places.
        pub const NAMES: &[Parameter] = &[$(Parameter { name: $name, offset: $constant, default: &$default, range: $range }),*];
    };
}

block! {
    /// Colour of the diffuse base, normal reflectance of the metal and tint of a measurement; OpenPBR's `base_weight` is multiplied in.
    BASE_COLOR "base_color" [0.8, 0.8, 0.8], SHARE;
    /// Roughness sigma of the diffuse base, 0 (Lambert) to 1.
    DIFFUSE_ROUGHNESS "diffuse_roughness" [0.0], SHARE;
    /// Share of metal in the base, 0 to 1.
    METALNESS "metalness" [0.0], SHARE;
    /// Factor on the whole metal lobe; OpenPBR's `specular_weight` goes here too.
    METAL_WEIGHT "metal_weight" [1.0], SHARE;
    /// Reflectance of the metal at 82 degrees over Schlick's (F82), its reflectance at grazing (Schlick), or Gulbrandsen's edge tint.
    METAL_EDGE_TINT "metal_edge_tint" [1.0, 1.0, 1.0], SHARE;
    /// Refractive index of a conductor.
    METAL_N "metal_n" [2.757, 2.513, 2.231], [0.0, 1e3];
    /// Extinction coefficient of a conductor.
    METAL_K "metal_k" [3.867, 3.404, 3.009], [0.0, 1e3];
    /// Factor on the dielectric's normal reflectance; it changes the index that shapes the Fresnel curve. OpenPBR's `specular_weight`,
    /// twice Principled's Specular IOR Level.
    SPECULAR_WEIGHT "specular_weight" [1.0], [0.0, 1e3];
    /// Factor on the dielectric's reflectance at all angles (standard_surface's `specular`), and on a measurement.
    SPECULAR_SCALE "specular_scale" [1.0], SHARE;
    /// Tint of the dielectric's reflection: at normal incidence only or at all angles, by [`Tint`](super::Tint).
    SPECULAR_COLOR "specular_color" [1.0, 1.0, 1.0], SHARE;
    /// Roughness r of the base; alpha = r².
    ROUGHNESS "specular_roughness" [0.3], SHARE;
    /// Anisotropy, 0 to 1 (−1 to 1 for the single-lobe form); the widths follow from [`Anisotropy`](super::Anisotropy).
    ANISOTROPY "specular_anisotropy" [0.0], [-1.0, 1.0];
    /// Turn of the tangent about the normal, in turns.
    ROTATION "specular_rotation" [0.0], [-1e4, 1e4];
    /// Index of refraction of the dielectric base.
    IOR "specular_ior" [1.5], INDEX;
    /// Share of transmission in the dielectric base, 0 to 1.
    TRANSMISSION_WEIGHT "transmission_weight" [0.0], SHARE;
    /// Tint of what passes: for each interface if the depth is 0, over the depth otherwise; of the whole sheet if thin-walled.
    TRANSMISSION_COLOR "transmission_color" [1.0, 1.0, 1.0], SHARE;
    /// Distance in metres after which white light has the transmission colour; 0 tints the interface instead.
    TRANSMISSION_DEPTH "transmission_depth" [0.0], LENGTH;
    /// How much the index differs by wavelength where light has any: 1 over the Abbe number, 0 without dispersion.
    TRANSMISSION_DISPERSION "transmission_dispersion" [0.0], [0.0, 1.0];
    /// Added to the roughness of the transmission, the sum held in 0 to 1.
    TRANSMISSION_EXTRA_ROUGHNESS "transmission_extra_roughness" [0.0], [-1.0, 1.0];
    /// Share of subsurface scattering in the opaque dielectric base, 0 to 1.
    SUBSURFACE_WEIGHT "subsurface_weight" [0.0], SHARE;
    /// Colour of the subsurface scattering.
    SUBSURFACE_COLOR "subsurface_color" [0.8, 0.8, 0.8], SHARE;
    /// Mean free path in metres, by channel.
    SUBSURFACE_RADIUS "subsurface_radius" [1.0, 0.5, 0.25], LENGTH;
    /// Anisotropy g of the scattering; of a thin wall, (1 − g) / 2 reflects and (1 + g) / 2 passes.
    SUBSURFACE_ANISOTROPY "subsurface_scatter_anisotropy" [0.0], [-1.0, 1.0];
    /// Index for the lengths and the way in of skin, and for the way in of subsurface scattering without a specular layer.
    SUBSURFACE_IOR "subsurface_ior" [1.4], INDEX;
    /// Presence of the coat, 0 to 1.
    COAT_WEIGHT "coat_weight" [0.0], SHARE;
    /// Tint of what lies under the coat.
    COAT_COLOR "coat_color" [1.0, 1.0, 1.0], SHARE;
    /// Roughness of the coat.
    COAT_ROUGHNESS "coat_roughness" [0.0], SHARE;
    /// Index of refraction of the coat.
    COAT_IOR "coat_ior" [1.6], INDEX;
    /// How far the coat's inner reflections darken the base, 0 to 1.
    COAT_DARKENING "coat_darkening" [1.0], SHARE;
    /// How far the coat deepens diffuse colours: they are raised to 1 + weight × this.
    COAT_AFFECT_COLOR "coat_affect_color" [0.0], SHARE;
    /// How far the coat's roughness roughens the base: r goes to 1 by weight × coat roughness × this.
    COAT_AFFECT_ROUGHNESS "coat_affect_roughness" [0.0], SHARE;
    /// Presence of the fuzz, 0 to 1.
    FUZZ_WEIGHT "fuzz_weight" [0.0], SHARE;
    /// Colour of the fuzz.
    FUZZ_COLOR "fuzz_color" [1.0, 1.0, 1.0], SHARE;
    /// Roughness of the fuzz.
    FUZZ_ROUGHNESS "fuzz_roughness" [0.5], SHARE;
    /// Presence of the thin film, 0 to 1.
    THIN_FILM_WEIGHT "thin_film_weight" [0.0], SHARE;
    /// Thickness of the film in nanometres.
    THIN_FILM_THICKNESS "thin_film_thickness" [500.0], [0.0, 1e6];
    /// Index of refraction of the film.
    THIN_FILM_IOR "thin_film_ior" [1.4], INDEX;
    /// Cone of full brightness of a toon lobe, in right angles.
    TOON_SIZE "toon_size" [0.5], SHARE;
    /// Angle over which a toon lobe fades, in right angles.
    TOON_SMOOTH "toon_smooth" [0.0], SHARE;
    /// Absorption coefficient inside a fibre, in units of one over its radius.
    HAIR_ABSORPTION "hair_absorption" [0.245_531, 0.52, 1.365], [0.0, 1e6];
    /// Variances along a fibre of R, TT and TRT: about the squares of their widths in radians.
    HAIR_VARIANCE "hair_variance" [0.084_61, 0.021_15, 0.338_4], [0.0, 1e6];
    /// Widths about a fibre of the same, radians; √(π/8) times them are the scales of logistic distributions.
    HAIR_SCALE "hair_scale" [0.187, 0.187, 0.187], [0.0, 1e6];
    /// Tilt of the cuticle's scales towards the root, radians.
    HAIR_TILT "hair_tilt" [0.034_906_6], [-TAU, TAU];
    /// Factor on what a fibre reflects.
    HAIR_TINT_R "hair_tint_r" [1.0, 1.0, 1.0], SHARE;
    /// Factor on what passes a fibre.
    HAIR_TINT_TT "hair_tint_tt" [1.0, 1.0, 1.0], SHARE;
    /// Factor on what a fibre reflects inside.
    HAIR_TINT_TRT "hair_tint_trt" [1.0, 1.0, 1.0], SHARE;
    /// Half axis of an elliptic fibre across `hair_turn`, over the one along it.
    HAIR_ASPECT "hair_aspect" [1.0], [0.0, 1e3];
    /// Angle about the fibre from the normal to that half axis, radians, from the tangent on to the right.
    HAIR_TURN "hair_turn" [0.0], [-1e4, 1e4];
    /// Whether an elliptic fibre is seen over its whole width at each hit: 1 where the surface does not tell the place across, as on meshes.
    HAIR_WHOLE "hair_whole" [0.0], SHARE;
    /// Widths of the older hair lobes along and about the fibre, radians.
    HAIR_WIDTHS "hair_widths" [0.1, 1.0], [0.0, TAU];
    /// Where a portal's light goes on, in the world, metres.
    PORTAL_POSITION "portal_position" [0.0, 0.0, 0.0], PLACE;
    /// In which direction, in the world; zero for straight on.
    PORTAL_DIRECTION "portal_direction" [0.0, 0.0, 0.0], PLACE;
    /// Emitted radiance: linear Rec.709 whose luminance is in cd/m².
    EMISSION_COLOR "emission_color" [0.0, 0.0, 0.0], LIGHT;
    /// Share of the surface that is there at all, 0 to 1.
    OPACITY "geometry_opacity" [1.0], SHARE;
}

/// The values of all places when nothing is said: OpenPBR's opaque white plastic without emission.
pub const DEFAULTS: [f32; COUNT] = {
    let mut values = [0.0; COUNT];
    let mut parameter = 0;
    while parameter < NAMES.len() {
        let mut place = 0;
        while place < NAMES[parameter].width() {
            values[NAMES[parameter].offset + place] = NAMES[parameter].default[place];
            place += 1;
        }
        parameter += 1;
    }
    values
};

/// The parameter called `name`, if there is one.
pub fn find(name: &str) -> Option<&'static Parameter> {
    NAMES.iter().find(|parameter| parameter.name == name)
}
