//! The CIE's observers, linear between whole nanometres, and chromaticities.

use crate::{
    source::{Spectrum, sums},
    table::Table,
};
use std::sync::LazyLock;

/// The wavelengths of the observers' tables, nm.
pub(crate) const OBSERVED: [f64; 2] = [360.0, 830.0];

/// Luminous efficacy at 555 nm in lm/W (CIE 018).
pub(crate) const EFFICACY: f64 = 683.002;

static CIE_2015: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/cie_2015.csv")));
static CIE_1964: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/cie_1964.csv")));

/// A standard observer of the CIE.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CieObserver {
    /// Of 1931, 2°: the one of lumens, CCT and all else that does not say otherwise.
    Cie1931,
    /// Of 1964, 10°.
    Cie1964,
    /// Of CIE 170-2:2015 by the cones' own sensitivities, 2°.
    Cie2015,
    /// The same, 10°.
    Cie2015Wide,
}

impl CieObserver {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Cie1931, Self::Cie1964, Self::Cie2015, Self::Cie2015Wide];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cie1931 => "cie-1931",
            Self::Cie1964 => "cie-1964",
            Self::Cie2015 => "cie-2015",
            Self::Cie2015Wide => "cie-2015-10",
        }
    }

    /// The observer of a name, in any letters.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|observer| observer.name().eq_ignore_ascii_case(name))
    }

    /// x̄, ȳ, z̄ at a wavelength in nm.
    pub fn at(self, nm: f64) -> [f64; 3] {
        match self {
            Self::Cie1931 => cie_1931(nm),
            Self::Cie1964 => cie_1964(nm),
            Self::Cie2015 => CIE_2015.all(nm),
            Self::Cie2015Wide => [3, 4, 5].map(|column| CIE_2015.at(column, nm)),
        }
    }

    /// The chromaticity x, y of a spectrum.
    pub fn chromaticity(self, spectrum: &Spectrum) -> [f64; 2] {
        xy(sums(&spectrum.nodes(), |nm| self.at(nm)))
    }
}

/// x̄, ȳ, z̄ of the 2° observer.
pub(crate) fn cie_1931(nm: f64) -> [f64; 3] {
    let low = nm.floor();
    let [below, above] = [low, low + 1.0].map(gonio_formats::bsdf::cie_1931);
    std::array::from_fn(|k| below[k] + (nm - low) * (above[k] - below[k]))
}

/// x̄, ȳ, z̄ of the 10° observer.
pub(crate) fn cie_1964(nm: f64) -> [f64; 3] {
    CIE_1964.all(nm)
}

/// x, y of tristimulus values.
pub(crate) fn xy([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + y + z;
    [x / sum, y / sum]
}

/// u, v of the CIE 1960 diagram.
pub(crate) fn uv([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 6.0 * y / sum]
}
