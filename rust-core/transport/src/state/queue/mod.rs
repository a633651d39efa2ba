//! What shading sends on: the queues of later stages and of the next bounce (pbrt's work queues), and the scratch of the shadow stage.

pub(crate) mod branches;
pub(crate) mod light_samples;
pub(crate) mod measure_points;
pub(crate) mod shadow_order;
pub(crate) mod shadow_rays;
pub(crate) mod shadow_trace;
pub(crate) mod walks;

use crate::state::light_paths::LightPathQueues;
use crate::state::paths::Paths;
use branches::Branches;
use light_samples::LightSampleQueue;
use measure_points::MeasurePoints;
use shadow_rays::ShadowRays;
use walks::Walks;

/// The queues that shading fills.
#[derive(Debug, Default)]
pub(crate) struct Queues {
    /// Paths that go on.
    pub(crate) next: Paths,
    /// Rays of trees (Whitted) that go on.
    pub(crate) branches: Branches,
    /// Rays to sampled lights.
    pub(crate) shadows: ShadowRays,
    /// Random walks under surfaces.
    pub(crate) walks: Walks,
    /// Points whose illuminance is wanted.
    pub(crate) measure: MeasurePoints,
    /// NEE of the chunk under way.
    pub(crate) light_samples: LightSampleQueue,
    /// Photons about the points of a register.
    pub(crate) photons: [Vec<u32>; gonio_simd::PADDING],
    /// What light paths start with and bring.
    pub(crate) light_paths: LightPathQueues,
}
