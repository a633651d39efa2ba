//! Weights of the closures of a mix at a chunk of hits.

use crate::graph::CHUNK;
use crate::state::chunk::ChunkColumns;
use crate::state::wavelengths::ChunkWavelengths;
use crate::tables::material::Mix;
use gonio_simd::{Lanes, Rgb, Spectrum, WavelengthColumn};

/// Those of all closures, three channels each: kept while the closures' own programs run.
#[derive(Debug, Default)]
pub(crate) struct MixWeights {
    values: Vec<f32>,
    wavelengths: ChunkWavelengths,
}

impl MixWeights {
    /// Keeps what the program of a mix computed.
    pub(crate) fn keep(&mut self, mix: &Mix, columns: &ChunkColumns) {
        self.values.clear();
        (0..mix.count * 3).for_each(|column| self.values.extend_from_slice(columns.outputs.column(column)));
        self.wavelengths.clone_from(&columns.wavelengths);
    }
    /// Those of one closure.
    #[inline(always)]
    pub(crate) fn of(&self, closure: usize) -> ClosureWeights<'_> {
        let columns = [0, 1, 2].map(|c| &self.values[(closure * 3 + c) * CHUNK..][..CHUNK]);
        ClosureWeights { columns, wavelengths: self.wavelengths.column() }
    }
}

/// Those of one closure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosureWeights<'a> {
    columns: [&'a [f32]; 3],
    wavelengths: WavelengthColumn<'a>,
}

impl<'a> ClosureWeights<'a> {
    /// As the program of the mix has just computed them.
    #[inline(always)]
    pub(crate) fn computed(columns: &'a ChunkColumns, closure: usize) -> Self {
        let outputs = &columns.outputs;
        Self { columns: [0, 1, 2].map(|c| outputs.column(closure * 3 + c)), wavelengths: columns.wavelengths.column() }
    }
    /// At a register of hits; none is negative.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(self, l: L, at: usize) -> Spectrum<L> {
        self.wavelengths.load(l, at).reflectance(Rgb::load(l, self.columns, at)).max(0.0)
    }
}
