//! Materials: a surface model with parameters that are constants or outputs of a node graph.

use super::{Displacement, GlassIndex, LampSpectrum, MeasuredId, Medium, MetalIndex, Origin};
use gonio_nodes::{Graph, Input, NodeId};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The model whose rules a closure's parameters follow; parameter names are those of the surface's parameter block for all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Model {
    /// OpenPBR 1.1, gonio's own.
    #[default]
    OpenPbr,
    /// Blender's Principled BSDF.
    Principled,
    /// UsdPreviewSurface.
    PreviewSurface,
    /// Autodesk standard_surface.
    StandardSurface,
    /// glTF's metallic-roughness model.
    Gltf,
    /// Diffuse reflection alone.
    Diffuse,
    /// Reflection with the base colour at all angles.
    Glossy,
    /// A dielectric's boundary, both ways tinted by the base colour.
    Glass,
    /// Refraction alone.
    Refraction,
    /// Metal by normal colour and edge tint.
    Metallic,
    /// Metal by n and k.
    Conductor,
    /// Fuzz alone.
    Sheen,
    /// Velvet of Ashikhmin's model alone.
    Velvet,
    /// A cone of even brightness about the normal.
    DiffuseToon,
    /// A cone of even brightness about the mirror direction.
    GlossyToon,
    /// A hair or fibre along the tangent (Chiang et al. 2016): the parameters `hair_*` and `specular_ior`.
    Hair,
    /// A fibre of elliptic section with a surface of facets (Huang et al. 2022): `hair_absorption`, `hair_tilt`, the tints, `hair_aspect`, `hair_turn`,
    /// `hair_whole`, `specular_roughness` and `specular_ior`.
    HairElliptic,
    /// What a fibre reflects as one lobe about its tangent, `base_color`, `hair_widths` and `hair_tilt`.
    HairReflection,
    /// What passes a fibre, likewise.
    HairTransmission,
    /// Diffuse transmission alone.
    Translucent,
    /// Subsurface scattering alone.
    Subsurface,
    /// Light goes straight through, tinted by the base colour.
    Transparent,
    /// Light goes on from `portal_position` along `portal_direction`, both in the world, tinted by the base colour; a direction of zero is straight
    /// on.
    Portal,
    /// Emission alone.
    Emission,
    /// Nothing, and no coverage either.
    Holdout,
    /// The measurement that [`Closure::measured`] names: its values times `base_color` (white unless set) and `specular_scale`, its tangent
    /// turned by `specular_rotation` turns. Where only the front's reflection was measured, the back reflects alike.
    Measured,
}

/// How the facets of rough reflection and refraction are distributed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Distribution {
    /// GGX, made up for what scatters between facets.
    #[default]
    MultiGgx,
    /// GGX.
    Ggx,
    /// Beckmann.
    Beckmann,
    /// Ashikhmin and Shirley.
    AshikhminShirley,
}

/// How subsurface parameters are meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SubsurfaceMethod {
    /// Random walk, mean free paths in metres (OpenPBR; Blender from 5.2).
    #[default]
    RandomWalk,
    /// Random walk as Blender had it up to 5.1.
    RandomWalkLegacy,
    /// Random walk for skin, entered along refracted directions.
    RandomWalkSkin,
    /// Christensen and Burley's diffusion profile.
    Burley,
}

impl Model {
    /// Whether it scatters about the tangent.
    pub fn is_fibre(self) -> bool {
        matches!(self, Self::Hair | Self::HairElliptic | Self::HairReflection | Self::HairTransmission)
    }
}

/// What the fibres of hair models lie along on triangles; strands have a direction of their own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FibreDirection {
    /// The first texture coordinate.
    #[default]
    Coordinate,
    /// The way from the triangle's first corner to its second, about the triangle's own normal.
    FirstEdge,
    /// The way from its first corner to its third, likewise.
    SecondEdge,
}

/// One way in which a surface scatters or emits, and how much of it there is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Closure {
    /// Multiplies all that it scatters and emits.
    pub weight: Input,
    /// The model whose rules the parameters follow.
    pub model: Model,
    /// Parameters that differ from the model's defaults, by the parameter block's names.
    pub parameters: Vec<(String, Input)>,
    /// A shading normal in world space.
    pub normal: Option<NodeId>,
    /// The coat's normal in world space; the surface's own without it.
    pub coat_normal: Option<NodeId>,
    /// Direction of anisotropy in world space; along the first texture coordinate without it.
    pub tangent: Option<NodeId>,
    /// What fibres lie along on triangles where no tangent is given.
    pub fibres: FibreDirection,
    /// The surface is a sheet: light that passes is not bent.
    pub thin_walled: bool,
    /// What the solid under the surface is, where it scatters: in place of absorption by depth.
    #[serde(skip_serializing_if = "Medium::is_clear")]
    pub solid: Medium,
    /// Opacity below this counts as 0, else as 1; 0 means opacity is as it is.
    pub opacity_threshold: f32,
    /// How facets are distributed.
    pub distribution: Distribution,
    /// How subsurface parameters are meant.
    pub subsurface: SubsurfaceMethod,
    /// What [`Model::Measured`] shows; without it that is grey. Of [`Model::OpenPbr`] it is the base under coat and fuzz, with the same
    /// meaning of `base_color`, `specular_scale` and `specular_rotation`.
    pub measured: Option<MeasuredId>,
    /// The metal that metallic parts are of, in place of their colours and of `metal_n` and `metal_k`; where `metalness` is not set it is 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub metal: Option<Arc<MetalIndex>>,
    /// The glass or liquid that refracting parts are of, in place of their index and Abbe number; where `transmission_weight` is not set it is 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub glass: Option<Arc<GlassIndex>>,
}

impl Default for Closure {
    fn default() -> Self {
        Self {
            weight: Input::Constant([1.0; 4]),
            model: Model::default(),
            parameters: Vec::new(),
            normal: None,
            coat_normal: None,
            tangent: None,
            fibres: FibreDirection::default(),
            thin_walled: false,
            solid: Medium::default(),
            opacity_threshold: 0.0,
            distribution: Distribution::default(),
            subsurface: SubsurfaceMethod::default(),
            measured: None,
            metal: None,
            glass: None,
        }
    }
}

impl Closure {
    /// Sets a scalar parameter.
    pub fn set(&mut self, name: &str, value: f32) {
        self.set_input(name, Input::Constant([value; 4]));
    }
    /// Sets a colour parameter.
    pub fn set_colour(&mut self, name: &str, [r, g, b]: [f32; 3]) {
        self.set_input(name, Input::Constant([r, g, b, 1.0]));
    }
    /// Sets a parameter, replacing an earlier value.
    pub fn set_input(&mut self, name: &str, input: Input) {
        match self.parameters.iter_mut().find(|(known, _)| known == name) {
            Some((_, value)) => *value = input,
            None => self.parameters.push((name.to_owned(), input)),
        }
    }
    /// The value set for a parameter.
    pub fn input(&self, name: &str) -> Option<Input> {
        self.parameters.iter().find(|(known, _)| known == name).map(|(_, input)| *input)
    }
}

/// What a material shows in the shader passes of a name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaderOutput {
    /// Name of the passes.
    pub name: String,
    /// What a pass of colours shows.
    pub color: Input,
    /// What a pass of numbers shows.
    pub value: Input,
}

/// What a surface is made of: closures whose sum it is, over one graph. Without any it is black.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Material {
    /// Where it came from.
    pub origin: Origin,
    /// The closures.
    pub closures: Vec<Closure>,
    /// The nodes that inputs refer to.
    pub graph: Graph,
    /// The shading normal in world space that counts as the surface's own, of displacement that is shown as bump: closures' normals are bent
    /// from it. Closures without a normal of their own name it too.
    pub normal: Option<NodeId>,
    /// How far the surface lies off the mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacement: Option<Displacement>,
    /// The spectrum of what its surface sends, whose colour takes the place of the emission's, with its luminance; none: the spectrum is made of the colour.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Arc<LampSpectrum>>,
    /// What fills the closed mesh that the surface is of.
    #[serde(skip_serializing_if = "Medium::is_clear")]
    pub medium: Medium,
    /// Whether light comes through where the surface is transparent; otherwise it blocks shadow rays as an opaque one.
    #[serde(skip_serializing_if = "is_true")]
    pub transparent_shadows: bool,
    /// What the material index pass shows.
    pub pass_index: u32,
    /// What shader passes show; entries of one name add up.
    pub shader_outputs: Vec<ShaderOutput>,
}

fn is_true(value: &bool) -> bool {
    *value
}

impl Default for Material {
    fn default() -> Self {
        let closures = vec![Closure::default()];
        Self {
            origin: Origin::default(),
            closures,
            graph: Graph::default(),
            normal: None,
            displacement: None,
            spectrum: None,
            medium: Medium::default(),
            transparent_shadows: true,
            pass_index: 0,
            shader_outputs: Vec::new(),
        }
    }
}

impl Material {
    /// A grey Lambertian surface of the given reflectance.
    pub fn diffuse(origin: Origin, reflectance: [f32; 3]) -> Self {
        let mut surface = Closure::default();
        surface.set_colour("base_color", reflectance);
        surface.set("specular_weight", 0.0);
        Self::of(origin, surface)
    }
    /// Nothing at its surface, a medium behind it.
    pub fn volume(origin: Origin, medium: Medium) -> Self {
        let mut surface = Closure { model: Model::Transparent, ..Closure::default() };
        surface.set_colour("base_color", [1.0; 3]);
        Self { medium, ..Self::of(origin, surface) }
    }
    /// A material of one closure, without a graph.
    pub fn of(origin: Origin, closure: Closure) -> Self {
        Self { origin, closures: vec![closure], ..Self::default() }
    }
}
