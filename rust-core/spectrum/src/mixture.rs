//! Light of several sources, each changed on its way by a factor that is smooth over the wavelengths, as walls, air and glass change it.
//!
//! The factors are known in bands; sources keep their lines, however narrow.

use crate::{bands::Bands, integral::Integral, observer::EFFICACY, source::Spectrum, white};

/// Sources at the points of all of them together.
#[derive(Debug)]
pub struct Mixture {
    wavelengths_nm: Vec<f64>,
    /// By source, W/nm for each lm at each of these.
    sources: Vec<Vec<f64>>,
    /// For each of these the band whose middle is below, and how far it is to the next one's.
    places: Vec<(usize, f64)>,
}

impl Mixture {
    /// Sources whose factors will be known in bands.
    pub fn new(bands: &Bands, sources: &[Spectrum]) -> Self {
        let mut wavelengths_nm: Vec<f64> = sources.iter().flat_map(|source| source.wavelengths_nm.iter().copied()).collect();
        wavelengths_nm.sort_by(f64::total_cmp);
        wavelengths_nm.dedup();
        let last = bands.count() - 1;
        let place = |nm: &f64| {
            let place = ((nm - bands.centre(0)) / bands.width_nm()).clamp(0.0, last as f64);
            let below = (place as usize).min(last - 1);
            (below, place - below as f64)
        };
        Self {
            places: wavelengths_nm.iter().map(place).collect(),
            sources: sources.iter().map(|source| per_lumen(source, &wavelengths_nm)).collect(),
            wavelengths_nm,
        }
    }

    /// The wavelengths that it is known at, nm.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// W/nm at each wavelength (of factors in lx W/(m² nm)), by source its lm in each band.
    pub fn power(&self, factors: &[Vec<f64>]) -> Vec<f64> {
        let at = |number: usize| {
            let (below, part) = self.places[number];
            let factor = |of: &Vec<f64>| of[below] + part * (of[below + 1] - of[below]);
            self.sources.iter().zip(factors).map(|(source, of)| source[number] * factor(of)).sum()
        };
        (0..self.wavelengths_nm.len()).map(at).collect()
    }

    /// The spectrum of these powers; none where nobody sees it. Power below zero, which takes light away, counts as none.
    pub fn spectrum(&self, power: &[f64]) -> Option<Spectrum> {
        let spectrum = Spectrum {
            name: String::new(),
            wavelengths_nm: self.wavelengths_nm.clone(),
            power: power.iter().map(|power| power.max(0.0)).collect(),
            notes: Vec::new(),
        };
        (spectrum.luminous() > 0.0).then_some(spectrum)
    }
}

/// A spectrum's W/nm for each lm within 380 to 780 nm at some wavelengths.
fn per_lumen(spectrum: &Spectrum, wavelengths_nm: &[f64]) -> Vec<f64> {
    let light = Integral::new(&spectrum.wavelengths_nm, |nm| [spectrum.at(nm) * white::observer(nm)[1]]);
    let lumens = EFFICACY * light.all()[0];
    // The ends belong to the spectrum here.
    let ends = [0, spectrum.wavelengths_nm.len() - 1];
    let end = |nm: f64| ends.into_iter().find(|end| spectrum.wavelengths_nm[*end] == nm);
    let at = |nm: f64| end(nm).map_or_else(|| spectrum.at(nm), |end| spectrum.power[end]);
    wavelengths_nm.iter().map(|nm| if lumens > 0.0 { at(*nm) / lumens } else { 0.0 }).collect()
}
