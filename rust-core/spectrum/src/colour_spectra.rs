//! Spectra of light by its colour, for light that has many colours, as skies have.
//!
//! The map from colour to spectrum is linear: it commutes with the filtering of pictures, and light keeps its colour.

use crate::{
    illuminant::daylight_components,
    integral::{Integral, VISIBLE},
    white,
};
use gonio_formats::FormatError;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// What red, green and blue of a light's colour are: light of linear Rec.709 (r, g, b) has r, g and b parts of the three.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColourSpectra {
    /// nm, strictly increasing, two of them at least.
    pub wavelengths_nm: Vec<f64>,
    /// Red, green and blue over daylight D65 at each of these, linear between them and held beyond. White is 1 where all three add up to that.
    pub over_d65: [Vec<f64>; 3],
}

static DAYLIGHT: LazyLock<ColourSpectra> = LazyLock::new(of_components);

impl ColourSpectra {
    /// The points of spectra that are smooth over daylight, nm.
    pub fn steps() -> Vec<f64> {
        (0..=80).map(|step| VISIBLE[0] + 5.0 * f64::from(step)).collect()
    }

    /// Daylight by its colour (CIE 15, 4.1.2): the sum of the three components of the CIE's daylight that has it. A colour of the D series has that
    /// illuminant's spectrum.
    pub fn daylight() -> &'static Self {
        &DAYLIGHT
    }

    /// Checks what others made.
    ///
    /// # Errors
    /// Lists of other lengths, fewer than two points, wavelengths that do not increase, numbers that are not finite.
    pub fn check(&self) -> Result<(), FormatError> {
        let Self { wavelengths_nm, over_d65 } = self;
        let counts = over_d65.each_ref().map(Vec::len);
        if counts != [wavelengths_nm.len(); 3] {
            return Err(FormatError::whole(format!("{} wavelengths, and {counts:?} numbers of red, green and blue", wavelengths_nm.len())));
        }
        if wavelengths_nm.len() < 2 || !wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]) {
            return Err(FormatError::whole("expected two wavelengths or more that increase"));
        }
        let is_finite = over_d65.iter().chain([wavelengths_nm]).flatten().all(|value| value.is_finite());
        if is_finite { Ok(()) } else { Err(FormatError::whole("numbers that are not finite")) }
    }

    /// Red, green and blue over daylight D65 at a wavelength in nm.
    pub fn at(&self, nm: f64) -> [f64; 3] {
        let (below, part) = place(&self.wavelengths_nm, nm);
        self.over_d65.each_ref().map(|values| values[below] + part * (values[below + 1] - values[below]))
    }
}

/// Linear Rec.709 of light that over daylight D65 is 1 at one of these wavelengths in nm and 0 at the others, linear between them and held beyond.
pub fn colours_over_d65(wavelengths_nm: &[f64]) -> Vec<[f64; 3]> {
    let colour = |point: usize| {
        let share = |nm: f64| {
            let (below, part) = place(wavelengths_nm, nm);
            if below == point { 1.0 - part } else { part * f64::from(u8::from(below + 1 == point)) }
        };
        Integral::new(wavelengths_nm, |nm| white::colour(nm).map(|part| part * share(nm))).all()
    };
    (0..wavelengths_nm.len()).map(colour).collect()
}

/// The point below a wavelength that is not the last, and how far it is to the next, 0 to 1.
fn place(wavelengths_nm: &[f64], nm: f64) -> (usize, f64) {
    let above = wavelengths_nm.partition_point(|point| *point <= nm).clamp(1, wavelengths_nm.len() - 1);
    let [low, high] = [wavelengths_nm[above - 1], wavelengths_nm[above]];
    (above - 1, ((nm - low) / (high - low)).clamp(0.0, 1.0))
}

fn of_components() -> ColourSpectra {
    let wavelengths_nm = ColourSpectra::steps();
    let components: Vec<[f64; 3]> =
        wavelengths_nm.iter().map(|nm| daylight_components(*nm).map(|value| value / white::d65_power(*nm))).collect();
    let mut colours = [[0.0; 3]; 3];
    for (colour, values) in colours_over_d65(&wavelengths_nm).iter().zip(&components) {
        for (sum, value) in colours.iter_mut().zip(values) {
            (0..3).for_each(|k| sum[k] += colour[k] * value);
        }
    }
    let over_d65 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|primary| {
        let parts = white::solved(colours, primary);
        components.iter().map(|values| (0..3).map(|k| parts[k] * values[k]).sum()).collect()
    });
    ColourSpectra { wavelengths_nm, over_d65 }
}
