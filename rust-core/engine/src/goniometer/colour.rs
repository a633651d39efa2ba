//! Colour of light by numbers: CIE 1931 tristimulus values, chromaticities, and the correlated colour temperature.

use crate::{
    colour::{Gamut, apply},
    light_paths::Channels,
};
use gonio_spectrum::cct_of_colour;

/// Channels that differ by less than this share are white: nobody has said what colour it is.
const WHITE: f64 = 1e-3;

/// X, Y, Z of linear Rec.709, Y being the luminance.
pub fn tristimulus(rgb: Channels) -> [f64; 3] {
    Gamut::Rec709.primaries().to_xyz().map_or([0.0; 3], |matrix| apply(&matrix, rgb))
}

/// Chromaticity x, y; nothing of no light.
pub fn chromaticity(rgb: Channels) -> Option<[f64; 2]> {
    let xyz = tristimulus(rgb);
    let sum: f64 = xyz.iter().sum();
    (sum > 0.0 && sum.is_finite()).then(|| [xyz[0] / sum, xyz[1] / sum])
}

/// CIE 1976 chromaticity u', v'; nothing of no light.
pub fn uniform_chromaticity(rgb: Channels) -> Option<[f64; 2]> {
    let [x, y] = chromaticity(rgb)?;
    let below = -2.0 * x + 12.0 * y + 3.0;
    Some([4.0 * x / below, 9.0 * y / below])
}

/// The correlated colour temperature in K and Duv (CIE 15, ANSI C78.377). Nothing for colours that are far from any black body of 1000 to 25,000 K.
pub fn colour_temperature(rgb: Channels) -> Option<[f64; 2]> {
    chromaticity(rgb)?;
    cct_of_colour(rgb).map(|(kelvin, duv)| [kelvin, duv])
}

/// Whether the light is coloured; white is what lights are of which nobody has said anything.
pub fn is_coloured(rgb: Channels) -> bool {
    let [least, most] = rgb.iter().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], x| [a.min(*x), b.max(*x)]);
    most - least > WHITE * most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::blackbody_rgb;

    #[test]
    fn temperatures_are_those_of_black_bodies() {
        // Cooler ones are cut to the gamut of Rec.709.
        for kelvin in [2000.0, 2700.0, 4000.0, 6500.0] {
            let [found, duv] = colour_temperature(blackbody_rgb(kelvin).map(|x| 7.0 * f64::from(x))).expect("a black body");
            assert!((found / f64::from(kelvin) - 1.0).abs() < 2e-3 && duv.abs() < 5e-4, "{kelvin}: {found}, {duv}");
        }
        // D65 is near 6504 K.
        let [white, duv] = colour_temperature([1.0; 3]).expect("daylight");
        assert!((white - 6504.0).abs() < 30.0 && (duv - 0.0032).abs() < 2e-4, "{white}, {duv}");
        let [u, v] = uniform_chromaticity([1.0; 3]).expect("daylight");
        assert!((u - 0.1978).abs() < 1e-4 && (v - 0.4683).abs() < 1e-4, "{u}, {v}");
        assert_eq!(colour_temperature([0.0, 1.0, 0.0]), None);
        assert_eq!(colour_temperature([0.0; 3]), None);
    }

    #[test]
    fn white_has_no_colour() {
        assert!(!is_coloured([2.0; 3]) && !is_coloured([0.0; 3]) && is_coloured([1.0, 0.9, 0.8]));
        let [x, y] = chromaticity([3.0; 3]).expect("light");
        assert!((x - 0.3127).abs() < 1e-4 && (y - 0.3290).abs() < 1e-4);
    }
}
