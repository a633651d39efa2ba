//! The nearest hits of a batch of paths, and the lists of paths that met no surface (pbrt's escaped-ray and hit-area-light queues).

use crate::state::rays::Rays;
use gonio_accel::{Hits, NONE};
use gonio_camera::sampler::CAPACITY;
use gonio_simd::{PADDING, padded};

/// What the rays of a batch of paths met.
#[derive(Debug)]
pub(crate) struct NearestHits {
    /// By path.
    pub(crate) hits: Hits,
    /// Paths that escaped, and those whose rays stand before the shape of a light.
    pub(crate) escaped: Vec<u32>,
    pub(crate) at_lights: Vec<u32>,
    /// Shapes of lights before the hits.
    pub(crate) lights: MetLights,
    /// Rays that go on behind the shapes of lights, and their hits.
    pub(crate) behind_rays: Rays,
    pub(crate) behind: Hits,
}

impl Default for NearestHits {
    fn default() -> Self {
        Self {
            hits: Hits::default(),
            escaped: Vec::new(),
            at_lights: Vec::new(),
            lights: MetLights::default(),
            behind_rays: Rays::new(padded(CAPACITY), 0),
            behind: Hits::default(),
        }
    }
}

/// The shapes of lights that rays went through, in registers of different paths; a place that no ray has holds [`NONE`] as its path.
#[derive(Debug, Default)]
pub(crate) struct MetLights {
    pub(crate) path: Vec<u32>,
    /// Instance of the shape, and its distance along the ray, metres.
    pub(crate) instance: Vec<u32>,
    pub(crate) t: Vec<f32>,
}

impl MetLights {
    pub(crate) fn clear(&mut self) {
        self.path.clear();
        self.instance.clear();
        self.t.clear();
    }
    /// Notes what some paths hit, each once.
    pub(crate) fn note(&mut self, paths: &[u32], hits: &Hits) {
        self.path.extend(paths);
        self.instance.extend(paths.iter().map(|path| hits.instance[*path as usize]));
        self.t.extend(paths.iter().map(|path| hits.t[*path as usize]));
        // A path that meets another light comes in another register.
        let whole = self.path.len().next_multiple_of(PADDING);
        self.path.resize(whole, NONE);
        self.instance.resize(whole, self.instance[0]);
        self.t.resize(whole, 0.0);
    }
}
