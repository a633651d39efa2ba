//! Hošek and Wilkie's sky by wavelength: the authors' bands, and the spectra of red, green and blue that are nearest to them.

use super::{
    super::hosek_wilkie::{HosekWilkieChannel, channels, shape},
    matrix::{inverted, products, times},
};
use crate::{Result, colour::luminance, scene::ColourSpectra, sky::HosekWilkie};
use gonio_spectrum::{colours_over_d65, d65_power};
use std::f64::consts::PI;

/// The authors' coefficients in little-endian floats, as those of the colours: parameters of the bands, then their mean radiances.
static BANDS: &[u8] = include_bytes!("hosek_wilkie_bands.f32");
/// Bands that are fitted; the one at 320 nm is not seen.
const SEEN: usize = HosekWilkieBands::COUNT - 1;
/// Directions that they are fitted in, even over the sky.
const DIRECTIONS: usize = 256;

/// The sky's spectral radiance for one sun, turbidity and albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HosekWilkieBands([HosekWilkieChannel; Self::COUNT]);

impl HosekWilkieBands {
    /// How many there are.
    pub const COUNT: usize = 11;
    /// The middle of each, nm.
    pub const WAVELENGTHS_NM: [f64; Self::COUNT] = [320.0, 360.0, 400.0, 440.0, 480.0, 520.0, 560.0, 600.0, 640.0, 680.0, 720.0];

    /// The sky under a sun at an elevation in degrees (0 to 90), of a turbidity (1 to 10) over ground of an albedo (0 to 1).
    ///
    /// # Errors
    /// What is out of its range.
    pub fn new(elevation_deg: f64, turbidity: f64, albedo: f64) -> Result<Self> {
        channels(BANDS, elevation_deg, turbidity, albedo).map(Self)
    }

    /// Radiance in W/(m² sr nm) towards a direction whose height above the horizon has a sine of `up` (0 to 1) and that is `angle` radians from the
    /// sun.
    pub fn radiance(&self, up: f64, angle: f64) -> [f64; Self::COUNT] {
        self.0.map(|channel| (channel.radiance * shape(&channel.parameters, up, angle)).max(0.0))
    }

    /// The spectra of red, green and blue by which the colours of a model have spectra nearest to these in all directions, in the sum of squares of
    /// relative differences, and keep their colours. Between the bands they are linear over daylight. None where the sky has one colour.
    pub(super) fn nearest(&self, model: &HosekWilkie, elevation_deg: f64) -> Option<ColourSpectra> {
        let wavelengths_nm = Self::WAVELENGTHS_NM[1..].to_vec();
        let mut samples = [([0.0; SEEN], [0.0; 3]); DIRECTIONS];
        for (number, sample) in samples.iter_mut().enumerate() {
            let (up, angle) = direction(number, elevation_deg);
            *sample = (self.over_d65(up, angle), model.radiance(up, angle));
        }
        let colours: [[f64; 3]; SEEN] = colours_over_d65(&wavelengths_nm).try_into().ok()?;
        let over_d65 = fitted(&mut samples, &colours)?;
        let of_colour = |k: usize| over_d65.iter().map(|row| row[k]).collect();
        Some(ColourSpectra { wavelengths_nm, over_d65: [0, 1, 2].map(of_colour) })
    }

    /// Over daylight in the bands that are seen.
    fn over_d65(&self, up: f64, angle: f64) -> [f64; SEEN] {
        let radiance = self.radiance(up, angle);
        std::array::from_fn(|band| radiance[band + 1] / d65_power(Self::WAVELENGTHS_NM[band + 1]))
    }
}

/// A direction's height as a sine, and its angle from a sun that is so high: a spiral from the zenith to the horizon.
fn direction(number: usize, elevation_deg: f64) -> (f64, f64) {
    const GOLDEN_ANGLE: f64 = PI * 0.763_932_022_500_210_3;
    let up = 1.0 - (number as f64 + 0.5) / DIRECTIONS as f64;
    let (sun_up, sun_flat) = elevation_deg.to_radians().sin_cos();
    let cosine = (1.0 - up * up).sqrt() * (GOLDEN_ANGLE * number as f64).cos() * sun_flat + up * sun_up;
    (up, cosine.clamp(-1.0, 1.0).acos())
}

/// For each band what red, green and blue have there: least squares under the condition that they have the colours red, green and blue, of which each
/// band brings its part.
fn fitted(samples: &mut [([f64; SEEN], [f64; 3])], colours: &[[f64; 3]; SEEN]) -> Option<[[f64; 3]; SEEN]> {
    // All of luminance 1; the spectra have another unit.
    let brightness = |bands: &[f64; SEEN]| bands.iter().zip(colours).map(|(value, colour)| value * luminance(*colour)).sum::<f64>();
    let unit = samples.iter().map(|(bands, colour)| brightness(bands) / luminance(*colour)).sum::<f64>() / samples.len() as f64;
    for (bands, colour) in samples.iter_mut() {
        let scale = luminance(*colour);
        *bands = bands.map(|value| value / (unit * scale));
        *colour = colour.map(|part| part / scale);
    }
    let free = times(
        &products(samples.iter().map(|(bands, colour)| (*bands, *colour))),
        &inverted(&products(samples.iter().map(|(_, colour)| (*colour, *colour)))),
    );
    // Bands give way in proportion to their squares.
    let squares: [f64; SEEN] = std::array::from_fn(|band| samples.iter().map(|(bands, _)| bands[band] * bands[band]).sum());
    let weighed: [[f64; 3]; SEEN] = std::array::from_fn(|band| colours[band].map(|part| part * squares[band] / samples.len() as f64));
    let lacking = products(colours.iter().zip(&free).map(|(colour, free)| (*colour, *free)));
    let lacking: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|k| f64::from(u8::from(i == k)) - lacking[i][k]));
    let response = inverted(&products(colours.iter().zip(&weighed).map(|(colour, weighed)| (*colour, *weighed))));
    let added = times(&times(&weighed, &response), &lacking);
    let found: [[f64; 3]; SEEN] = std::array::from_fn(|band| std::array::from_fn(|k| free[band][k] + added[band][k]));
    let is_red = colours.iter().zip(&found).map(|(colour, found)| colour[0] * found[0]).sum::<f64>();
    (is_red.is_finite() && (is_red - 1.0).abs() < 1e-6).then_some(found)
}
