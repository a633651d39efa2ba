//! What indices of refraction of metals and glasses have in common.

use gonio_formats::FormatError;
use std::cmp::Ordering;

/// Wavelengths below this are micrometres: no light that is seen has so few nm.
pub(crate) const MICROMETRES: f64 = 50.0;

/// Micrometres as nanometres, without the noise of the product.
pub(crate) fn nanometres(um: f64) -> f64 {
    (um * 1e7).round() / 1e4
}

/// Makes wavelengths nanometres that are all micrometres.
pub(crate) fn to_nanometres(wavelengths: &mut [f64]) {
    if wavelengths.iter().all(|wavelength| *wavelength < MICROMETRES) {
        wavelengths.iter_mut().for_each(|wavelength| *wavelength = nanometres(*wavelength));
    }
}

/// Refuses wavelengths in nm that do not increase.
pub(crate) fn increasing(wavelengths_nm: &[f64]) -> Result<(), FormatError> {
    match wavelengths_nm.windows(2).find(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less)) {
        Some(pair) => Err(FormatError::whole(format!("{} nm after {} nm, expected increasing wavelengths", pair[1], pair[0]))),
        None => Ok(()),
    }
}

/// A name without what does not matter in it: letters and digits alone, in capitals.
pub(crate) fn plain(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_ascii_uppercase()
}
