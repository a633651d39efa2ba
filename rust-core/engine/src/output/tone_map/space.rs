//! What display values mean.

use crate::error::{Error, Result};

/// Primaries and curve of display values; white is D65 in all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DisplaySpace {
    /// Rec.709's primaries, sRGB's curve (IEC 61966-2-1).
    #[default]
    Srgb,
    /// P3's primaries, sRGB's curve.
    DisplayP3,
    /// Rec.2020's primaries, PQ's curve of absolute luminance (ITU-R BT.2100).
    Rec2020Pq,
}

impl DisplaySpace {
    const NAMES: [(Self, &'static str); 3] = [(Self::Srgb, "srgb"), (Self::DisplayP3, "display-p3"), (Self::Rec2020Pq, "rec2020-pq")];

    /// Luminance of a display value of 1 where luminance is absolute, cd/m²: graphics white of ITU-R BT.2408.
    pub(super) const REFERENCE_WHITE: f32 = 203.0;
    /// Luminance that the photographic operators' white has there, cd/m².
    const PEAK: f32 = 1000.0;

    /// From linear Rec.709 to P3's primaries with D65 (SMPTE EG 432-1).
    pub(super) const TO_DISPLAY_P3: [[f32; 3]; 3] =
        [[0.822_462_1, 0.177_538, 0.0], [0.033_194_1, 0.966_805_8, 0.0], [0.017_082_7, 0.072_397_4, 0.910_519_9]];
    /// From linear Rec.709 to Rec.2020's primaries (ITU-R BT.2087).
    pub(super) const TO_REC2020: [[f32; 3]; 3] =
        [[0.627_403_9, 0.329_283, 0.043_313_1], [0.069_097_3, 0.919_540_4, 0.011_362_3], [0.016_391_4, 0.088_013_3, 0.895_595_3]];

    /// The space of a name: `srgb`, `display-p3` or `rec2020-pq`.
    pub fn by_name(name: &str) -> Result<Self> {
        let found = Self::NAMES.iter().find(|(_, known)| *known == name).map(|(space, _)| *space);
        found.ok_or_else(|| Error::setting("color-space", format!("'{name}' was found, expected srgb, display-p3 or rec2020-pq")))
    }

    /// The largest value that the photographic operators reach; 1 is white without light that dazzles.
    pub(super) fn peak(self) -> f32 {
        if self == Self::Rec2020Pq { Self::PEAK / Self::REFERENCE_WHITE } else { 1.0 }
    }

    /// Numbers of primaries and curve by ITU-T H.273; `None` where files say nothing because all readers assume it.
    pub(in crate::output) fn code_points(self) -> Option<[u8; 2]> {
        match self {
            Self::Srgb => None,
            Self::DisplayP3 => Some([12, 13]),
            Self::Rec2020Pq => Some([9, 16]),
        }
    }
}
