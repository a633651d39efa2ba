use super::triples::fine;
use crate::{Bands, Mixture, Spectrum, bands_of, named, observer::cie_1931, source::sums};

/// A lamp of 1 cd/m²: its power by the table of the CIE, over the luminous efficacy of its sum.
#[test]
fn bands_hold_a_lamps_power() {
    for (name, width) in [("FL11", 5.0), ("LED-B3", 5.0), ("A", 10.0), ("D65", 20.0)] {
        let (lamp, bands) = (fine(name), bands_of(width).expect("a width"));
        let luminance = crate::observer::EFFICACY * sums(&lamp.nodes(), cie_1931)[1];
        let relative = bands.tabulate(&lamp);
        let mean = |band: usize| {
            let [from, to] = [band, band + 1].map(|edge| width as usize * edge);
            let sum: f64 = (from..to).map(|k| 0.5 * (lamp.power[k] + lamp.power[k + 1])).sum();
            sum / (width * luminance)
        };
        let peak = (0..bands.count()).map(mean).fold(0.0, f64::max);
        for (band, relative) in relative.iter().enumerate() {
            let found = bands.power(band, f64::from(*relative));
            assert!((found - mean(band)).abs() < 1e-3 * peak, "{name}, band {band}: {found}, expected {}", mean(band));
        }
    }
}

/// A lamp behind nothing has its own figures, behind a filter those of the product, and two lamps those of the sum; lines stay lines.
#[test]
fn mixtures_make_the_spectrum() {
    let bands = bands_of(10.0).expect("a width");
    for name in ["A", "FL11", "LED-B3", "HP1", "E"] {
        let lamp = named(name).expect("a name").expect("a spectrum");
        let mixture = Mixture::new(bands, std::slice::from_ref(&lamp));
        let again = mixture.spectrum(&mixture.power(&[vec![3.0; 40]])).expect("light");
        assert!((again.luminous() - 3.0).abs() < 3e-3, "{name}: {} lm", again.luminous());
        let [found, expected] = [&again, &lamp].map(|spectrum| crate::figures(spectrum).white.expect("white"));
        let ra = |white: &crate::White| white.rendering.as_ref().expect("indices").ra;
        assert!((found.cct - expected.cct).abs() < 1e-6 && (ra(&found) - ra(&expected)).abs() < 1e-6, "{name}");
    }
    let lamps = ["LED-B1", "HP1"].map(fine);
    let filter = |nm: f64| 0.2 + (nm - 380.0) / 800.0;
    let through: Vec<f64> = bands.centres().into_iter().map(filter).collect();
    let mixture = Mixture::new(bands, &lamps);
    let found = mixture.power(&[through, vec![2.0; 40]]);
    let luminous = lamps.each_ref().map(Spectrum::luminous);
    for (number, nm) in mixture.wavelengths_nm().iter().enumerate().filter(|(_, nm)| (385.0..=775.0).contains(*nm)) {
        let expected = lamps[0].power[number] * filter(*nm) / luminous[0] + 2.0 * lamps[1].power[number] / luminous[1];
        assert!((found[number] / expected - 1.0).abs() < 3e-3, "{nm} nm: {}, expected {expected}", found[number]);
    }
    assert!(mixture.spectrum(&vec![0.0; 401]).is_none());
}

/// Greys are even, white is white, and colours are those of the upsampling.
#[test]
fn colours_in_bands() {
    for width in Bands::WIDTHS_NM {
        let bands = bands_of(width).expect("a width");
        let all = bands.film().into_iter().fold([0.0; 3], |sum, part| [0, 1, 2].map(|k| sum[k] + part[k]));
        assert!(all.iter().all(|part| (part - 1.0).abs() < 1e-5), "{width} nm: {all:?}");
        assert!((0..bands.count()).all(|band| bands.of_colour(band, [3.0; 3]) == 3.0));
    }
    let [blue, red] = [12, 60].map(|band| bands_of(5.0).expect("a width").of_colour(band, [5.0, 0.5, 0.1]));
    assert!(red > 5.0 * blue && blue >= 0.0);
    let [above, below] = [[2.0, 1.0, 0.5], [-2.0, -1.0, -0.5]].map(|colour| bands_of(5.0).expect("a width").of_colour(40, colour));
    assert!(above > 0.0 && (above + below).abs() < 1e-6);
    assert!(bands_of(7.0).is_none());
}
