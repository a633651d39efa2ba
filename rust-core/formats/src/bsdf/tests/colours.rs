//! Channels as colours.

use super::super::Channels;

fn rgb(channels: &Channels, values: &[f64]) -> [f64; 3] {
    let weights = channels.rgb_weights();
    [0, 1, 2].map(|c| values.iter().zip(&weights).map(|(v, w)| v * w[c]).sum())
}

#[test]
fn a_white_reflector_is_white_in_any_channels() {
    let bands = |w: &[f64]| Channels::bands(w.to_vec()).unwrap();
    let fine: Vec<f64> = (0..161).map(|i| 360.0 + 4.0 * f64::from(i)).collect();
    let cases =
        [Channels::Luminance, Channels::Rgb, Channels::Xyz, bands(&[550.0]), bands(&[450.0, 500.0, 550.0, 600.0, 650.0]), bands(&fine)];
    for channels in cases {
        let white = vec![1.0; channels.count()];
        for x in rgb(&channels, &white) {
            assert!((x - 1.0).abs() < 1e-6, "{channels:?}: {x}");
        }
        assert!((channels.luminance_weights().iter().sum::<f64>() - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_long_wave_reflector_is_red_and_has_the_observers_luminance() {
    let wavelengths: Vec<f64> = (0..95).map(|i| 360.0 + 5.0 * f64::from(i)).collect();
    let values: Vec<f64> = wavelengths.iter().map(|&w| if w > 600.0 { 1.0 } else { 0.0 }).collect();
    let channels = Channels::bands(wavelengths).unwrap();
    let [r, g, b] = rgb(&channels, &values);
    assert!(r > 0.5 && g.abs() < 0.1 && b.abs() < 0.05, "{r} {g} {b}");
    // The share of ȳ under a ramp from 600 to 605 nm and one beyond, summed up from the table of CIE 15.
    let luminance: f64 = values.iter().zip(channels.luminance_weights()).map(|(v, w)| v * w).sum();
    assert!((luminance - 0.160_01).abs() < 1e-4, "{luminance}");
}

#[test]
fn wavelengths_have_to_increase() {
    assert!(Channels::bands(vec![]).is_err());
    assert!(Channels::bands(vec![500.0, 500.0]).is_err());
    assert!(Channels::bands(vec![500.0, f64::NAN]).is_err());
    assert!(Channels::bands(vec![-1.0]).is_err());
}
