//! Spectra of sun and sky against the authors' formulas and a second evaluation of the sun's.

use super::somewhere;
use crate::{
    colour::luminance,
    scene::ColourSpectra,
    sky::{Daylight, HosekWilkieBands, Sky, SkyModel, SunPosition, relative_air_mass},
};
use gonio_spectrum::{colours_over_d65, d65_power, ozone_thickness, solar_irradiance};

fn sky(model: SkyModel, elevation_deg: f64, turbidity: f64) -> Sky {
    let day = Daylight { model, turbidity, ground: 0.2, ..somewhere() };
    day.sky_under(SunPosition { azimuth_deg: 200.0, elevation_deg }).expect("a sky")
}

/// Linear Rec.709 of light that is linear over D65 between the wavelengths of a set.
fn colour_of(set: &ColourSpectra, over_d65: impl Fn(usize) -> f64) -> [f64; 3] {
    let parts = colours_over_d65(&set.wavelengths_nm);
    parts.iter().enumerate().fold([0.0; 3], |sum, (point, part)| std::array::from_fn(|k| sum[k] + part[k] * over_d65(point)))
}

fn of_colour(set: &ColourSpectra, point: usize, colour: [f64; 3]) -> f64 {
    (0..3).map(|k| set.over_d65[k][point] * colour[k]).sum()
}

#[test]
fn bands_of_hosek_and_wilkie_are_those_of_their_coefficients() {
    // Sun's elevation, turbidity, albedo, direction's angles from the zenith and from the sun; the authors' formula on their data, in W/(m² sr nm).
    let published = [
        (
            [30.0, 3.7, 0.25, 60.0, 20.0],
            [0.04349339, 0.09492762, 0.1695182, 0.2139026, 0.2356488, 0.203756, 0.1766209, 0.1601274, 0.1389056, 0.1185673, 0.1007692],
        ),
        (
            [5.0, 2.0, 0.0, 85.0, 3.0],
            [0.002709187, 0.01083969, 0.03642607, 0.08474138, 0.1543922, 0.1897268, 0.2043734, 0.2265895, 0.2314039, 0.2236755, 0.2113937],
        ),
        (
            [80.0, 10.0, 1.0, 10.0, 5.0],
            [0.1593631, 0.3423136, 0.6824167, 0.9874685, 1.219152, 1.162785, 1.06976, 1.038727, 0.9634763, 0.8811997, 0.7719127],
        ),
        (
            [45.0, 1.0, 0.5, 0.0, 45.0],
            [
                0.04759983,
                0.07348307,
                0.09983954,
                0.09408364,
                0.07734154,
                0.05025864,
                0.03527695,
                0.02690828,
                0.01905182,
                0.01317853,
                0.009493665,
            ],
        ),
    ];
    for ([elevation, turbidity, albedo, zenith, angle], expected) in published {
        let sky = HosekWilkieBands::new(elevation, turbidity, albedo).expect("a sky");
        let found = sky.radiance(f64::to_radians(zenith).cos(), f64::to_radians(angle));
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-5, "{found}, expected {expected}");
        }
    }
    assert!(HosekWilkieBands::new(30.0, 11.0, 0.0).is_err());
}

/// What a sky of Hošek and Wilkie shows in the bands from 400 nm on, over the authors' own at the same luminance, in even directions: the root of the mean square
/// of the relative difference, for each band.
fn differences(elevation_deg: f64, turbidity: f64) -> Vec<f64> {
    let sky = sky(SkyModel::HosekWilkie, elevation_deg, turbidity);
    let set = sky.sky_spectra().expect("spectra");
    let bands = HosekWilkieBands::new(elevation_deg, turbidity, 0.2).expect("a sky");
    let sun = sky.sun.direction();
    let mut squares = vec![0.0; set.wavelengths_nm.len()];
    let mut count = 0.0;
    for azimuth in (0..360).step_by(30).map(|degrees| f64::from(degrees).to_radians()) {
        for up in (0..10).map(|step| (f64::from(step) + 0.5) / 10.0) {
            let flat = (1.0 - up * up).sqrt();
            let direction = [flat * azimuth.sin(), flat * azimuth.cos(), up];
            let angle = direction.iter().zip(sun).map(|(a, b)| a * b).sum::<f64>().acos();
            let radiance = bands.radiance(up, angle);
            let own = |point: usize| radiance[point + 1] / d65_power(set.wavelengths_nm[point]);
            let scale = luminance(sky.radiance(direction)) / luminance(colour_of(&set, own));
            let colour = sky.radiance(direction);
            // It is the colour that is seen without wavelengths.
            let found = colour_of(&set, |point| of_colour(&set, point, colour));
            assert!((0..3).all(|k| (found[k] - colour[k]).abs() < 1e-6 * luminance(colour)), "{found:?}, expected {colour:?}");
            for (point, sum) in squares.iter_mut().enumerate() {
                *sum += (of_colour(&set, point, colour) / (scale * own(point)) - 1.0).powi(2);
            }
            count += 1.0;
        }
    }
    squares.into_iter().map(|sum: f64| (sum / count).sqrt()).skip(1).collect()
}

#[test]
fn skies_of_hosek_and_wilkie_have_nearly_their_spectra() {
    for (elevation, turbidity) in [(60.0, 2.0), (60.0, 3.0), (30.0, 3.0), (30.0, 5.0), (15.0, 3.0)] {
        let found = differences(elevation, turbidity);
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        assert!(mean < 0.025 && found.iter().all(|band| *band < 0.06), "{elevation}°, turbidity {turbidity}: {mean} {found:?}");
    }
}

#[test]
fn other_skies_are_daylight_of_the_cie() {
    for model in [SkyModel::Perez, SkyModel::Cie(12)] {
        assert_eq!(sky(model, 40.0, 3.0).sky_spectra().as_ref(), Some(ColourSpectra::daylight()));
    }
    let white = Daylight { is_coloured: false, ..somewhere() };
    let white = white.sky_under(SunPosition { azimuth_deg: 200.0, elevation_deg: 40.0 }).expect("a sky");
    assert_eq!((white.sky_spectra(), white.sun_spectra()), (None, None));
    assert_eq!(sky(SkyModel::Perez, -5.0, 3.0).sky_spectra(), None);
}

/// Sun outside, air, haze and ozone written out again: what is left is a smooth factor, whose logarithm is of second degree.
#[test]
fn the_sun_has_its_spectrum_and_its_colour() {
    for turbidity in [1.0, 2.0, 3.0, 5.0, 8.0, 10.0] {
        for elevation in [90.0, 60.0, 30.0, 10.0, 5.0, 2.0, 0.5] {
            let sky = sky(SkyModel::Perez, elevation, turbidity);
            let set = sky.sun_spectra().expect("spectra");
            let colour = sky.sun_colour;
            let found = |point: usize| of_colour(&set, point, colour);
            let mass = relative_air_mass(elevation);
            let formula = |nm: f64| {
                let um = nm / 1000.0;
                let haze = (0.04608 * turbidity - 0.04586f64).max(0.0) * um.powf(-1.3);
                solar_irradiance(nm) / d65_power(nm) * (-mass * (0.008735 * um.powf(-4.08) + haze + ozone_thickness(nm, 300.0))).exp()
            };
            let factor = |point: usize| (found(point) / formula(set.wavelengths_nm[point])).ln();
            let third = |point: usize| factor(point + 3) - 3.0 * factor(point + 2) + 3.0 * factor(point + 1) - factor(point);
            let seen = colour_of(&set, found);
            // Low suns lie beyond Rec.709, where the colour is held.
            if colour.iter().all(|part| *part > 0.0) {
                assert!((0..set.wavelengths_nm.len()).all(|point| found(point) > 0.0), "{elevation}°, turbidity {turbidity}");
                assert!((0..78).all(|point| third(point).abs() < 1e-6), "{elevation}°, turbidity {turbidity}");
                assert!(
                    (0..3).all(|k| (seen[k] - colour[k]).abs() < 1e-4),
                    "{elevation}°, turbidity {turbidity}: {seen:?}, expected {colour:?}"
                );
            }
            assert!((luminance(seen) - 1.0).abs() < 1e-4, "{elevation}°, turbidity {turbidity}: {seen:?}");
        }
    }
}
