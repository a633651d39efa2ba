//! Scratch of what places are in from which paths start; see `stage/start/start_media.rs`.

use crate::graph::CHUNK;
use crate::state::chunk::ChunkColumns;
use crate::state::mix_weights::MixWeights;
use crate::state::rays::Rays;
use crate::words::ray_mask;
use gonio_accel::{Hits, TransparentHit};
use gonio_camera::sampler::CAPACITY;
use gonio_simd::{Column, PADDING, SpectrumColumns, padded};

/// Surfaces of bodies that rays cross, and what absorbs behind them.
#[derive(Debug)]
pub(crate) struct StartRoom {
    /// Rays that still cross a body, and where they go on.
    pub(crate) pending: Vec<u32>,
    pub(crate) from: Vec<f32>,
    pub(crate) rays: Rays,
    pub(crate) instances: Vec<u32>,
    pub(crate) hits: Hits,
    pub(crate) crossings: Vec<TransparentHit>,
    /// By crossing, 1 where the ray enters the body, else −1.
    pub(crate) sides: Vec<f32>,
    /// By crossing, absorption a metre of the solid behind the surface, and its row where there is a solid, 0 where that does not scatter.
    pub(crate) absorption: SpectrumColumns,
    /// By crossing, see [`gonio_camera::Surroundings::tints`].
    pub(crate) tints: Vec<f32>,
    pub(crate) solid: Vec<Option<u32>>,
    /// By crossing, the row of what fills the body; 0 is nothing.
    pub(crate) filling: Vec<u32>,
    /// The crossing behind which the innermost solid about a ray's start lies, of those that start in one.
    pub(crate) innermost: Vec<usize>,
    /// Those of a chunk.
    pub(crate) chunk: SpectrumColumns,
    pub(crate) chunk_tints: Column,
    /// Weights of a mix over a chunk.
    pub(crate) weights: MixWeights,
    pub(crate) columns: ChunkColumns,
}

impl Default for StartRoom {
    fn default() -> Self {
        Self {
            pending: Vec::new(),
            from: Vec::new(),
            rays: Rays::new(padded(CAPACITY) + PADDING, ray_mask::ALL),
            instances: Vec::new(),
            hits: Hits::default(),
            crossings: Vec::new(),
            sides: Vec::new(),
            absorption: SpectrumColumns::new(0),
            tints: Vec::new(),
            solid: Vec::new(),
            filling: Vec::new(),
            innermost: Vec::new(),
            chunk: SpectrumColumns::new(CHUNK),
            chunk_tints: Column::new(CHUNK),
            weights: MixWeights::default(),
            columns: ChunkColumns::default(),
        }
    }
}
