//! The CIE's observers, linear between whole nanometres, and chromaticities.

use crate::table::Table;
use std::sync::LazyLock;

/// The wavelengths of the observers' tables, nm.
pub(crate) const OBSERVED: [f64; 2] = [360.0, 830.0];

/// Luminous efficacy at 555 nm in lm/W (CIE 018).
pub(crate) const EFFICACY: f64 = 683.002;

static CIE_1964: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/cie_1964.csv")));

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
