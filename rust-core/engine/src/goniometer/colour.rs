//! Colour of light by numbers: CIE 1931 tristimulus values, chromaticities, and the correlated colour temperature.

use crate::{
    colour::{Gamut, apply},
    light::blackbody_rgb,
    light_paths::Channels,
};

/// Temperatures of black bodies that are known, K.
const TEMPERATURES: [f64; 2] = [1000.0, 10_000.0];
/// Distance in the CIE 1960 diagram beyond which a temperature means nothing (CIE 15).
const FARTHEST: f64 = 0.05;
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

/// The correlated colour temperature in K: that of the black body that is nearest in the CIE 1960 diagram. Nothing for colours that are far from
/// any of 1000 to 10000 K.
pub fn colour_temperature(rgb: Channels) -> Option<f64> {
    let here = diagram(rgb)?;
    let away = |kelvin: f64| {
        let body = blackbody_rgb(kelvin as f32).map(f64::from);
        diagram(body).map_or(f64::INFINITY, |there| (here[0] - there[0]).hypot(here[1] - there[1]))
    };
    // In reciprocal temperature the locus is walked evenly.
    let [mut low, mut high] = TEMPERATURES.map(|kelvin| 1.0 / kelvin);
    std::mem::swap(&mut low, &mut high);
    let ends = [low, high];
    const STEPS: usize = 64;
    let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / STEPS as f64;
    let nearest = (0..=STEPS).min_by(|a, b| away(1.0 / at(*a)).total_cmp(&away(1.0 / at(*b))))?;
    if away(1.0 / at(nearest)) > FARTHEST || nearest == 0 || nearest == STEPS {
        return None;
    }
    (low, high) = (at(nearest - 1), at(nearest + 1));
    for _ in 0..40 {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if away(1.0 / a) < away(1.0 / b) { high = b } else { low = a }
    }
    Some(2.0 / (low + high))
}

/// Whether the light is coloured; white is what lights are of which nobody has said anything.
pub fn is_coloured(rgb: Channels) -> bool {
    let [least, most] = rgb.iter().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], x| [a.min(*x), b.max(*x)]);
    most - least > WHITE * most
}

/// The CIE 1960 diagram's u and v.
fn diagram(rgb: Channels) -> Option<[f64; 2]> {
    let [x, y] = chromaticity(rgb)?;
    let below = -2.0 * x + 12.0 * y + 3.0;
    Some([4.0 * x / below, 6.0 * y / below])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temperatures_are_those_of_black_bodies() {
        for kelvin in [1800.0, 2700.0, 4000.0, 6500.0] {
            let found = colour_temperature(blackbody_rgb(kelvin).map(|x| 7.0 * f64::from(x))).expect("a black body");
            assert!((found / f64::from(kelvin) - 1.0).abs() < 2e-3, "{kelvin}: {found}");
        }
        // D65 is near 6504 K.
        let white = colour_temperature([1.0; 3]).expect("daylight");
        assert!((white - 6504.0).abs() < 30.0, "{white}");
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
