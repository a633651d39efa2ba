//! Participating media: what fills closed meshes, or all of space.

use serde::{Deserialize, Serialize};

/// An even medium. Coefficients are a metre, R, G, B, 0 or more.
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
}

impl Medium {
    /// Whether light goes through as if nothing were there.
    pub fn is_clear(&self) -> bool {
        [self.absorption, self.scattering, self.emission].iter().flatten().all(|x| *x == 0.0)
    }
}
