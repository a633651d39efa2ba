//! Scratch for what meshes emit that glow by an image or a pattern; see `stage/light/textured_emission.rs`.

use crate::graph::CHUNK;
use crate::state::chunk::ChunkColumns;
use crate::state::mix_weights::MixWeights;
use crate::state::rays::Rays;
use gonio_accel::TransparentHit;
use gonio_simd::SpectrumColumns;

/// Ends of shadow rays on meshes whose emission programs know.
#[derive(Debug)]
pub(crate) struct EmissionScratch {
    /// Where rays end.
    pub(crate) ends: Vec<TransparentHit>,
    /// By shadow ray, the reciprocal of the mean radiance that its contribution has.
    pub(crate) inverse_mean: Vec<f32>,
    /// Weights of a mix at a chunk of ends.
    pub(crate) weights: MixWeights,
    /// What a chunk of ends emits, over the means.
    pub(crate) emitted: SpectrumColumns,
}

impl EmissionScratch {
    /// Makes room for so many rays.
    pub(crate) fn begin(&mut self, rays: usize) {
        self.ends.clear();
        self.inverse_mean.clear();
        self.inverse_mean.resize(rays, 0.0);
    }
}

impl Default for EmissionScratch {
    fn default() -> Self {
        Self { ends: Vec::new(), inverse_mean: Vec::new(), weights: MixWeights::default(), emitted: SpectrumColumns::new(CHUNK) }
    }
}

/// Scratch of [`crate::emitted`].
#[derive(Debug)]
pub struct EmissionRoom {
    pub(crate) rays: Rays,
    pub(crate) scratch: EmissionScratch,
    pub(crate) columns: ChunkColumns,
}

impl Default for EmissionRoom {
    fn default() -> Self {
        Self { rays: Rays::new(CHUNK, 0), scratch: EmissionScratch::default(), columns: ChunkColumns::default() }
    }
}
