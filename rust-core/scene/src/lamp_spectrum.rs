//! Spectra of lamps.

use super::LUMENS_PER_WATT;
use gonio_formats::spectrum::SpectralPower;
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

/// Lumens of a watt of what something shines with: its spectrum's luminous efficacy of radiation, or [`LUMENS_PER_WATT`] where it has none that can be used.
pub fn lumens_per_watt(of: Option<&LampSpectrum>) -> f64 {
    let found = of.and_then(|of| Spectrum::new(&of.name, &of.wavelengths_nm, &of.power).ok());
    found.map_or(LUMENS_PER_WATT, |spectrum| spectrum.luminous_efficacy())
}

impl From<Spectrum> for LampSpectrum {
    fn from(found: Spectrum) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, power: found.power }
    }
}

impl From<SpectralPower> for LampSpectrum {
    fn from(found: SpectralPower) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, power: found.power }
    }
}
