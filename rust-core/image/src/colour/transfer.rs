//! Transfer functions: from stored numbers to amounts of light, and back.

use gonio_simd::{F, Lanes};

/// How stored numbers relate to linear ones. Each is extended to negative numbers as an odd function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Transfer {
    /// As they stand.
    Linear,
    /// IEC 61966-2-1: linear near black, an exponent of 2.4 above.
    Srgb,
    /// An exponent of 1.8.
    Gamma18,
    /// An exponent of 2.2.
    Gamma22,
    /// An exponent of 2.4, the display of Rec.709 (ITU-R BT.1886 with a black of zero).
    Gamma24,
    /// An exponent of 563/256, Adobe RGB (1998).
    AdobeRgb,
}

impl Transfer {
    /// Stored to linear, exact to `f64`.
    pub fn decode(self, stored: f64) -> f64 {
        let x = stored.abs();
        let linear = match self {
            Self::Linear => x,
            Self::Srgb if x <= 0.04045 => x / 12.92,
            Self::Srgb => ((x + 0.055) / 1.055).powf(2.4),
            other => x.powf(other.exponent()),
        };
        linear.copysign(stored)
    }

    /// Linear to stored, exact to `f64`.
    pub fn encode(self, linear: f64) -> f64 {
        let x = linear.abs();
        let stored = match self {
            Self::Linear => x,
            Self::Srgb if x <= 0.003_130_8 => x * 12.92,
            Self::Srgb => 1.055 * x.powf(1.0 / 2.4) - 0.055,
            other => x.powf(1.0 / other.exponent()),
        };
        stored.copysign(linear)
    }

    fn exponent(self) -> f64 {
        match self {
            Self::Linear => 1.0,
            Self::Gamma18 => 1.8,
            Self::Gamma22 => 2.2,
            Self::Srgb | Self::Gamma24 => 2.4,
            Self::AdobeRgb => 563.0 / 256.0,
        }
    }

    /// Linear values of the 256 codes of 8-bit images.
    pub fn table(self) -> [f32; 256] {
        let mut table = [0.0; 256];
        for (code, value) in table.iter_mut().enumerate() {
            *value = self.decode(code as f64 / 255.0) as f32;
        }
        table
    }
}

/// sRGB to linear on lanes; negative values by odd symmetry.
#[inline(always)]
pub fn srgb_to_linear<L: Lanes>(stored: F<L>) -> F<L> {
    let x = stored.abs();
    let curve = ((x + 0.055) * (1.0 / 1.055)).pow(2.4);
    x.le(0.04045).select(x * (1.0 / 12.92), curve).copysign(stored)
}

/// Linear to sRGB on lanes; negative values by odd symmetry.
#[inline(always)]
pub fn linear_to_srgb<L: Lanes>(linear: F<L>) -> F<L> {
    let x = linear.abs();
    let curve = x.pow(1.0 / 2.4).mul_add(1.055, -0.055);
    x.le(0.003_130_8).select(x * 12.92, curve).copysign(linear)
}
