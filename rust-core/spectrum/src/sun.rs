//! The sun outside of the atmosphere, and the ozone before it; `data/README.md` has the sources.

use crate::table::Table;
use std::sync::LazyLock;

/// W/(m² nm), and m² of a molecule, means over 10 nm.
static SUN: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/sun.csv")));

/// Molecules over a square metre in a Dobson unit.
const DOBSON: f64 = 2.687e20;

/// The sun's irradiance outside of the atmosphere at its mean distance, W/(m² nm), at a wavelength from 365 to 835 nm: smooth, without lines.
pub fn solar_irradiance(nm: f64) -> f64 {
    SUN.at(0, nm)
}

/// Optical thickness of so many Dobson units of ozone at a wavelength from 365 to 835 nm.
pub fn ozone_thickness(nm: f64, dobson: f64) -> f64 {
    SUN.at(1, nm) * dobson * DOBSON
}
