//! What tracing shadow rays needs beside their queue.

use crate::state::queue::shadow_order::ShadowOrder;
use gonio_accel::TransparentHit;

/// Scratch of the shadow stage.
#[derive(Debug, Default)]
pub(crate) struct ShadowTrace {
    pub(crate) order: ShadowOrder,
    /// By shadow ray, 1 where something opaque blocks it.
    pub(crate) blocked: Vec<u8>,
    /// Hits on the transparent surfaces that rays pass.
    pub(crate) passed: Vec<TransparentHit>,
    /// Weights of a mix over a chunk of such hits, three channels a closure.
    pub(crate) weights: Vec<f32>,
}
