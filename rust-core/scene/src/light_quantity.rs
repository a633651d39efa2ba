//! How strong a light is, in the unit that its user thinks in.

use serde::{Deserialize, Serialize};

/// Luminous efficacy in lm/W that turns radiant watts into lumens: one constant everywhere, the one that Cycles reads IES files by.
pub const LUMENS_PER_WATT: f64 = 177.83;

/// A light's strength as a whole: with it the emission's radiance tells the colour alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum LightQuantity {
    /// Luminous flux in lm.
    Lumens(f64),
    /// Flux in lm of the lamps in the luminaire: what the goniogram states for its lamps is exchanged for it.
    LampLumens(f64),
    /// The greatest luminous intensity in cd.
    Candela(f64),
    /// Illuminance in lx on a facing surface where the light is strongest, by the inverse square law from its centre; of lights at infinity
    /// wherever they shine, and of domes, as if even, on a surface that sees half of them.
    Lux {
        /// In lx.
        illuminance: f64,
        /// In metres; lights at infinity have no use for it.
        distance: f64,
    },
    /// The greatest luminance in cd/m².
    Nits(f64),
    /// Radiant flux in W, times the light's [`lumens_per_watt`](super::lumens_per_watt).
    Watts(f64),
    /// The goniogram's factors are intensities in cd.
    Measured,
}
