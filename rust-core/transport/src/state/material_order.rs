//! Hits by material: which material each path met, and the paths in the order of their materials.

use crate::state::mix_weights::MixWeights;
use std::ops::Range;

/// The paths of a batch by the material that they met.
#[derive(Debug, Default)]
pub(crate) struct MaterialOrder {
    /// By path, the material number of its hit; padded to whole registers.
    pub(crate) material_of: Vec<u32>,
    /// Path numbers in the order of their surfaces, and where each surface's begin and end.
    pub(crate) order: Vec<u32>,
    pub(crate) starts: Vec<u32>,
    pub(crate) ends: Vec<u32>,
    /// Mixes and the paths at them.
    pub(crate) mixed: Vec<(u32, u32)>,
    /// Weights of a mix at a chunk of hits.
    pub(crate) weights: MixWeights,
}

impl MaterialOrder {
    /// Where the paths at a surface stand in the order.
    pub(crate) fn hits_of(&self, surface: usize) -> Range<usize> {
        self.starts[surface] as usize..self.ends[surface] as usize
    }
}
