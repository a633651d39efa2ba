//! The sample context: sampler, slot runs and depth. With a slot they determine every random number.

use gonio_camera::sampler::{Runs, Sampler, dimension};
use gonio_nodes::hash::hash2;
use gonio_simd::{Lanes, U};

/// Which samples are under way, and how deep their paths are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleContext<'a> {
    pub(crate) sampler: Sampler,
    pub(crate) runs: &'a Runs,
    pub(crate) depth: u32,
}

impl SampleContext<'_> {
    /// The sampler's dimension of a use within this bounce.
    #[inline(always)]
    pub(crate) fn dimension(&self, within: u32) -> u32 {
        dimension::FIRST_BOUNCE + self.depth * dimension::BOUNCE + within
    }

    /// The index in the sampler's sequence for the path of a slot (pbrt's sample index).
    #[inline(always)]
    pub(crate) fn index<L: Lanes>(&self, l: L, slot: U<L>) -> U<L> {
        self.runs.index(l, &self.sampler, slot)
    }

    /// A number that tells the samples and bounces of all slots apart, for random numbers beyond the sampler's.
    #[inline(always)]
    pub(crate) fn salt<L: Lanes>(&self, l: L, slot: U<L>) -> U<L> {
        hash2(l, self.index(l, slot), l.u(self.depth))
    }
}
