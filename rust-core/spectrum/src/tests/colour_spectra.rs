//! Spectra by colours against the CIE's illuminants.

use crate::{
    ColourSpectra, Spectrum, Triples, bands_of, colours_over_d65, d65_power, figures, integral::Integral, named, ozone_thickness,
    solar_irradiance, triples, white,
};

/// Light of a colour, at whole nanometres.
fn light(of: &ColourSpectra, colour: [f64; 3]) -> Spectrum {
    let wavelengths: Vec<f64> = (380..=780).map(f64::from).collect();
    let power = |nm: &f64| of.at(*nm).iter().zip(colour).map(|(part, value)| part * value).sum::<f64>() * d65_power(*nm);
    Spectrum::new("", &wavelengths, &wavelengths.iter().map(power).collect::<Vec<f64>>()).expect("a spectrum")
}

/// Linear Rec.709 of a spectrum at a luminance of 1.
fn colour(spectrum: &Spectrum) -> [f64; 3] {
    let seen = Integral::new(&[], |nm| {
        let relative = spectrum.at(nm) / white::d65(nm);
        let [r, g, b] = white::colour(nm).map(|part| part * relative);
        [r, g, b, spectrum.at(nm) * white::observer(nm)[1]]
    });
    let [r, g, b, luminance] = seen.all();
    [r, g, b].map(|part| part / luminance)
}

#[test]
fn colours_of_the_d_series_have_its_illuminants() {
    for name in ["D50", "D55", "D65", "D75", "D12000K"] {
        let own = named(name).expect("a name").expect("a spectrum");
        let found = light(ColourSpectra::daylight(), colour(&own));
        let scale = own.at(560.0) / found.at(560.0);
        for nm in (385..780).step_by(5).map(f64::from) {
            let (found, expected) = (scale * found.at(nm), own.at(nm));
            assert!((found / expected - 1.0).abs() < 2e-3, "{name} at {nm} nm: {found}, expected {expected}");
        }
        let [found, own] = [figures(&found), figures(&own)];
        let cct = |figures: &crate::Figures| figures.white.as_ref().expect("white").cct;
        assert!((cct(&found) / cct(&own) - 1.0).abs() < 1e-3, "{name}: {} K, expected {}", cct(&found), cct(&own));
        for (found, own) in found.alpha_opic.iter().flatten().zip(own.alpha_opic.iter().flatten()) {
            assert!((found.der - own.der).abs() < 3e-4, "{name}: {}, expected {}", found.der, own.der);
        }
    }
}

#[test]
fn greys_are_even_and_colours_stay() {
    let daylight = ColourSpectra::daylight();
    for nm in (3800..=7800).map(|tenths| f64::from(tenths) / 10.0) {
        let sum: f64 = daylight.at(nm).iter().sum();
        assert!((sum - 1.0).abs() < 1e-3, "{sum} at {nm} nm");
    }
    let film = triples().film();
    for primary in 0..3 {
        let values = triples().filter(|nm| daylight.at(nm)[primary]);
        let mut found = [0.0; 3];
        for (film, values) in film.iter().zip(&values) {
            for (film, value) in film.iter().zip(values) {
                (0..3).for_each(|k| found[k] += f64::from(film[k] * value) / Triples::COUNT as f64);
            }
        }
        for (k, value) in found.iter().enumerate() {
            assert!((value - f64::from(u8::from(k == primary))).abs() < 2e-3, "{primary}: {found:?}");
        }
    }
}

#[test]
fn bands_have_means_by_daylight() {
    let bands = bands_of(10.0).expect("bands of 10 nm");
    for (value, centre) in bands.filter(|nm| [1.0, nm]).iter().zip(bands.centres()) {
        assert!((value[0] - 1.0).abs() < 1e-6 && (f64::from(value[1]) - centre).abs() < 0.6, "{value:?} at {centre}");
    }
}

#[test]
fn points_have_the_colours_of_their_share() {
    let steps = ColourSpectra::steps();
    let all = colours_over_d65(&steps).iter().fold([0.0; 3], |sum, colour| std::array::from_fn(|k| sum[k] + colour[k]));
    assert!(all.iter().all(|sum| (sum - 1.0).abs() < 1e-9), "{all:?}");
    // Two points beyond the ends share all of it by how far it is to each.
    let [low, high] = [0, 1].map(|point| colours_over_d65(&[380.0, 780.0])[point]);
    let centre = Integral::new(&[], |nm| white::colour(nm).map(|part| part * (nm - 380.0) / 400.0)).all();
    assert!((0..3).all(|k| (high[k] - centre[k]).abs() < 1e-9 && (low[k] + high[k] - 1.0).abs() < 1e-9), "{low:?} {high:?}");
}

#[test]
fn what_cannot_be_used_is_told() {
    let set = |wavelengths_nm: &[f64], green: &[f64]| ColourSpectra {
        wavelengths_nm: wavelengths_nm.to_vec(),
        over_d65: [vec![1.0; wavelengths_nm.len()], green.to_vec(), vec![0.0; wavelengths_nm.len()]],
    };
    assert!(set(&[400.0, 700.0], &[0.0, 0.5]).check().is_ok());
    for (wavelengths, green, problem) in [
        (vec![400.0, 700.0], vec![0.0], "2 wavelengths, and [2, 1, 2] numbers"),
        (vec![400.0], vec![0.0], "two wavelengths or more"),
        (vec![700.0, 400.0], vec![0.0; 2], "two wavelengths or more"),
        (vec![400.0, 700.0], vec![0.0, f64::NAN], "not finite"),
    ] {
        let error = set(&wavelengths, &green).check().expect_err(problem).to_string();
        assert!(error.contains(problem), "{error}");
    }
}

/// The solar constant, of which 380 to 780 nm are about a half, and the middle of ozone's Chappuis band.
#[test]
fn the_sun_has_its_irradiance() {
    let visible = Integral::new(&[], |nm| [solar_irradiance(nm)]).all()[0];
    assert!((630.0..680.0).contains(&visible), "{visible} W/m²");
    assert!((0.038..0.042).contains(&ozone_thickness(605.0, 300.0)) && ozone_thickness(400.0, 300.0) < 1e-4);
}
