//! Weights of the closures of a mix at a chunk of hits.

use crate::graph::{CHUNK, OutputColumns};
use crate::tables::material::Mix;
use gonio_simd::{Lanes, Rgb, Spectrum};

/// Those of all closures, three channels each: kept while the closures' own programs run.
#[derive(Debug, Default)]
pub(crate) struct MixWeights(Vec<f32>);

impl MixWeights {
    /// Keeps what the program of a mix computed.
    pub(crate) fn keep(&mut self, mix: &Mix, outputs: &OutputColumns) {
        self.0.clear();
        (0..mix.count * 3).for_each(|column| self.0.extend_from_slice(outputs.column(column)));
    }
    /// Those of one closure.
    #[inline(always)]
    pub(crate) fn of(&self, closure: usize) -> ClosureWeights<'_> {
        ClosureWeights([0, 1, 2].map(|c| &self.0[(closure * 3 + c) * CHUNK..][..CHUNK]))
    }
}

/// Those of one closure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosureWeights<'a>([&'a [f32]; 3]);

impl<'a> ClosureWeights<'a> {
    /// As the program of the mix has just computed them.
    #[inline(always)]
    pub(crate) fn computed(outputs: &'a OutputColumns, closure: usize) -> Self {
        Self([0, 1, 2].map(|c| outputs.column(closure * 3 + c)))
    }
    /// At a register of hits; none is negative.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(self, l: L, at: usize) -> Spectrum<L> {
        Spectrum::reflectance(Rgb::load(l, self.0, at)).max(0.0)
    }
}
