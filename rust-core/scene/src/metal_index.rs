//! Metals by their index of refraction.

use gonio_spectrum::MetalIndex as Found;
use serde::{Deserialize, Serialize};

/// The complex index of refraction n + i k of a metal over wavelength.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MetalIndex {
    /// What it is called; empty where nothing says.
    #[serde(default)]
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Refractive index at each of them.
    pub n: Vec<f64>,
    /// Extinction coefficient at each of them.
    pub k: Vec<f64>,
}

impl From<Found> for MetalIndex {
    fn from(found: Found) -> Self {
        Self { name: found.name, wavelengths_nm: found.wavelengths_nm, n: found.n, k: found.k }
    }
}
