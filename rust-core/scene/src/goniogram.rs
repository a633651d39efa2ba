//! How a light's emission depends on direction, as measured.

use super::lamp_spectrum::LampSpectrum;
use gonio_formats::photometry::{self, Opening, PhotometricType};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Factors on a light's emission on a grid of two angles, linear in both between its lines and zero beyond its ends. A point light of 1 cd whose
/// factors are candela has the intensities themselves.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Goniogram {
    /// What the angles are. The luminaire's nadir is the light's −z, its C0 the light's +x.
    pub photometric_type: PhotometricType,
    /// Strictly increasing; type C: from 0 to 360, both included.
    pub horizontal_deg: Vec<f32>,
    /// Strictly increasing.
    pub vertical_deg: Vec<f32>,
    /// Not negative: `factors[h * vertical_deg.len() + v]`.
    pub factors: Vec<f32>,
    /// Flux in lm of the lamps that the factors are for, where it is known.
    #[serde(default)]
    pub lamp_flux: Option<f64>,
    /// Electrical power in W at these factors, where it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub watts: Option<f64>,
    /// The luminaire's opening, in metres; a light has it if its shape is one.
    #[serde(default)]
    pub opening: Opening,
    /// The spectrum of the luminaire's light, where its file has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Arc<LampSpectrum>>,
}

impl From<&photometry::Goniogram> for Goniogram {
    /// A file's goniogram with all its planes; the factors are candela.
    fn from(found: &photometry::Goniogram) -> Self {
        let photometry::Grid { horizontal, vertical, intensities } = found.expanded();
        let narrow = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
        Self {
            photometric_type: found.photometric_type,
            horizontal_deg: narrow(horizontal),
            vertical_deg: narrow(vertical),
            factors: narrow(intensities),
            lamp_flux: found.lamps().and_then(|lamps| lamps.flux),
            watts: found.lamps().map(|lamps| lamps.watts).filter(|watts| *watts > 0.0),
            opening: found.opening,
            spectrum: found.spectrum.clone().map(|spectrum| Arc::new(spectrum.into())),
        }
    }
}
