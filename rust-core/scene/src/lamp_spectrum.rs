//! Spectra of lamps.

use gonio_spectrum::Spectrum;
use serde::{Deserialize, Serialize};

/// Power over wavelength.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LampSpectrum {
    /// What it is called; empty where nothing says.
    #[serde(default)]
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Power per nanometre at each of them, in any unit.
    pub power: Vec<f64>,
}

impl LampSpectrum {
    /// Lumens of a watt of it (luminous efficacy of radiation); none where it is no spectrum.
    pub fn lumens_per_watt(&self) -> Option<f64> {
        Some(Spectrum::new(&self.name, &self.wavelengths_nm, &self.power).ok()?.luminous_efficacy())
    }
}

impl From<Spectrum> for LampSpectrum {
    fn from(found: Spectrum) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, power: found.power }
    }
}
