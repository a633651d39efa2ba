//! Pictures by wavelength: OpenEXR in the layout of Fichet, Pacanowski and Wilkie (JCGT 2021), and Radiance's spectral pictures.

use super::{
    exr::{ExrOptions, Further, write_exr_with},
    write_atomically,
};
use crate::{
    error::{Error, Result},
    scene::Aov,
    spectral_picture::{SpectralLayer, SpectralPicture},
};
use gonio_spectrum::Bands;
use std::{io::Write, path::Path};

/// The most bands that Radiance reads, as it is built by default.
const MOST_BANDS: usize = 24;
/// Radiance's lm/W, and what equal power per nm over the visible wavelengths has in truth: 683.002 lm/W times the integral of ȳ.
const RADIANCE_EFFICACY: f64 = 179.0;
const EQUAL_POWER: f64 = 683.002 * 106.857;

/// A file's ending in small letters.
fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// Makes sure that a picture of these bands can be written under a name.
///
/// # Errors
/// Other endings than `.exr` and `.hsr`, more bands than Radiance reads.
pub fn check_spectral(path: &Path, bands: &Bands) -> Result<()> {
    match ending(path).as_str() {
        "exr" => Ok(()),
        "hsr" if bands.count() <= MOST_BANDS => Ok(()),
        "hsr" => {
            let problem = format!("{} bands, Radiance reads {MOST_BANDS} at most: take bands of 20 nm", bands.count());
            Err(Error::setting("band", problem))
        }
        other => Err(Error::setting("by-wavelength", format!("{}: the ending is '{other}', expected exr or hsr", path.display()))),
    }
}

/// Writes a picture by wavelength, `.exr` or `.hsr` by the file's ending.
///
/// # Errors
/// As [`check_spectral`], and what the system says.
pub fn write_spectral(path: &Path, found: &SpectralPicture, options: &ExrOptions) -> Result<()> {
    check_spectral(path, found.bands)?;
    if ending(path) == "hsr" { write_atomically(path, true, |file| hsr(found, file)) } else { write_exr(path, found, options) }
}

/// The name of a band's channel: the emissive spectrum, with a comma in its number as the layout has it.
pub(super) fn channel_name(nm: f64) -> String {
    format!("S0.{}nm", format!("{nm:.6}").replace('.', ","))
}

/// What stands before the bands' names of a pass.
fn prefix(layer: &SpectralLayer) -> String {
    match layer.aov {
        Aov::Color => String::new(),
        Aov::Illuminance => "Illuminance.".to_owned(),
        _ => format!("{}.", layer.name),
    }
}

fn write_exr(path: &Path, found: &SpectralPicture, options: &ExrOptions) -> Result<()> {
    let band = |layer: &SpectralLayer, number: usize| format!("{}{}", prefix(layer), channel_name(found.bands.centre(number)));
    let of_layer = |layer: &SpectralLayer| -> Further {
        layer.bands.iter().enumerate().map(|(number, values)| (band(layer, number), values.clone())).collect()
    };
    let further: Further = found.layers.iter().flat_map(of_layer).collect();
    let mut options = ExrOptions { exposure: found.exposure as f32, ..options.clone() };
    let notes = [("spectralLayoutVersion", "1.0".to_owned()), ("emissiveUnits", "W.m^-2.sr^-1".to_owned())];
    options.attributes.extend(notes.map(|(key, value)| (key.to_owned(), value)));
    for layer in &found.layers {
        let unit = if layer.aov == Aov::Illuminance { "W/(m^2 nm)" } else { "W/(m^2 sr nm)" };
        let text = format!("{unit}, means over {} nm", found.bands.width_nm());
        options.attributes.push((format!("gonio:unit:{}S0", prefix(layer)), text));
        options.attributes.extend(layer.lamp.as_ref().map(|lamp| (lamp_note(&layer.name), lamp_text(lamp))));
    }
    write_exr_with(path, &found.image, &further, &options)
}

/// The header's entry of what the lamps of a light group's pass send.
pub(super) fn lamp_note(name: &str) -> String {
    format!("gonio:lamp:{name}")
}

fn lamp_text(lamp: &[f32]) -> String {
    lamp.iter().map(|value| format!("{value:e}")).collect::<Vec<_>>().join(" ")
}

/// Radiance's form: bands from the longest wavelength to the shortest, bytes with one exponent a pixel. An even spectrum has the value of its luminance over
/// 179 lm/W in all of them.
fn hsr(found: &SpectralPicture, file: &mut impl Write) -> std::io::Result<()> {
    let [width, height] = found.image.size();
    let count = found.bands.count();
    write!(file, "#?RADIANCE\nSOFTWARE= gonio {}\n", env!("CARGO_PKG_VERSION"))?;
    write!(file, "NCOMP={count}\nWAVELENGTH_SPLITS= 780 588 480 380\nFORMAT=Radiance_spectra\n\n-Y {height} +X {width}\n")?;
    let scale = (EQUAL_POWER / RADIANCE_EFFICACY) as f32;
    let mut row = Vec::with_capacity(width * (count + 1));
    let mut pixel = vec![0.0; count];
    for y in 0..height {
        row.clear();
        for x in 0..width {
            pixel.iter_mut().zip(found.radiance().iter().rev()).for_each(|(value, band)| *value = scale * band[y * width + x]);
            append_common_exponent(&pixel, &mut row);
        }
        file.write_all(&row)?;
    }
    Ok(())
}

/// Values as bytes in units of 2 to the power of a byte more, less 136; the largest takes the upper half of its byte.
fn append_common_exponent(values: &[f32], bytes: &mut Vec<u8>) {
    let largest = values.iter().copied().fold(0.0, f32::max);
    if !(largest > 1e-32 && largest.is_finite()) {
        bytes.resize(bytes.len() + values.len() + 1, 0);
        return;
    }
    // The largest is within 0.5 to 1 times two to the power of this.
    let mut exponent = largest.log2().floor() as i32 + 1;
    if (f64::from(largest) * 256.0 / 2f64.powi(exponent)) as u32 > 255 {
        exponent += 1;
    }
    let unit = 256.0 / 2f64.powi(exponent);
    bytes.extend(values.iter().map(|value| (f64::from(value.max(0.0)) * unit) as u8));
    bytes.push((exponent + 128).clamp(0, 255) as u8);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_named_as_the_layout_has_it() {
        assert_eq!([382.5, 550.0].map(channel_name), ["S0.382,500000nm", "S0.550,000000nm"]);
    }

    #[test]
    fn bytes_mean_what_they_were() {
        for values in [[1.0, 0.5, 0.25, 0.0], [3e-5, 7e-6, 1e-5, 2e-5], [255.9, 256.0, 1.0, 100.0], [1e9, 9e8, 1.0, 0.0]] {
            let mut bytes = Vec::new();
            append_common_exponent(&values, &mut bytes);
            let unit = 2f64.powi(i32::from(bytes[4]) - 136);
            let largest = f64::from(values.iter().copied().fold(0.0, f32::max));
            for (byte, value) in bytes.iter().zip(values) {
                let read = (f64::from(*byte) + 0.5) * unit;
                assert!((read - f64::from(value)).abs() <= largest / 128.0, "{value}: {read}");
            }
        }
        let mut dark = Vec::new();
        append_common_exponent(&[0.0; 20], &mut dark);
        assert_eq!(dark, [0; 21]);
    }
}
