//! The choices in which layered models differ beyond their numbers.

/// What a layer takes from those under it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Attenuation {
    /// Each channel of the layer's albedo at the view.
    #[default]
    PerChannel,
    /// The largest channel of the layer's albedo at the view, from all channels alike.
    LargestChannel,
}

/// Where the specular colour acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Tint {
    /// At all angles.
    #[default]
    WholeLobe,
    /// At normal incidence, white at grazing.
    Normal,
}

/// The diffuse base.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Diffuse {
    /// Energy-preserving Oren–Nayar: scattering between facets goes with the square of the colour.
    #[default]
    Eon,
    /// The same with the cube of the colour, as Cycles has it.
    EonCubed,
    /// Fujii's Oren–Nayar, single scattering only.
    OrenNayar,
}

/// The metal's reflectance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Metal {
    /// Normal colour and tint at 82 degrees (Kutz, Hasan, Edmondson 2021).
    #[default]
    F82,
    /// Exact, from the conductor's n and k.
    Conductor,
    /// Exact, n and k derived from normal colour and edge tint (Gulbrandsen 2014).
    Gulbrandsen,
    /// Schlick's curve between the base colour and the edge tint.
    Schlick,
}

/// The dielectric's reflectance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Fresnel {
    /// The exact curve, its ends moved to the wanted values.
    #[default]
    Exact,
    /// Schlick's curve.
    Schlick,
}

/// The path that the coat's colour is taken along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum CoatPath {
    /// In and out, half each.
    #[default]
    Both,
    /// Out to the view only.
    View,
    /// No path: the colour at every angle.
    Flat,
}

/// The fuzz lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Fuzz {
    /// Volume of fibres as a linearly transformed cosine (Zeltner, Burley, Chiang 2022).
    #[default]
    Zeltner,
    /// Charlie (Estevez, Kulla 2017) with Ashikhmin's visibility.
    Charlie,
    /// Ashikhmin's velvet, an inverted Gaussian of width r; it takes nothing from what lies under it.
    Velvet,
}

/// The place of the fuzz among the layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FuzzOrder {
    /// Over everything.
    #[default]
    Top,
    /// Under the coat.
    UnderCoat,
    /// Under the specular lobe, over diffuse and subsurface alone.
    UnderSpecular,
}

/// What the fuzz takes from the layers under it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FuzzAttenuation {
    /// Its albedo without its colour.
    #[default]
    Grey,
    /// Its albedo with its colour.
    Coloured,
}

/// How anisotropy k and roughness r make the two widths; q = 1 − k, A = √(1 − c k).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Anisotropy {
    /// OpenPBR: r² √(2 / (1 + q²)) and q times it.
    #[default]
    OpenPbr,
    /// Principled: r² / A and r² A with c = 0.9.
    Principled,
    /// standard_surface: r² / A and r² A with A = √(1 − min(k, 0.98)).
    StandardSurface,
    /// glTF: from r² to 1 by k², and r².
    Gltf,
    /// Single glossy lobes: r² q and r² / q, exchanged for negative k.
    Glossy,
}

/// The distribution of facet normals of metal, specular and transmission lobes; the coat is always compensated GGX.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Distribution {
    /// GGX that gives back what scattering between facets loses.
    #[default]
    MultiGgx,
    /// GGX, single scattering.
    Ggx,
    /// Beckmann with Smith's masking as a rational fit (Walter et al. 2007), single scattering.
    Beckmann,
    /// Ashikhmin and Shirley's anisotropic Phong lobe (2000), for reflections; interfaces take [`Self::Ggx`] in its place.
    AshikhminShirley,
}

impl Distribution {
    /// Whether scattering between facets is given back.
    pub fn compensates(self) -> bool {
        self == Self::MultiGgx
    }
    /// What stands for the distribution where light is refracted.
    pub(crate) fn refracting(self) -> Self {
        if self == Self::AshikhminShirley { Self::Ggx } else { self }
    }
}

/// How light that enters the opaque base comes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SubsurfaceMethod {
    /// Where it entered, as a diffuse reflection.
    #[default]
    Diffuse,
    /// A walk whose albedo follows van de Hulst's inverse, with the radius as the mean free path (OpenPBR; Cycles from 5.2 on).
    RandomWalk,
    /// A walk whose albedo follows a fit in the anisotropy, with the radius over 4π as the transport mean free path (Cycles up to 5.1).
    RandomWalkLegacy,
    /// The same with lengths that follow from a dipole's reflectance, half of the light entering diffusely.
    RandomWalkSkin,
    /// Christensen and Burley's profile as the walk that it was fitted to: diffuse entry, radius over 4π as the mean free path.
    Burley,
}

/// What is done about shading normals that differ from the interpolated normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Bump {
    /// Nothing.
    #[default]
    None,
    /// Mirror directions are kept over the surface, light from behind it is held off, and the terminator of diffuse lobes is softened
    /// (Conty Estevez, Lecocq, Stein 2019), as in Cycles.
    Cycles,
}

/// Whether the surface has layers or is a single lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Closure {
    /// All layers.
    #[default]
    Layered,
    /// Diffuse reflection: base colour, diffuse roughness.
    Diffuse,
    /// Reflection of the base colour at all angles: roughness, anisotropy, rotation.
    Glossy,
    /// Interface whose reflection and refraction both have the base colour: roughness, index, film.
    Glass,
    /// Refraction alone: base colour, roughness, index.
    Refraction,
    /// Metal: the places of the metal, roughness, anisotropy, rotation, film.
    Metallic,
    /// Fuzz without anything under it: base colour, fuzz roughness.
    Sheen,
    /// A cone about the normal: base colour, toon size and smoothness.
    DiffuseToon,
    /// The same about the mirror direction.
    GlossyToon,
    /// Diffuse transmission: base colour.
    Translucent,
    /// Subsurface scattering without a specular layer: base colour, radius, anisotropy, roughness, index.
    Subsurface,
    /// Nothing but a colour that light takes straight through: base colour.
    Transparent,
    /// Light goes on from elsewhere: base colour, portal position and direction.
    Portal,
    /// A fibre: the places of the hair, index.
    Hair,
    /// A fibre of elliptic section with a surface of facets: absorption, tilt, tints, aspect and turn of the hair, roughness, index.
    HairElliptic,
    /// The older lobe of what a fibre reflects: base colour, widths and tilt of the hair.
    HairReflection,
    /// The older lobe of what passes a fibre.
    HairTransmission,
    /// What was measured, times the base colour: specular scale, rotation.
    Measured,
    /// Emission alone; the other closures emit too if the emission colour says so.
    Emission,
}

/// What stands over the emission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum EmissionOrder {
    /// Fuzz and coat.
    #[default]
    UnderCoat,
    /// Nothing.
    Top,
}

impl Closure {
    /// Whether it scatters about the tangent.
    pub fn is_fibre(self) -> bool {
        matches!(self, Self::Hair | Self::HairElliptic | Self::HairReflection | Self::HairTransmission)
    }
}

/// All choices of a surface; the default is gonio's own, OpenPBR as its specification has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switches {
    /// What a layer takes from those under it.
    pub attenuation: Attenuation,
    /// Where the specular colour acts.
    pub tint: Tint,
    /// Whether the specular weight changes the index that bends transmitted light.
    pub weight_bends: bool,
    /// The diffuse base.
    pub diffuse: Diffuse,
    /// The metal's reflectance.
    pub metal: Metal,
    /// The dielectric's reflectance.
    pub fresnel: Fresnel,
    /// The path that the coat's colour is taken along.
    pub coat_path: CoatPath,
    /// Whether inner reflections of the coat darken the base.
    pub coat_darkens: bool,
    /// Whether the coat roughens the base.
    pub coat_roughens: bool,
    /// Whether the coat lowers the relative index of the base.
    pub coat_lowers_ior: bool,
    /// Whether the coat's Fresnel curve has the base's index.
    pub coat_has_base_ior: bool,
    /// The fuzz lobe.
    pub fuzz: Fuzz,
    /// Its place.
    pub fuzz_order: FuzzOrder,
    /// What it takes.
    pub fuzz_attenuation: FuzzAttenuation,
    /// How the widths follow from anisotropy and roughness.
    pub anisotropy: Anisotropy,
    /// The distribution of facet normals.
    pub distribution: Distribution,
    /// Whether transmission leaves the anisotropy out.
    pub transmission_isotropic: bool,
    /// What stands over the emission.
    pub emission_order: EmissionOrder,
    /// Whether the surface is a sheet without inside.
    pub thin_walled: bool,
    /// How light that enters the opaque base comes back.
    pub subsurface: SubsurfaceMethod,
    /// What is done about bent shading normals.
    pub bump: Bump,
    /// All layers or a single lobe.
    pub closure: Closure,
}

impl Default for Switches {
    fn default() -> Self {
        Self {
            attenuation: Attenuation::PerChannel,
            tint: Tint::WholeLobe,
            weight_bends: true,
            diffuse: Diffuse::Eon,
            metal: Metal::F82,
            fresnel: Fresnel::Exact,
            coat_path: CoatPath::Both,
            coat_darkens: true,
            coat_roughens: true,
            coat_lowers_ior: true,
            coat_has_base_ior: false,
            fuzz: Fuzz::Zeltner,
            fuzz_order: FuzzOrder::Top,
            fuzz_attenuation: FuzzAttenuation::Grey,
            anisotropy: Anisotropy::OpenPbr,
            distribution: Distribution::MultiGgx,
            transmission_isotropic: false,
            emission_order: EmissionOrder::UnderCoat,
            thin_walled: false,
            subsurface: SubsurfaceMethod::Diffuse,
            bump: Bump::None,
            closure: Closure::Layered,
        }
    }
}

impl Switches {
    /// Blender's Principled BSDF.
    pub fn principled() -> Self {
        Self {
            attenuation: Attenuation::LargestChannel,
            tint: Tint::Normal,
            diffuse: Diffuse::EonCubed,
            coat_path: CoatPath::View,
            fuzz_attenuation: FuzzAttenuation::Coloured,
            anisotropy: Anisotropy::Principled,
            transmission_isotropic: true,
            ..Self::plain()
        }
    }
    /// A single lobe as Blender's node of that kind has it; the colour of all but emission and metal is the base colour.
    pub fn single(closure: Closure) -> Self {
        let anisotropy = if closure == Closure::Glossy { Anisotropy::Glossy } else { Anisotropy::Principled };
        Self { closure, anisotropy, emission_order: EmissionOrder::Top, ..Self::principled() }
    }
    /// UsdPreviewSurface.
    pub fn preview_surface() -> Self {
        Self {
            tint: Tint::Normal,
            metal: Metal::Schlick,
            fresnel: Fresnel::Schlick,
            coat_has_base_ior: true,
            emission_order: EmissionOrder::Top,
            ..Self::plain()
        }
    }
    /// Autodesk standard_surface as MaterialX has it.
    pub fn standard_surface() -> Self {
        Self {
            diffuse: Diffuse::OrenNayar,
            metal: Metal::Gulbrandsen,
            fuzz: Fuzz::Charlie,
            fuzz_order: FuzzOrder::UnderSpecular,
            anisotropy: Anisotropy::StandardSurface,
            ..Self::plain()
        }
    }
    /// glTF 2.0's material with its extensions.
    pub fn gltf() -> Self {
        Self {
            tint: Tint::Normal,
            fresnel: Fresnel::Schlick,
            fuzz: Fuzz::Charlie,
            fuzz_order: FuzzOrder::UnderCoat,
            fuzz_attenuation: FuzzAttenuation::Coloured,
            anisotropy: Anisotropy::Gltf,
            emission_order: EmissionOrder::Top,
            ..Self::plain()
        }
    }
    /// No interplay between coat and base: what the models before OpenPBR have in common.
    fn plain() -> Self {
        Self {
            weight_bends: false,
            coat_path: CoatPath::Flat,
            coat_darkens: false,
            coat_roughens: false,
            coat_lowers_ior: false,
            ..Self::default()
        }
    }
}
