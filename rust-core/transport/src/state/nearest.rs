//! The nearest hits of a batch of paths, and the lists of paths that met no surface (pbrt's escaped-ray and hit-area-light queues).

use crate::state::rays::Rays;
use gonio_accel::Hits;
use gonio_camera::sampler::CAPACITY;
use gonio_simd::padded;

/// What the rays of a batch of paths met.
#[derive(Debug)]
pub(crate) struct NearestHits {
    /// By path.
    pub(crate) hits: Hits,
    /// Paths that escaped, and those that hit the shape of a light.
    pub(crate) escaped: Vec<u32>,
    pub(crate) at_lights: Vec<u32>,
    /// Rays that go on behind the shapes of lights, and their hits.
    pub(crate) behind_rays: Rays,
    pub(crate) behind: Hits,
}

impl Default for NearestHits {
    fn default() -> Self {
        let (hits, behind) = (Hits::default(), Hits::default());
        Self { hits, escaped: Vec::new(), at_lights: Vec::new(), behind_rays: Rays::new(padded(CAPACITY), 0), behind }
    }
}
