//! A scene laid out for rendering, and what it leaves for the next compilation.

use super::fields::KeptFields;
use super::{
    bounds::Bounds, casters::Casters, dice::KeptDiced, displace::KeptDisplaced, glasses::Glasses, kept::KeptImages,
    light_images::LightImages, lights::KeptLights, measured::CompiledMeasured, metals::Metals,
};
use super::{primvars, smooth::KeptSmooth, trees::KeptTree, wavelengths::LampSpectra};
use crate::{
    error::Diagnostic,
    film::Besides,
    scene::{Camera, Manifests},
    transport::{Tables, Workspaces},
};
use std::sync::Arc;

/// A scene laid out for rendering.
#[derive(Debug)]
pub struct CompiledScene {
    /// What the kernels read.
    pub tables: Tables,
    /// The scene's cameras.
    pub cameras: Vec<Camera>,
    /// World bounds of all instances, metres.
    pub bounds: Bounds,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
    /// Sizes and times.
    pub statistics: CompileStatistics,
    /// The names in the mattes that the scene's passes show.
    pub(crate) manifests: Arc<Manifests>,
    /// What films of the scene keep besides passes.
    pub(crate) besides: Besides,
    /// What casts caustics.
    pub(crate) casters: Casters,
    /// Names of the primvars in the tables, whose columns follow that of the normals.
    pub(super) primvars: Vec<String>,
    /// Pictures over its lights.
    pub(crate) light_images: LightImages,
    /// Spectra of its lamps.
    pub(super) spectra: LampSpectra,
    /// Its metals.
    pub(super) metals: Metals,
    /// Its glasses.
    pub(super) glasses: Glasses,
    /// What renders leave for the next.
    pub(crate) workspaces: Arc<Workspaces>,
    /// What it was made of.
    pub(super) kept: Kept,
}

/// Sizes and times of a compiled scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct CompileStatistics {
    /// Triangles of all meshes, each once.
    pub triangles: u64,
    /// Triangles of all instances.
    pub instanced_triangles: u64,
    /// Straight pieces that curves were cut into, all curves once.
    pub segments: u64,
    /// Points with a size, all once.
    pub points: u64,
    /// Instances.
    pub instances: u64,
    /// Lights, triangles of emissive meshes among them.
    pub lights: u64,
    /// Bytes of trees and tables.
    pub geometry_bytes: u64,
    /// Bytes of textures.
    pub texture_bytes: u64,
    /// Seconds spent on textures: reading, decoding, filtering.
    pub textures_s: f64,
    /// Seconds spent on building trees.
    pub build_s: f64,
    /// Seconds spent in all.
    pub total_s: f64,
}

/// What a compilation leaves for the next, which takes over what did not change.
#[derive(Debug, Default)]
pub(super) struct Kept {
    pub(super) trees: Vec<KeptTree>,
    pub(super) smooth: Vec<KeptSmooth>,
    pub(super) diced: Vec<KeptDiced>,
    pub(super) displaced: Vec<KeptDisplaced>,
    pub(super) images: KeptImages,
    pub(super) lights: KeptLights,
    pub(super) measured: CompiledMeasured,
    pub(super) fields: KeptFields,
}

impl CompiledScene {
    /// The column of a primvar in the tables.
    pub(crate) fn primvar_column(&self, name: &str) -> Option<usize> {
        primvars::column(&self.primvars, name)
    }
}
