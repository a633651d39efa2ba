//! What tracing shadow rays needs beside their queue.

use crate::graph::CHUNK;
use crate::state::queue::shadow_order::ShadowOrder;
use gonio_accel::TransparentHit;
use gonio_simd::SpectrumColumns;

/// Scratch of the shadow stage.
#[derive(Debug)]
pub(crate) struct ShadowTrace {
    pub(crate) order: ShadowOrder,
    /// By shadow ray, 1 where something opaque blocks it.
    pub(crate) blocked: Vec<u8>,
    /// Hits on the transparent surfaces that rays pass.
    pub(crate) passed: Vec<TransparentHit>,
    /// Weights of a mix over a chunk of such hits, three channels a closure.
    pub(crate) weights: Vec<f32>,
    /// What a chunk of such hits lets pass.
    pub(crate) factors: SpectrumColumns,
}

impl Default for ShadowTrace {
    fn default() -> Self {
        Self {
            order: ShadowOrder::default(),
            blocked: Vec::new(),
            passed: Vec::new(),
            weights: Vec::new(),
            factors: SpectrumColumns::new(CHUNK),
        }
    }
}
