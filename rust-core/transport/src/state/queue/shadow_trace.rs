//! What tracing shadow rays needs beside their queue.

use crate::graph::CHUNK;
use crate::media::shadow::{OpticalDepth, TrackedRays};
use crate::state::mix_weights::MixWeights;
use crate::state::queue::shadow_order::ShadowOrder;
use crate::state::queue::shadow_rays::{SHADOW_ROOM, ShadowRays};
use crate::state::rays::Rays;
use crate::state::textured_emission::EmissionScratch;
use crate::state::wavelengths::{ChunkWavelengths, SlotWavelengths};
use crate::tables::Tables;
use crate::words::ray_mask;
use gonio_accel::TransparentHit;
use gonio_simd::{Column, Lanes, PADDING, SpectrumColumns};
use std::sync::Arc;

/// Scratch of the shadow stage.
#[derive(Debug)]
pub(crate) struct ShadowTrace {
    /// Wavelengths of the rays' slots; none where slots are no paths', whose light is colour.
    pub(crate) wavelengths: Option<Arc<SlotWavelengths>>,
    /// The same by shadow ray; filled where anything absorbs.
    pub(crate) of_rays: ChunkWavelengths,
    pub(crate) order: ShadowOrder,
    /// By shadow ray, 1 where something opaque blocks it.
    pub(crate) blocked: Vec<u8>,
    /// Hits on the transparent surfaces that rays pass.
    pub(crate) passed: Vec<TransparentHit>,
    /// By shadow ray, how many such hits it has; used where their number is limited.
    pub(crate) crossed: Vec<u32>,
    /// Weights of a mix at a chunk of such hits.
    pub(crate) weights: MixWeights,
    /// What a chunk of such hits lets pass.
    pub(crate) factors: SpectrumColumns,
    /// What takes light from the rays between surfaces.
    pub(crate) depth: OpticalDepth,
    pub(crate) linked: LinkedTrace,
    pub(crate) emission: EmissionScratch,
}

/// Shadow rays told apart by what blocks them; see `stage/light/linked_shadow.rs`.
#[derive(Debug)]
pub(crate) struct LinkedTrace {
    /// Rays that all instances block, or those with a visibility bit.
    pub(crate) plain: Vec<u32>,
    /// Rays whose hits are filtered, and the row of blockers of each.
    pub(crate) filtered: Vec<u32>,
    pub(crate) rows: Vec<u32>,
    /// The rays of one kind, and which are blocked.
    pub(crate) rays: Rays,
    pub(crate) blocked: Vec<u8>,
}

impl ShadowTrace {
    /// Makes room for so many rays: none has passed anything, and beyond them all are blocked.
    pub(crate) fn begin(&mut self, rays: usize) {
        self.blocked.clear();
        self.blocked.resize(rays + PADDING, 1);
        self.passed.clear();
    }

    /// Dims what rays carry that nothing blocks by the media along them that vary.
    #[inline(always)]
    pub(crate) fn track<L: Lanes>(&mut self, l: L, tables: &Tables, shadows: &mut ShadowRays) {
        let Rays { origin, direction, time, .. } = &shadows.rays;
        let wavelengths = self.of_rays.column();
        let rays = TrackedRays { origin: slices(origin), direction: slices(direction), time, salt: &shadows.salt, wavelengths };
        self.depth.track(l, &tables.materials.media, rays, &self.blocked, &mut shadows.contribution);
    }
}

fn slices([x, y, z]: &[Column; 3]) -> [&[f32]; 3] {
    [x, y, z]
}

impl Default for LinkedTrace {
    fn default() -> Self {
        let (rays, blocked) = (Rays::new(SHADOW_ROOM, ray_mask::SHADOW), vec![0; SHADOW_ROOM]);
        Self { plain: Vec::new(), filtered: Vec::new(), rows: Vec::new(), rays, blocked }
    }
}

impl Default for ShadowTrace {
    fn default() -> Self {
        Self {
            wavelengths: None,
            of_rays: ChunkWavelengths::default(),
            order: ShadowOrder::default(),
            blocked: Vec::new(),
            passed: Vec::new(),
            crossed: Vec::new(),
            weights: MixWeights::default(),
            factors: SpectrumColumns::new(CHUNK),
            depth: OpticalDepth::new(SHADOW_ROOM),
            linked: LinkedTrace::default(),
            emission: EmissionScratch::default(),
        }
    }
}
