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

impl From<Spectrum> for LampSpectrum {
    fn from(found: Spectrum) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, power: found.power }
    }
}
