//! The spectrum that a meter gets, and what it says.

use crate::{measure::Reading, scene::Measurand};
use gonio_spectrum::{Figures, Mixture, figures, spectrum_drawing};
use std::sync::Arc;

/// What a plane gets by wavelength.
#[derive(Clone, Debug)]
pub struct ColourReading {
    mixture: Arc<Mixture>,
    /// Spectral irradiance at each of [`ColourReading::wavelengths_nm`], W/(m² nm).
    pub spectrum: Vec<Reading>,
    /// By that, lx.
    pub illuminance: Reading,
    /// What the spectrum says; none where there is no light.
    pub figures: Option<Figures>,
    /// The same of all rounds but one, for each.
    without: Vec<Figures>,
}

impl ColourReading {
    /// Of independent rounds, each by source its lx in each band.
    pub(crate) fn of_rounds(mixture: &Arc<Mixture>, rounds: &[Vec<Vec<f64>>]) -> Self {
        let powers: Vec<Vec<f64>> = rounds.iter().map(|factors| mixture.power(factors)).collect();
        let at = |number: usize| Reading::of_parts(powers.iter().map(|round| round[number]));
        let spectrum: Vec<Reading> = (0..mixture.wavelengths_nm().len()).map(at).collect();
        let is_known = |power: &[f64]| power.iter().all(|power| !power.is_nan());
        let lux = |power: &[f64]| mixture.spectrum(power).map_or(0.0, |spectrum| spectrum.luminous());
        let luminous = |power: &[f64]| if is_known(power) { lux(power) } else { f64::NAN };
        let whole: Vec<f64> = spectrum.iter().map(|reading| reading.value).collect();
        let all_but = |round: &Vec<f64>| -> Vec<f64> {
            let count = powers.len() as f64;
            whole.iter().zip(round).map(|(mean, own)| (count * mean - own) / (count - 1.0)).collect()
        };
        let said = |power: &[f64]| mixture.spectrum(power).filter(|_| is_known(power)).map(|spectrum| figures(&spectrum));
        Self {
            illuminance: Reading::of_parts(powers.iter().map(|round| luminous(round))),
            figures: said(&whole),
            without: powers.iter().filter_map(|round| said(&all_but(round))).collect(),
            spectrum,
            mixture: mixture.clone(),
        }
    }

    /// The same where colours stand for spectra of lamps: without the figures that these alone tell.
    pub(super) fn of_colours(mut self) -> Self {
        self.figures = self.figures.map(Figures::of_colour);
        self.without = self.without.into_iter().map(Figures::of_colour).collect();
        self
    }

    /// The wavelengths of the spectrum, nm: the points of the sources' spectra.
    pub fn wavelengths_nm(&self) -> &[f64] {
        self.mixture.wavelengths_nm()
    }

    /// A figure with its standard error by the jackknife, which holds by how much noise shifts it; none where it is undefined.
    pub fn figure(&self, of: impl Fn(&Figures) -> Option<f64>) -> Option<Reading> {
        let value = of(self.figures.as_ref()?)?;
        let parts: Vec<f64> = self.without.iter().filter_map(of).collect();
        let count = parts.len() as f64;
        let mean = parts.iter().sum::<f64>() / count;
        let spread: f64 = parts.iter().map(|part| (part - mean).powi(2)).sum::<f64>() * (count - 1.0) / count;
        let shift = (count - 1.0) * (mean - value);
        Some(Reading { value, standard_error: spread.sqrt().hypot(shift) })
    }

    /// The figure of a measurand; none of others than those of colour, and where it is undefined.
    pub fn of(&self, measurand: Measurand) -> Option<Reading> {
        self.figure(|figures| {
            let white = figures.white.as_ref()?;
            let rendition = white.rendition.as_ref();
            match measurand {
                Measurand::Cct => Some(white.cct),
                Measurand::Duv => Some(white.duv),
                Measurand::Ra => white.rendering.as_ref().map(|rendering| rendering.ra),
                Measurand::Rf => rendition.map(|rendition| rendition.rf),
                Measurand::Rg => rendition.map(|rendition| rendition.rg),
                _ => None,
            }
        })
    }

    /// Whether there is room to count the light that no path from the meter finds.
    pub(in super::super) fn is_known(&self) -> bool {
        self.illuminance.is_known()
    }

    /// Why a figure of light that is known is undefined, in words.
    pub(in super::super) fn why_undefined(&self) -> String {
        let found = self.figures.as_ref().map(|figures| figures.notes.join("; "));
        found.filter(|notes| !notes.is_empty()).unwrap_or_else(|| "no light comes there".to_owned())
    }

    /// Melanopic equivalent daylight illuminance on the plane, lx (CIE S 026).
    pub fn melanopic_edi(&self) -> Option<Reading> {
        self.melanopic_of(&self.illuminance)
    }

    /// The same of so many lx of light of this spectrum, which were measured apart.
    pub(crate) fn melanopic_of(&self, light: &Reading) -> Option<Reading> {
        let ratio = self.figure(Figures::melanopic_der)?;
        let [of_light, of_ratio] = [ratio.value * light.standard_error, light.value * ratio.standard_error];
        Some(Reading { value: ratio.value * light.value, standard_error: of_light.hypot(of_ratio) })
    }

    /// The spectrum beside TM-30's colour vector graphic (SVG), under a name; none where there is no light, or it is not known.
    pub fn drawing(&self, name: &str) -> Option<String> {
        let figures = self.figures.as_ref().filter(|figures| figures.alpha_opic.is_some())?;
        let power: Vec<f64> = self.spectrum.iter().map(|reading| reading.value).collect();
        let mut spectrum = self.mixture.spectrum(&power)?;
        name.clone_into(&mut spectrum.name);
        Some(spectrum_drawing(&spectrum, figures))
    }

    /// The figures in a line of words.
    pub fn note(&self) -> String {
        if !self.is_known() {
            return "its light is not known".to_owned();
        }
        let figure = |measurand: Measurand, name: &str, places: usize| {
            self.of(measurand).map(|Reading { value, standard_error }| format!("{name} {value:.places$} ± {standard_error:.places$}"))
        };
        let figures = [
            figure(Measurand::Cct, "CCT", 0).map(|cct| cct + " K"),
            figure(Measurand::Duv, "Duv", 4),
            figure(Measurand::Ra, "Ra", 1),
            figure(Measurand::Rf, "Rf", 1),
            figure(Measurand::Rg, "Rg", 1),
        ];
        let Reading { value, standard_error } = self.illuminance;
        let light = format!("{value:.2} ± {standard_error:.2} lx");
        let figures: Vec<String> = std::iter::once(light).chain(figures.into_iter().flatten()).collect();
        figures.join(", ")
    }
}

impl PartialEq for ColourReading {
    fn eq(&self, other: &Self) -> bool {
        self.spectrum == other.spectrum && self.figures == other.figures
    }
}
