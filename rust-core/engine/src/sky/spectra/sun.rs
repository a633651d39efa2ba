//! The sun's disc by wavelength: the sun outside of the atmosphere behind air, haze and ozone, in the colour that it has without wavelengths.

use super::{
    super::colour::SunlitAir,
    matrix::{inverted, products},
};
use crate::{colour::luminance, scene::ColourSpectra};
use gonio_spectrum::{colours_over_d65, d65_power, ozone_thickness, solar_irradiance};

/// Ozone, Dobson units: the usual amount in middle latitudes.
const OZONE_DOBSON: f64 = 300.0;
/// Steps of Newton's method; it takes six at most, under the lowest sun.
const STEPS: usize = 20;
/// The colour may be off by this.
const NEAR: f64 = 1e-9;

/// The spectra of red, green and blue behind air, by which light of the sun's colour has the sun's spectrum, and all other light that differs from it by
/// daylight.
pub(super) fn behind(air: SunlitAir, sun_colour: [f64; 3]) -> ColourSpectra {
    let daylight = ColourSpectra::daylight();
    let spectrum = over_d65(air);
    let by_daylight = |point: usize| -> f64 { (0..3).map(|k| sun_colour[k] * daylight.over_d65[k][point]).sum() };
    let own: Vec<f64> = spectrum.iter().enumerate().map(|(point, value)| value - by_daylight(point)).collect();
    let of_colour = |k: usize| {
        let mut primary = [0.0; 3];
        primary[k] = 1.0;
        daylight.over_d65[k].iter().zip(&own).map(|(value, own)| value + luminance(primary) * own).collect()
    };
    ColourSpectra { wavelengths_nm: daylight.wavelengths_nm.clone(), over_d65: [0, 1, 2].map(of_colour) }
}

/// The sun's spectrum over daylight D65's, both of luminance 1, at [`ColourSpectra::steps`].
///
/// A smooth factor, e to the power of a polynomial of second degree in the wavelength, gives the spectrum the colour that a black body has behind the same air.
fn over_d65(air: SunlitAir) -> Vec<f64> {
    let steps = ColourSpectra::steps();
    let (colours, aim) = (colours_over_d65(&steps), air.sun_colour());
    let behind_ozone = |nm: f64| air.transmittance(nm) * (-ozone_thickness(nm, OZONE_DOBSON) * air.mass).exp();
    let plain: Vec<f64> = steps.iter().map(|nm| solar_irradiance(*nm) * behind_ozone(*nm) / d65_power(*nm)).collect();
    let powers: Vec<[f64; 3]> = steps.iter().map(|nm| (nm - 580.0) / 200.0).map(|t| [1.0, t, t * t]).collect();
    let brightness: f64 = colours.iter().zip(&plain).map(|(colour, value)| luminance(*colour) * value).sum();
    let mut exponents = [-brightness.ln(), 0.0, 0.0];
    let shaped = |exponents: [f64; 3]| -> Vec<f64> {
        let factor = |powers: &[f64; 3]| (0..3).map(|k| exponents[k] * powers[k]).sum::<f64>().exp();
        plain.iter().zip(&powers).map(|(value, powers)| value * factor(powers)).collect()
    };
    let mut found = shaped(exponents);
    for _ in 0..STEPS {
        let by_power =
            products(colours.iter().zip(&powers).zip(&found).map(|((colour, powers), value)| (colour.map(|part| part * value), *powers)));
        let off: [f64; 3] = std::array::from_fn(|k| aim[k] - by_power[k][0]);
        if off.iter().all(|off| off.abs() < NEAR) {
            break;
        }
        let step = inverted(&by_power).map(|row| (0..3).map(|k| row[k] * off[k]).sum::<f64>());
        exponents = std::array::from_fn(|k| exponents[k] + step[k]);
        found = shaped(exponents);
    }
    found
}
