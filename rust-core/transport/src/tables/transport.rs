//! Settings of a view that stages read: bounce limits, clamps, wanted passes, seed. Nothing changes them during a render.

use crate::graph::CHUNK;
use crate::state::shadow_rays::SHADOW_ROOM;
use crate::tables::light_groups::GroupPasses;
use crate::tables::shader_passes::ShaderPasses;
use gonio_light::{FixedLightSample, LightCache};
use gonio_simd::{Execution, PADDING};
use std::sync::Arc;

/// Settings of a view that stages read, as pbrt's integrators hold them.
#[derive(Clone, Debug)]
pub struct Transport {
    /// How kernels run.
    pub execution: Execution,
    /// Most bounces: scatterings after the first surface.
    pub max_bounces: u32,
    /// The same by kind: diffuse, glossy, transmitted, straight through; at most 255.
    pub kind_bounces: [u32; 4],
    /// Whether the camera sees infinite lights.
    pub shows_environment: bool,
    /// Whether they cover the background.
    pub environment_covers: bool,
    /// Which passes (AOVs) of first surfaces are wanted.
    pub passes: FirstPasses,
    /// Whether illuminance is measured.
    pub measure: bool,
    /// Limits of direct and indirect contributions; 0 is off.
    pub clamps: [f32; 2],
    /// The camera's position and viewing direction, rebased world space.
    pub eye: [f32; 3],
    /// The camera's viewing direction, see `eye`.
    pub forward: [f32; 3],
    /// Seed of the random numbers.
    pub seed: u32,
    /// Samples a pixel in the whole render.
    pub samples: u32,
    /// The learned light cache, if there is one: which lights arrive where.
    pub light_cache: Option<Arc<LightCache>>,
    /// Which light counts, by the path that found it.
    pub path_filter: PathFilter,
    /// The light samples that every point takes where trees of rays (Whitted) stand in for paths; `None` for path tracing.
    pub fixed_samples: Option<Arc<[FixedLightSample]>>,
}

/// Which light counts, by the path that found it. A path is specular while it has met nothing but mirrors and smooth glass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathFilter {
    /// All of it.
    #[default]
    All,
    /// Light on specular paths; paths end at other surfaces.
    SpecularOnly,
    /// Light on all other paths.
    ExceptSpecular,
}

/// Which passes (AOVs) of first surfaces are wanted, beyond those that are always summed.
#[derive(Clone, Debug, Default)]
pub struct FirstPasses {
    /// Depth, normal, position and albedo.
    pub surface: bool,
    /// Texture coordinates.
    pub uv: bool,
    /// Start, depth and falloff of the mist.
    pub mist: Option<Mist>,
    /// Albedo and normal for denoisers.
    pub guides: bool,
    /// Numbers and pass indices of instances and materials.
    pub numbers: bool,
    /// What materials compute for passes of their own.
    pub shader: ShaderPasses,
    /// Which groups of lights are summed apart.
    pub groups: GroupPasses,
}

/// The mist pass: metres at which it starts, metres until it is full, exponent.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mist {
    /// Metres from the camera at which it starts.
    pub start: f32,
    /// Metres from there until it is full.
    pub depth: f32,
    /// Exponent of the share of the way.
    pub falloff: f32,
}

impl Transport {
    /// The clamp of contributions at a depth (Cycles' clamping): direct up to depth 1, indirect beyond.
    #[inline(always)]
    pub(crate) fn clamp(&self, depth: u32) -> f32 {
        self.clamps[usize::from(depth > 1)]
    }

    /// Shadow rays that a hit may send.
    pub(crate) fn rays_per_hit(&self) -> usize {
        self.fixed_samples.as_ref().map_or(1, |samples| samples.len().max(1))
    }

    /// Most hits that are lit together, whole registers: at most a chunk, and as many as have room for their shadow rays.
    pub(crate) fn hits_together(&self) -> usize {
        ((SHADOW_ROOM - PADDING) / self.rays_per_hit() / PADDING * PADDING).clamp(PADDING, CHUNK)
    }
}
