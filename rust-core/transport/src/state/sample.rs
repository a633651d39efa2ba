//! The sample context: sampler, slot runs and depth. With a slot they determine every random number.

use crate::state::wavelengths::{SlotWavelengths, at_slots};
use gonio_camera::sampler::{Runs, Sampler, dimension};
use gonio_nodes::hash::hash2;
use gonio_simd::{Lanes, Rgb, Spectrum, U, Wavelengths};

/// Which samples are under way, and how deep their paths are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleContext<'a> {
    pub(crate) sampler: Sampler,
    pub(crate) runs: &'a Runs,
    pub(crate) depth: u32,
    /// Wavelengths of the slots' paths, where light has any.
    pub(crate) wavelengths: Option<&'a SlotWavelengths>,
}

impl<'a> SampleContext<'a> {
    /// The wavelengths of the paths of some slots.
    #[inline(always)]
    pub(crate) fn wavelengths<L: Lanes>(&self, l: L, slot: U<L>) -> Wavelengths<'a, L> {
        at_slots(l, self.wavelengths, slot)
    }

    /// Door for light: light of some slots' paths as colour of the film.
    #[inline(always)]
    pub(crate) fn to_film<L: Lanes>(self, slot: U<L>, light: Spectrum<L>) -> Rgb<L> {
        self.wavelengths(slot.lanes(), slot).to_rgb(light)
    }

    /// The same of several.
    #[inline(always)]
    pub(crate) fn all_to_film<L: Lanes, const N: usize>(self, slot: U<L>, light: [Spectrum<L>; N]) -> [Rgb<L>; N] {
        let wavelengths = self.wavelengths(slot.lanes(), slot);
        let mut colours = [Rgb::zero(slot.lanes()); N];
        for (colour, light) in colours.iter_mut().zip(light) {
            *colour = wavelengths.to_rgb(light);
        }
        colours
    }

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
