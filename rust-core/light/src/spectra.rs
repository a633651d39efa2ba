//! Doors for light: what lamps send, by their spectra where they have any.

use super::table::LightTable;
use gonio_simd::{Lanes, Rgb, Spectrum, U, Wavelengths};

impl LightTable {
    /// Gives lights spectra, one number a light, counted from 1; 0 is none. From [`gonio_simd::FIRST_COLOUR_SPECTRA`] on they are spectra of colours. None
    /// at all where no light has one.
    pub fn set_spectra(&mut self, numbers: Vec<u32>) {
        debug_assert!(numbers.is_empty() || numbers.len() == self.count);
        self.spectra = numbers;
    }
    /// What lights send whose colour towards a point is given.
    #[inline(always)]
    pub fn light<L: Lanes>(&self, wavelengths: Wavelengths<'_, L>, light: U<L>, colour: Rgb<L>) -> Spectrum<L> {
        if self.spectra.is_empty() {
            return wavelengths.radiance(colour);
        }
        wavelengths.lamp(light.lanes().gather_integers(&self.spectra, light), colour)
    }
}
