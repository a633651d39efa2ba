//! Spectra of lamps.

use super::error::{Error, Result};
use gonio_spectrum::{NAMES, Spectrum, named, read};
use serde::{Deserialize, Serialize};
use std::path::Path;

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
    /// The spectrum of a name as `gonio_spectrum::NAMES` lists them, or `None` where it is none.
    ///
    /// # Errors
    /// A temperature that no such lamp has.
    pub fn named(name: &str) -> Result<Option<Self>> {
        named(name).transpose().map(|found| found.map(Self::from)).map_err(|error| Error::setting(name, error.problem))
    }

    /// What the bytes of a file hold, text of nm and power or IES TM-27.
    ///
    /// # Errors
    /// What is no spectrum, with its line.
    pub fn read(bytes: &[u8], path: &Path) -> Result<Self> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        read(bytes, &name).map(Self::from).map_err(|error| Error::in_file(path, &error))
    }

    /// What names are understood, for messages.
    pub fn names() -> &'static str {
        NAMES
    }
}

impl From<Spectrum> for LampSpectrum {
    fn from(found: Spectrum) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, power: found.power }
    }
}
