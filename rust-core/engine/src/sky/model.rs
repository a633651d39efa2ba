//! Names of the skies.

use super::CIE_TYPES;
use crate::{Error, Result};
use std::fmt;

/// How luminance is spread over the sky.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SkyModel {
    /// The all-weather sky of Perez.
    #[default]
    Perez,
    /// The clear sky of Hošek and Wilkie.
    HosekWilkie,
    /// A type of the CIE standard, 1 to 15, or 16 for the traditional overcast sky.
    Cie(u8),
}

/// Name and model of the skies that have a name.
const NAMES: [(&str, SkyModel); 4] =
    [("perez", SkyModel::Perez), ("hosek-wilkie", SkyModel::HosekWilkie), ("overcast", SkyModel::Cie(16)), ("clear", SkyModel::Cie(12))];

impl SkyModel {
    /// The model of a name: `perez`, `hosek-wilkie`, `overcast`, `clear`, or `cie1` to `cie16`.
    ///
    /// # Errors
    /// No model has the name.
    pub fn parse(name: &str) -> Result<Self> {
        let known = NAMES.iter().find(|(known, _)| *known == name).map(|(_, model)| *model);
        let numbered =
            || name.strip_prefix("cie").and_then(|number| number.parse().ok()).filter(|kind| CIE_TYPES.contains(kind)).map(Self::Cie);
        let problem = || format!("'{name}' was found, expected perez, hosek-wilkie, overcast, clear, or cie1 to cie16");
        known.or_else(numbered).ok_or_else(|| Error::setting("sky", problem()))
    }

    /// Whether clouds hide the sun.
    pub(super) fn hides_sun(self) -> bool {
        matches!(self, Self::Cie(1..=5 | 16))
    }
}

impl fmt::Display for SkyModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (NAMES.iter().find(|(_, model)| model == self), self) {
            (Some((name, _)), _) => f.write_str(name),
            (None, Self::Cie(kind)) => write!(f, "cie{kind}"),
            (None, _) => f.write_str("perez"),
        }
    }
}
