//! What the kernels see of a scene: compiled tables.

use super::{light_groups::LightGroups, shader_passes::ShaderOutputs};
use crate::{geometry::GeometryTable, graph::Program};
use gonio_accel::Tlas;
use gonio_bsdf::{Surface, parameter};
use gonio_image::texture::TextureTable;
use gonio_light::LightTable;
use std::sync::Arc;

/// One compiled closure: what a path meets at a hit.
#[derive(Clone, Debug)]
pub struct SurfaceMaterial {
    /// Constants, model and lobes.
    pub surface: Surface,
    /// What computes the parameters that are not constant.
    pub program: Program,
    /// Opacity below this is 0, else 1; 0 leaves it as it is.
    pub opacity_threshold: f32,
    /// Whether it may let straight light pass.
    pub transparent: bool,
    /// Whether it may emit.
    pub emissive: bool,
    /// Whether the shading frame's tangent matters.
    pub anisotropic: bool,
    /// Whether it cuts a hole into the coverage.
    pub holdout: bool,
    /// What the material index pass shows.
    pub pass_index: u32,
}

impl SurfaceMaterial {
    /// Whether it emits the same everywhere, nothing included.
    pub fn emits_evenly(&self) -> bool {
        !self.program.outputs.iter().any(|output| output.offset == parameter::EMISSION_COLOR)
    }
}

/// A material that is a weighted sum of closures: each hit takes one of them at random, by its weight.
#[derive(Clone, Debug)]
pub struct Mix {
    /// Number of the first closure among the surfaces.
    pub first: u32,
    /// Closures.
    pub count: usize,
    /// What computes the weights: output `i` is the colour of closure `i`.
    pub program: Program,
    /// Whether any closure may let straight light pass.
    pub transparent: bool,
    /// Whether any closure may emit.
    pub emissive: bool,
    /// What all closures emit together where that is the same everywhere.
    pub even_emission: Option<[f32; 3]>,
}

/// What a material number of the geometry stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// A surface by its number.
    Surface(u32),
    /// A mix by its number.
    Mix(u32),
}

/// All materials.
#[derive(Clone, Debug, Default)]
pub struct MaterialTable {
    /// Closures of all materials.
    pub surfaces: Vec<SurfaceMaterial>,
    /// Sums of closures.
    pub mixes: Vec<Mix>,
    /// The scene's materials in their order, then the default one.
    pub numbers: Vec<Shading>,
    /// Of the materials that have any, what they show in passes of their own.
    pub shader_outputs: Vec<ShaderOutputs>,
}

impl MaterialTable {
    /// The number that the geometry keeps for a material: mixes stand behind the surfaces.
    pub fn number(&self, material: usize) -> u32 {
        match self.numbers[material] {
            Shading::Surface(surface) => surface,
            Shading::Mix(mix) => self.surfaces.len() as u32 + mix,
        }
    }
    /// What a number of the geometry stands for.
    #[inline]
    pub fn shading(&self, number: u32) -> Shading {
        match number.checked_sub(self.surfaces.len() as u32) {
            None => Shading::Surface(number),
            Some(mix) => Shading::Mix(mix),
        }
    }
    /// Whether a material of the geometry may let straight light pass.
    pub fn transparent(&self, number: u32) -> bool {
        match self.shading(number) {
            Shading::Surface(surface) => self.surfaces[surface as usize].transparent,
            Shading::Mix(mix) => self.mixes[mix as usize].transparent,
        }
    }
    /// What a material of the geometry emits everywhere alike, if it does so at all.
    pub fn even_emission(&self, number: u32) -> Option<[f32; 3]> {
        let emission = match self.shading(number) {
            Shading::Surface(surface) => {
                let material = &self.surfaces[surface as usize];
                let glow = &material.surface.constants[parameter::EMISSION_COLOR..parameter::EMISSION_COLOR + 3];
                (material.emissive && material.emits_evenly()).then(|| [glow[0], glow[1], glow[2]])
            }
            Shading::Mix(mix) => self.mixes[mix as usize].even_emission,
        };
        emission.filter(|glow| glow.iter().any(|x| *x > 0.0))
    }
}

/// The tables of a compiled scene.
#[derive(Debug)]
pub struct Tables {
    /// Two-level tree; instances of light shapes follow those of meshes.
    pub bvh: Tlas,
    /// Meshes and instances.
    pub geometry: GeometryTable,
    /// Materials.
    pub materials: MaterialTable,
    /// Images.
    pub textures: TextureTable,
    /// Lights.
    pub lights: Arc<LightTable>,
    /// First instance that is a light's shape.
    pub first_light_instance: u32,
    /// Light of each such instance.
    pub instance_light: Vec<u32>,
    /// First light of each mesh instance whose triangles are lights, or [`crate::geometry::NONE`]; empty if there is none.
    pub triangle_lights: Vec<u32>,
    /// 1 for lights that paths among catchers alone do not know; empty if there is none.
    pub object_lights: Vec<u32>,
    /// Lights by group.
    pub groups: LightGroups,
    /// Whether any material lets straight light pass.
    pub any_transparent: bool,
    /// Whether any material absorbs light inside.
    pub any_absorbing: bool,
    /// World position of the rebased origin, metres.
    pub origin: [f64; 3],
}
