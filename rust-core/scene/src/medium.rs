//! Participating media: what fills closed meshes, or all of space.

use super::FieldId;
use serde::{Deserialize, Serialize};

/// A medium, even or by a field. Coefficients are a metre, R, G, B, 0 or more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Medium {
    /// Absorption.
    pub absorption: [f32; 3],
    /// Scattering.
    pub scattering: [f32; 3],
    /// Radiance that a metre of it sends.
    pub emission: [f32; 3],
    /// Mean cosine g of the angle by which it scatters (Henyey and Greenstein): above 0 forwards, below 0 back.
    pub anisotropy: f32,
    /// What its coefficients are multiplied by from place to place; `None` where it is even.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<FieldId>,
}

/// The contrast that a black thing before the sky keeps at the visibility: the meteorological optical range of CIE and WMO.
pub const VISIBILITY_CONTRAST: f64 = 0.05;
/// How haze scatters where nobody says: droplets and dust, forwards.
pub const HAZE_ANISOTROPY: f32 = 0.8;

impl Medium {
    /// Haze or fog of an extinction a metre, of which a part, R, G, B, is scattered.
    pub fn haze(extinction: f64, albedo: [f32; 3], anisotropy: f32) -> Self {
        let scattering = albedo.map(|part| (extinction * f64::from(part)) as f32);
        let absorption = albedo.map(|part| (extinction * (1.0 - f64::from(part))) as f32);
        Self { absorption, scattering, emission: [0.0; 3], anisotropy, field: None }
    }
    /// The extinction a metre at which contrast falls to a part after so many metres (Koschmieder).
    pub fn extinction_of(visibility: f64, contrast: f64) -> f64 {
        -contrast.ln() / visibility
    }
    /// Whether light goes through as if nothing were there.
    pub fn is_clear(&self) -> bool {
        [self.absorption, self.scattering, self.emission].iter().flatten().all(|x| *x == 0.0)
    }
}
