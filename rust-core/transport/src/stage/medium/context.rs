//! What the stage of media reads.

use crate::state::sample::SampleContext;
use crate::tables::Tables;
use crate::tables::media::Coefficients;
use crate::tables::transport::Transport;
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Lanes, U};

/// What the stage reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MediumContext<'a> {
    pub(crate) tables: &'a Tables,
    pub(crate) transport: &'a Transport,
    pub(crate) sample: &'a SampleContext<'a>,
}

impl<'a> MediumContext<'a> {
    /// What media do to light of the paths of some slots.
    #[inline(always)]
    pub(super) fn media<L: Lanes>(&self, l: L, slot: U<L>) -> Coefficients<'a, L> {
        self.tables.materials.media.at(self.sample.wavelengths(l, slot))
    }

    /// A pair of random numbers of some paths for a use within this bounce.
    #[inline(always)]
    pub(super) fn pair<L: Lanes>(&self, l: L, slot: U<L>, within: u32) -> [F<L>; 2] {
        let first = dimension::MEDIA + self.sample.depth * dimension::MEDIUM;
        self.sample.sampler.pair(l, self.sample.index(l, slot), first + within)
    }
}
