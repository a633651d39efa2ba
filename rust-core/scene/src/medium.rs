//! Participating media: what fills closed meshes, or all of space.

use super::FieldId;
use serde::{Deserialize, Serialize};

/// The phase function of a medium: what floats in it, by the angle at which it scatters. What is beyond a range is held there, and told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Phase {
    /// Henyey and Greenstein's function of the medium's mean cosine.
    #[default]
    HenyeyGreenstein,
    /// Rayleigh's: what is far smaller than the wavelength.
    Rayleigh,
    /// Draine's function of the medium's g, which is near its mean cosine: dust.
    Draine {
        /// 0 is Henyey and Greenstein's function, 1 Cornette and Shanks'; from 0 to 1000.
        alpha: f32,
    },
    /// Fournier and Forand's: particles in water.
    FournierForand {
        /// Refractive index within the water, from 1.001 to 3.
        ior: f32,
        /// The part that goes back, from 0.005 to 0.499.
        backscatter: f32,
    },
    /// Droplets of water in air, fog and clouds: Jendersie and d'Eon's fit of Mie's theory.
    Mie {
        /// Micrometres, from 0 to 50.
        diameter: f32,
    },
}

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
    /// Mean cosine g of the angle by which it scatters (Henyey and Greenstein, Draine): above 0 forwards, below 0 back.
    pub anisotropy: f32,
    /// Its phase function.
    #[serde(skip_serializing_if = "Phase::is_default")]
    pub phase: Phase,
    /// What its coefficients are multiplied by from place to place; `None` where it is even.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<FieldId>,
}

/// The contrast that a black thing before the sky keeps at the visibility: the meteorological optical range of CIE and WMO.
pub const VISIBILITY_CONTRAST: f64 = 0.05;
/// How haze scatters where nobody says: droplets and dust, forwards.
pub const HAZE_ANISOTROPY: f32 = 0.8;

impl Phase {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

impl Medium {
    /// Haze or fog of an extinction a metre, of which a part, R, G, B, is scattered.
    pub fn haze(extinction: f64, albedo: [f32; 3], anisotropy: f32) -> Self {
        let scattering = albedo.map(|part| (extinction * f64::from(part)) as f32);
        let absorption = albedo.map(|part| (extinction * (1.0 - f64::from(part))) as f32);
        Self { absorption, scattering, emission: [0.0; 3], anisotropy, ..Self::default() }
    }
    /// The extinction a metre at which contrast falls to a part after so many metres (Koschmieder).
    pub fn extinction_of(visibility: f64, contrast: f64) -> f64 {
        -contrast.ln() / visibility
    }
    /// Whether nothing is left of light that comes from infinitely far. Fields end somewhere.
    pub fn ends_light(&self) -> bool {
        self.field.is_none() && self.absorption.iter().zip(&self.scattering).all(|(absorption, scattering)| absorption + scattering > 0.0)
    }
    /// Whether light goes through as if nothing were there.
    pub fn is_clear(&self) -> bool {
        [self.absorption, self.scattering, self.emission].iter().flatten().all(|x| *x == 0.0)
    }
}
