//! What makes a list of points a spectrum of a lamp.

use crate::{
    observer::{self, OBSERVED},
    source::{Spectrum, sums},
};
use gonio_formats::{
    FormatError,
    spectrum::{SpectralPoint, SpectralPower},
};

/// The wavelengths that figures are defined over, nm (CIE 15, CIE 224, TM-30).
const WANTED: [f64; 2] = [380.0, 780.0];

/// The points as a spectrum.
pub(crate) fn checked(name: &str, points: &[SpectralPoint]) -> Result<Spectrum, FormatError> {
    Spectrum::of(SpectralPower::new(name, points)?)
}

impl Spectrum {
    /// The spectrum of a file's power over wavelength.
    ///
    /// # Errors
    /// No visible light.
    pub fn of(found: SpectralPower) -> Result<Self, FormatError> {
        let SpectralPower { name, wavelengths_nm, power, notes } = found;
        check_light(Self { name, wavelengths_nm, power, notes })
    }
}

/// Says which wavelengths are missing and which the observer does not know; refuses what nobody sees.
fn check_light(mut spectrum: Spectrum) -> Result<Spectrum, FormatError> {
    let [first, last] = [spectrum.wavelengths_nm[0], spectrum.wavelengths_nm[spectrum.wavelengths_nm.len() - 1]];
    let nodes = spectrum.nodes();
    let [all, observed, luminous] =
        sums(&nodes, |nm| [1.0, if (OBSERVED[0]..=OBSERVED[1]).contains(&nm) { 1.0 } else { 0.0 }, observer::cie_1931(nm)[1]]);
    if luminous <= 0.0 {
        return Err(FormatError::whole(format!("no visible light from {first} to {last} nm")));
    }
    if first > WANTED[0] || last < WANTED[1] {
        let [from, to] = WANTED;
        spectrum.notes.push(format!(
            "the data go from {first} to {last} nm: beyond there is no light to us; the figures are defined over {from} to {to} nm"
        ));
    }
    let share = 100.0 * (1.0 - observed / all);
    if share > 0.005 {
        let [from, to] = OBSERVED;
        spectrum.notes.push(format!(
            "{share:.2} % of the power lies outside the observer's {from} to {to} nm: it counts in the luminous efficacy of radiation alone"
        ));
    }
    Ok(spectrum)
}
