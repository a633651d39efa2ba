//! A light of an emitter.

use super::Texts;
use crate::error::FormatError;

/// A photometry with its light source.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The light's name, or its source's, or its channel's.
    pub name: Texts,
    /// The file of its photometry by its place in [`Gldf::files`](super::Gldf::files), or why there is none.
    pub photometry: Result<usize, FormatError>,
    /// Its flux, where the product states one.
    pub rated: Option<RatedFlux>,
    /// Power in W.
    pub watts: Option<f64>,
    /// Correlated colour temperature in K.
    pub temperature: Option<f64>,
    /// Colour rendering index.
    pub rendering: Option<f64>,
    /// The spectrum's place in [`Gldf::spectra`](super::Gldf::spectra).
    pub spectrum: Option<usize>,
    /// When it shines.
    pub emergency: Emergency,
    /// Its flux in emergencies over its flux else.
    pub emergency_factor: Option<f64>,
    /// Its flux in emergencies in lm.
    pub emergency_flux: Option<f64>,
    /// Degrees by which it is turned about X, Y, Z and G0.
    pub rotation: [f64; 4],
}

/// A flux that a product states, in lm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RatedFlux {
    /// Of the light as it leaves the luminaire.
    Luminaire(f64),
    /// Of the lamps in it.
    Lamps(f64),
}

/// When a light shines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Emergency {
    /// Never in emergencies.
    #[default]
    None,
    /// Always.
    Combined,
    /// In emergencies alone.
    Only,
}

impl Light {
    /// Whether it shines while there is no emergency.
    pub fn is_normal(&self) -> bool {
        self.emergency != Emergency::Only
    }

    /// Its flux in lm in an emergency, of a light that has `flux` lm else; `None` for one that then is dark.
    pub fn flux_in_emergency(&self, flux: f64) -> Option<f64> {
        if self.emergency == Emergency::None {
            return None;
        }
        Some(self.emergency_flux.unwrap_or_else(|| flux * self.emergency_factor.unwrap_or(1.0)))
    }
}
