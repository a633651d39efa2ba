//! Spectra of sun and sky by their colours, for light that has wavelengths.
//!
//! Skies of Perez and of the CIE have the CIE's daylight of each direction's colour; Hošek and Wilkie's has what is nearest to their own spectra.

mod hosek_wilkie;
mod matrix;
mod sun;

pub use hosek_wilkie::HosekWilkieBands;

use super::{HosekWilkie, Sky, distribution::Distribution};
use crate::scene::ColourSpectra;

impl Sky {
    /// The spectra of the sky's red, green and blue; none of a white sky, nor of a dark one.
    pub fn sky_spectra(&self) -> Option<ColourSpectra> {
        let air = self.air?;
        let bands = || HosekWilkieBands::new(self.sun.elevation_deg.min(90.0), air.turbidity, self.ground).ok();
        let nearest = |model: &HosekWilkie| bands()?.nearest(model, self.sun.elevation_deg);
        let own = if let Distribution::HosekWilkie(model) = &self.distribution { nearest(model) } else { None };
        Some(own.unwrap_or_else(|| ColourSpectra::daylight().clone()))
    }

    /// The spectra of the red, green and blue of the sun's disc; none of a white one.
    pub fn sun_spectra(&self) -> Option<ColourSpectra> {
        self.air.map(|air| sun::behind(air, self.sun_colour))
    }
}
