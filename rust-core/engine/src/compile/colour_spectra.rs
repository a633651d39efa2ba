//! Spectra of lights by their colours, of sun and sky: what kernels read of them.

use crate::{
    error::Diagnostic,
    scene::{ColourSpectra, Light},
};
use gonio_simd::FIRST_COLOUR_SPECTRA;
use gonio_spectrum::{Bands, triples};
use std::sync::Arc;

/// The spectra of red, green and blue that lights of a scene have, each set once.
#[derive(Clone, Debug, Default)]
pub(super) struct SetsOfSpectra(Vec<Arc<ColourSpectra>>);

impl SetsOfSpectra {
    /// The number that kernels have of a light's set; 0 where it has none that can be used, which is told.
    pub(super) fn number(&mut self, light: &Light, diagnostics: &mut Vec<Diagnostic>) -> u32 {
        let Some(set) = &light.colour_spectra else { return 0 };
        if let Err(error) = set.check() {
            let problem = format!("the spectra of its colour cannot be used, it counts as daylight D65 of its colour: {error}");
            diagnostics.push(Diagnostic::warning(&light.origin, problem));
            return 0;
        }
        let known = self.0.iter().position(|known| Arc::ptr_eq(known, set) || known == set);
        let place = known.unwrap_or_else(|| {
            self.0.push(set.clone());
            self.0.len() - 1
        });
        FIRST_COLOUR_SPECTRA + place as u32
    }

    /// The place among them that a number means.
    pub(super) fn place(number: u32) -> Option<usize> {
        number.checked_sub(FIRST_COLOUR_SPECTRA).map(|place| place as usize)
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A column of kernels: for each rotation of each set the three wavelengths of red, green and blue.
    pub(super) fn by_rotation(&self) -> Vec<f32> {
        let of_set = |set: &Arc<ColourSpectra>| -> Vec<f32> {
            let parts = [0, 1, 2].map(|part| triples().filter(|nm| set.at(nm)[part]));
            (0..parts[0].len())
                .flat_map(|rotation| parts.each_ref().map(|part| part[rotation]))
                .flat_map(|[r, g, b]| [r, g, b, 0.0])
                .collect()
        };
        self.0.iter().flat_map(of_set).collect()
    }

    /// By set and band, red, green and blue relative to daylight D65.
    pub(super) fn by_band(&self, bands: &Bands) -> Vec<Vec<[f32; 3]>> {
        self.0.iter().map(|set| bands.filter(|nm| set.at(nm))).collect()
    }
}

/// A column of kernels in a band, of so many wavelengths: all three components are the same there.
pub(super) fn column_of_band(by_band: &[Vec<[f32; 3]>], band: usize, count: usize) -> Vec<f32> {
    let quads = |set: &Vec<[f32; 3]>| set[band].map(|value| [value, value, value, 0.0]).as_flattened().repeat(count);
    by_band.iter().flat_map(quads).collect()
}
