//! What the kernels see of a scene: compiled tables.

use crate::{accel::SceneBvh, bsdf::Surface, geometry::GeometryTable, graph::Program, light::LightTable, texture::TextureTable};

/// A compiled material.
#[derive(Clone, Debug)]
pub struct SurfaceMaterial {
    /// Constants, model and lobes.
    pub surface: Surface,
    /// What computes the parameters that are not constant.
    pub program: Program,
    /// Opacity below this is 0, else 1; 0 leaves it as it is.
    pub opacity_threshold: f32,
    /// Whether the material may let straight light pass.
    pub transparent: bool,
    /// Whether the material may emit.
    pub emissive: bool,
    /// Whether the shading frame's tangent matters.
    pub anisotropic: bool,
}

/// All materials.
pub type MaterialTable = Vec<SurfaceMaterial>;

/// The tables of a compiled scene.
#[derive(Debug)]
pub struct Tables {
    /// Two-level tree; instances of light shapes follow those of meshes.
    pub bvh: SceneBvh,
    /// Meshes and instances.
    pub geometry: GeometryTable,
    /// Materials.
    pub materials: MaterialTable,
    /// Images.
    pub textures: TextureTable,
    /// Lights.
    pub lights: LightTable,
    /// First instance that is a light's shape.
    pub first_light_instance: u32,
    /// Light of each such instance.
    pub instance_light: Vec<u32>,
    /// First light of each mesh instance whose triangles are lights, or [`crate::geometry::NONE`]; empty if there is none.
    pub triangle_lights: Vec<u32>,
    /// Whether any material lets straight light pass.
    pub any_transparent: bool,
    /// Whether any material absorbs light inside.
    pub any_absorbing: bool,
    /// World position of the rebased origin, metres.
    pub origin: [f64; 3],
}
