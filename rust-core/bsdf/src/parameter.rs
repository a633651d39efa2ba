//! The internal parameter block: one place for each number of a layered surface, with OpenPBR's names and meanings where it has them.
//!
//! Front ends and node graphs address places by name through [`NAMES`]; kernels by the constants. Colours take three places.

use gonio_simd::{Lanes, Rgb, Spectrum};

/// A named run of places in the block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name, in snake case.
    pub name: &'static str,
    /// First place.
    pub offset: usize,
    /// Value when nothing is said; its length is the number of places.
    pub default: &'static [f32],
}

impl Parameter {
    /// Places taken: 1 for a number, 3 for a colour.
    pub const fn width(&self) -> usize {
        self.default.len()
    }
}

macro_rules! block {
    (@place $at:expr;) => {
        /// Places in the block.
        pub const COUNT: usize = $at;
    };
    (@place $at:expr; $(#[$doc:meta])* $constant:ident $name:literal $default:expr; $($rest:tt)*) => {
        $(#[$doc])*
        pub const $constant: usize = $at;
        block!(@place $constant + { const DEFAULT: &[f32] = &$default; DEFAULT.len() }; $($rest)*);
    };
    ($($(#[$doc:meta])* $constant:ident $name:literal $default:expr;)*) => {
        block!(@place 0; $($(#[$doc])* $constant $name $default;)*);
        /// All parameters in the order of their places.
        pub const NAMES: &[Parameter] = &[$(Parameter { name: $name, offset: $constant, default: &$default }),*];
    };
}

block! {
    /// Colour of the diffuse base, normal reflectance of the metal and tint of a measurement; OpenPBR's `base_weight` is multiplied in.
    BASE_COLOR "base_color" [0.8, 0.8, 0.8];
    /// Roughness sigma of the diffuse base, 0 (Lambert) to 1.
    DIFFUSE_ROUGHNESS "diffuse_roughness" [0.0];
    /// Share of metal in the base, 0 to 1.
    METALNESS "metalness" [0.0];
    /// Factor on the whole metal lobe; OpenPBR's `specular_weight` goes here too.
    METAL_WEIGHT "metal_weight" [1.0];
    /// Reflectance of the metal at 82 degrees over Schlick's (F82), its reflectance at grazing (Schlick), or Gulbrandsen's edge tint.
    METAL_EDGE_TINT "metal_edge_tint" [1.0, 1.0, 1.0];
    /// Refractive index of a conductor.
    METAL_N "metal_n" [2.757, 2.513, 2.231];
    /// Extinction coefficient of a conductor.
    METAL_K "metal_k" [3.867, 3.404, 3.009];
    /// Factor on the dielectric's normal reflectance; it changes the index that shapes the Fresnel curve. OpenPBR's `specular_weight`,
    /// twice Principled's Specular IOR Level.
    SPECULAR_WEIGHT "specular_weight" [1.0];
    /// Factor on the dielectric's reflectance at all angles (standard_surface's `specular`), and on a measurement.
    SPECULAR_SCALE "specular_scale" [1.0];
    /// Tint of the dielectric's reflection: at normal incidence only or at all angles, by [`Tint`](super::Tint).
    SPECULAR_COLOR "specular_color" [1.0, 1.0, 1.0];
    /// Roughness r of the base; alpha = r².
    ROUGHNESS "specular_roughness" [0.3];
    /// Anisotropy, 0 to 1 (−1 to 1 for the single-lobe form); the widths follow from [`Anisotropy`](super::Anisotropy).
    ANISOTROPY "specular_anisotropy" [0.0];
    /// Turn of the tangent about the normal, in turns.
    ROTATION "specular_rotation" [0.0];
    /// Index of refraction of the dielectric base.
    IOR "specular_ior" [1.5];
    /// Share of transmission in the dielectric base, 0 to 1.
    TRANSMISSION_WEIGHT "transmission_weight" [0.0];
    /// Tint of what passes: for each interface if the depth is 0, over the depth otherwise; of the whole sheet if thin-walled.
    TRANSMISSION_COLOR "transmission_color" [1.0, 1.0, 1.0];
    /// Distance in metres after which white light has the transmission colour; 0 tints the interface instead.
    TRANSMISSION_DEPTH "transmission_depth" [0.0];
    /// Added to the roughness of the transmission, the sum held in 0 to 1.
    TRANSMISSION_EXTRA_ROUGHNESS "transmission_extra_roughness" [0.0];
    /// Share of subsurface scattering in the opaque dielectric base, 0 to 1.
    SUBSURFACE_WEIGHT "subsurface_weight" [0.0];
    /// Colour of the subsurface scattering.
    SUBSURFACE_COLOR "subsurface_color" [0.8, 0.8, 0.8];
    /// Mean free path in metres, by channel.
    SUBSURFACE_RADIUS "subsurface_radius" [1.0, 0.5, 0.25];
    /// Anisotropy g of the scattering; of a thin wall, (1 − g) / 2 reflects and (1 + g) / 2 passes.
    SUBSURFACE_ANISOTROPY "subsurface_scatter_anisotropy" [0.0];
    /// Index for the lengths and the way in of skin, and for the way in of subsurface scattering without a specular layer.
    SUBSURFACE_IOR "subsurface_ior" [1.4];
    /// Presence of the coat, 0 to 1.
    COAT_WEIGHT "coat_weight" [0.0];
    /// Tint of what lies under the coat.
    COAT_COLOR "coat_color" [1.0, 1.0, 1.0];
    /// Roughness of the coat.
    COAT_ROUGHNESS "coat_roughness" [0.0];
    /// Index of refraction of the coat.
    COAT_IOR "coat_ior" [1.6];
    /// How far the coat's inner reflections darken the base, 0 to 1.
    COAT_DARKENING "coat_darkening" [1.0];
    /// How far the coat deepens diffuse colours: they are raised to 1 + weight × this.
    COAT_AFFECT_COLOR "coat_affect_color" [0.0];
    /// How far the coat's roughness roughens the base: r goes to 1 by weight × coat roughness × this.
    COAT_AFFECT_ROUGHNESS "coat_affect_roughness" [0.0];
    /// Presence of the fuzz, 0 to 1.
    FUZZ_WEIGHT "fuzz_weight" [0.0];
    /// Colour of the fuzz.
    FUZZ_COLOR "fuzz_color" [1.0, 1.0, 1.0];
    /// Roughness of the fuzz.
    FUZZ_ROUGHNESS "fuzz_roughness" [0.5];
    /// Presence of the thin film, 0 to 1.
    THIN_FILM_WEIGHT "thin_film_weight" [0.0];
    /// Thickness of the film in nanometres.
    THIN_FILM_THICKNESS "thin_film_thickness" [500.0];
    /// Index of refraction of the film.
    THIN_FILM_IOR "thin_film_ior" [1.4];
    /// Cone of full brightness of a toon lobe, in right angles.
    TOON_SIZE "toon_size" [0.5];
    /// Angle over which a toon lobe fades, in right angles.
    TOON_SMOOTH "toon_smooth" [0.0];
    /// Absorption coefficient inside a fibre, in units of one over its radius.
    HAIR_ABSORPTION "hair_absorption" [0.245_531, 0.52, 1.365];
    /// Variances along a fibre of R, TT and TRT: about the squares of their widths in radians.
    HAIR_VARIANCE "hair_variance" [0.084_61, 0.021_15, 0.338_4];
    /// Widths about a fibre of the same, radians; √(π/8) times them are the scales of logistic distributions.
    HAIR_SCALE "hair_scale" [0.187, 0.187, 0.187];
    /// Tilt of the cuticle's scales towards the root, radians.
    HAIR_TILT "hair_tilt" [0.034_906_6];
    /// Factor on what a fibre reflects.
    HAIR_TINT_R "hair_tint_r" [1.0, 1.0, 1.0];
    /// Factor on what passes a fibre.
    HAIR_TINT_TT "hair_tint_tt" [1.0, 1.0, 1.0];
    /// Factor on what a fibre reflects inside.
    HAIR_TINT_TRT "hair_tint_trt" [1.0, 1.0, 1.0];
    /// Half axis of an elliptic fibre across `hair_turn`, over the one along it.
    HAIR_ASPECT "hair_aspect" [1.0];
    /// Angle about the fibre from the normal to that half axis, radians, from the tangent on to the right.
    HAIR_TURN "hair_turn" [0.0];
    /// Whether an elliptic fibre is seen over its whole width at each hit: 1 where the surface does not tell the place across, as on meshes.
    HAIR_WHOLE "hair_whole" [0.0];
    /// Widths of the older hair lobes along and about the fibre, radians.
    HAIR_WIDTHS "hair_widths" [0.1, 1.0];
    /// Where a portal's light goes on, in the world, metres.
    PORTAL_POSITION "portal_position" [0.0, 0.0, 0.0];
    /// In which direction, in the world; zero for straight on.
    PORTAL_DIRECTION "portal_direction" [0.0, 0.0, 0.0];
    /// Emitted radiance: linear Rec.709 whose luminance is in cd/m².
    EMISSION_COLOR "emission_color" [0.0, 0.0, 0.0];
    /// Share of the surface that is there at all, 0 to 1.
    OPACITY "geometry_opacity" [1.0];
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

/// Door for light: a parameter, or the weight of a closure, as what it does to light. The first of the four doors; see ARCHITECTURE.md.
#[inline(always)]
pub fn spectrum<L: Lanes>(stored: Rgb<L>) -> Spectrum<L> {
    Spectrum::from_rgb(stored)
}

/// The parameter called `name`, if there is one.
pub fn find(name: &str) -> Option<&'static Parameter> {
    NAMES.iter().find(|parameter| parameter.name == name)
}
