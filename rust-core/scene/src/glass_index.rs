//! Glasses and liquids by their index of refraction.

use gonio_spectrum::GlassIndex as Found;
use serde::{Deserialize, Serialize};

/// The index of refraction of a dielectric over wavelength.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GlassIndex {
    /// What it is called; empty where nothing says.
    #[serde(default)]
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Refractive index at each of them.
    pub n: Vec<f64>,
}

impl From<Found> for GlassIndex {
    fn from(found: Found) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, n: found.n }
    }
}
