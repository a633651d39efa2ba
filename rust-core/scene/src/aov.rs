//! Output variables: what passes show.

use super::cryptomatte::MatteKind;
use serde::{Deserialize, Serialize};

/// An output variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Aov {
    /// Radiance times the camera's exposure, with alpha.
    Color,
    /// Coverage.
    Alpha,
    /// Distance along the camera's axis in metres.
    Depth,
    /// Shading normal, world space.
    Normal,
    /// Position in metres, world space.
    P,
    /// Directional albedo.
    Albedo,
    /// Number of the instance set, as gonio counts them.
    PrimId,
    /// Luminance in cd/m².
    Luminance,
    /// Illuminance in lux at the first surface.
    Illuminance,
    /// Texture coordinates `st` with 1 in the third channel.
    Uv,
    /// How far into the mist, 0 to 1, by [`Mist`].
    Mist,
    /// Normals for denoisers.
    DenoisingNormal,
    /// Albedo for denoisers.
    DenoisingAlbedo,
    /// What of the colour denoisers should leave as it is: light that the camera sees straight, in mirrors and through smooth glass. It
    /// comes from camera rays of its own, as do the guides; where there are none (shadow catchers, samples on a grid) it is zero.
    DenoisingLight,
    /// What surfaces that the camera sees emit.
    Emission,
    /// What the camera sees of lights at infinity.
    Environment,
    /// Pass index of the instance.
    ObjectIndex,
    /// Pass index of the material.
    MaterialIndex,
    /// Samples a pixel.
    SampleCount,
    /// Light by the kind of the first scattering, divided by that kind's colour: of lights themselves, or of other surfaces; and the colour.
    Light(ScatteringKind, LightPart),
    /// What the materials' shader outputs of a name show; the name is an entry of [`Settings::shader_passes`].
    Shader(ShaderValue, u16),
    /// The colour that a group of lights brings; its name is an entry of [`Settings::light_groups`]. All groups of a scene sum up to the colour.
    LightGroup(u16),
    /// Two ranks of a cryptomatte: the value of a name and its share of the pixel, twice. The second number is that of the layer.
    Cryptomatte(MatteKind, u8),
    /// Light of the classes whose bits are set, see [`super::LightPath`], times the camera's exposure; what it is called is an entry of
    /// [`super::Settings::light_paths`].
    LightPaths(u16, u16),
    /// Light whose paths an expression takes that parts these classes, times the camera's exposure; it is an entry of
    /// [`super::Settings::light_paths`].
    LightExpression(u16),
    /// How much of the light that shadow catchers would send is there in spite of the objects; 1 where there are no catchers.
    ShadowCatcher,
    /// Seconds spent on the pixel: those of its tile, shared out by rays.
    Cost,
    /// Number of the placement in its set.
    InstanceId,
    /// Number of the triangle in its mesh.
    ElementId,
    /// Pixels that what is seen moved since the frame before and moves until the next: x to the right and y upwards of where it was less where it
    /// is, and of where it is less where it will be. Keys of motion at times 0 and 1 say where things are at those frames; nothing is blurred.
    Motion,
    /// The colour by depth, in files of its own: the deep picture.
    Deep,
}

/// What stands before an expression in the name of its pass.
pub(super) const LIGHT_PATH: &str = "lpe:";
/// What stands before the name of a primvar in the name of its pass.
pub const PRIMVARS: &str = "primvars:";
/// The pass of normals in the camera's space, +z towards the eye.
pub const EYE_NORMAL: &str = "Neye";
/// The pass of positions in the camera's space, metres.
pub const EYE_POSITION: &str = "Peye";
/// The pass of ambient occlusion: how open surfaces are to their surroundings.
pub const AMBIENT_OCCLUSION: &str = "ambient_occlusion";

/// The kind of a shader pass whose output no material has to state.
pub(super) fn standard_pass(name: &str) -> Option<ShaderValue> {
    match name {
        EYE_NORMAL | EYE_POSITION => Some(ShaderValue::Color),
        AMBIENT_OCCLUSION => Some(ShaderValue::Number),
        name => name.starts_with(PRIMVARS).then_some(ShaderValue::Color),
    }
}

/// What stands before the name of a light group in the name of its pass.
pub const LIGHT_GROUP: &str = "lightgroup:";

/// The light group of all lights that are in none.
pub const OTHER_LIGHTS: &str = "other";

/// Kinds of values that shader passes hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ShaderValue {
    /// Colours, with alpha 1 where there is one.
    Color,
    /// Numbers.
    Number,
}

impl ShaderValue {
    /// What stands before the name of a shader output in the name of its pass.
    pub const PREFIXES: [(Self, &'static str); 2] = [(Self::Color, "aov:"), (Self::Number, "aov_value:")];
}

/// Kinds of scattering.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ScatteringKind {
    /// Diffuse, fuzz and subsurface.
    Diffuse,
    /// Reflection off facets.
    Glossy,
    /// Refraction and straight transmission.
    Transmission,
    /// In media.
    Volume,
}

/// Parts of the light that a kind of scattering shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum LightPart {
    /// Straight from lights.
    Direct,
    /// From other surfaces.
    Indirect,
    /// Not light but the albedo.
    Color,
}

impl Aov {
    /// All passes with their names, but for shader passes, light groups, mattes and light paths.
    pub const NAMES: [(Self, &'static str); 36] = {
        use LightPart::{Color, Direct, Indirect};
        use ScatteringKind::{Diffuse, Glossy, Transmission, Volume};
        [
            (Self::Color, "color"),
            (Self::Alpha, "alpha"),
            (Self::Depth, "depth"),
            (Self::Normal, "normal"),
            (Self::P, "P"),
            (Self::Albedo, "albedo"),
            (Self::PrimId, "primId"),
            (Self::Luminance, "luminance"),
            (Self::Illuminance, "illuminance"),
            (Self::Uv, "uv"),
            (Self::Mist, "mist"),
            (Self::DenoisingNormal, "denoising_normal"),
            (Self::DenoisingAlbedo, "denoising_albedo"),
            (Self::DenoisingLight, "denoising_light"),
            (Self::Emission, "emission"),
            (Self::Environment, "environment"),
            (Self::ObjectIndex, "object_index"),
            (Self::MaterialIndex, "material_index"),
            (Self::SampleCount, "sample_count"),
            (Self::ShadowCatcher, "shadow_catcher"),
            (Self::Cost, "cost"),
            (Self::InstanceId, "instanceId"),
            (Self::ElementId, "elementId"),
            (Self::Motion, "motion"),
            (Self::Deep, "deep"),
            (Self::Light(Diffuse, Direct), "diffuse_direct"),
            (Self::Light(Diffuse, Indirect), "diffuse_indirect"),
            (Self::Light(Diffuse, Color), "diffuse_color"),
            (Self::Light(Glossy, Direct), "glossy_direct"),
            (Self::Light(Glossy, Indirect), "glossy_indirect"),
            (Self::Light(Glossy, Color), "glossy_color"),
            (Self::Light(Transmission, Direct), "transmission_direct"),
            (Self::Light(Transmission, Indirect), "transmission_indirect"),
            (Self::Light(Transmission, Color), "transmission_color"),
            (Self::Light(Volume, Direct), "volume_direct"),
            (Self::Light(Volume, Indirect), "volume_indirect"),
        ]
    };

    /// The pass's name; empty for those with names of their own, which [`super::Settings::pass_name`] knows.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(known, _)| *known == self).map_or("", |(_, name)| name)
    }
    /// The pass of a name, in any case of letters.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| known.eq_ignore_ascii_case(name)).map(|(aov, _)| *aov)
    }
}
