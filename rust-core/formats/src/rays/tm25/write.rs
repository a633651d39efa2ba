//! The writer.

use super::{MAGIC, PADDING, RESERVED, TEXT, TEXTS};
use crate::error::{FormatError, Result};
use crate::rays::zemax::watts;
use crate::rays::{FluxUnit, RayColour, RayFile, Spectrum};

/// Who writes.
const CREATOR: &str = "gonio";

/// The bytes of a TM-25 file. Rays with wavelengths or spectra of their own have watts, all others lumens if the file knows them.
///
/// # Errors
/// Fluxes that are only in proportion, or watts wanted of colours that are not seen.
pub fn write(file: &RayFile) -> Result<Vec<u8>> {
    if file.unit == FluxUnit::Relative {
        return Err(FormatError::whole("the rays' fluxes are only in proportion: state a flux"));
    }
    let own_colours = matches!(file.colour, RayColour::Wavelengths(_) | RayColour::Spectra { .. });
    let lumens = file.unit == FluxUnit::Lumens && !own_colours;
    let fluxes = if lumens { file.fluxes.clone() } else { watts(file)? };
    let total: f64 = fluxes.iter().map(|flux| f64::from(*flux)).sum();
    let spectra: &[Spectrum] = match &file.colour {
        RayColour::Spectrum(spectrum) => std::slice::from_ref(spectrum),
        RayColour::Spectra { spectra, .. } => spectra,
        _ => &[],
    };
    let mut bytes = Vec::with_capacity(256 + 32 + TEXTS * TEXT + 40 * file.len());
    head(&mut bytes, file, lumens, total, spectra.len())?;
    flags(&mut bytes, &file.colour, lumens);
    for text in [file.description.as_str(), "", CREATOR, CREATOR, CREATOR, "", "", "", ""] {
        let start = bytes.len();
        text.chars().take(TEXT / 4 - 1).for_each(|character| bytes.extend(u32::from(character).to_le_bytes()));
        bytes.resize(start + TEXT, 0);
    }
    let start = bytes.len();
    for spectrum in spectra {
        bytes.extend(number(spectrum.wavelengths.len())?.to_le_bytes());
        let pairs = spectrum.wavelengths.iter().zip(&spectrum.weights);
        pairs.for_each(|(wavelength, weight)| floats(&mut bytes, &[*wavelength, *weight]));
    }
    bytes.resize(start + (bytes.len() - start).next_multiple_of(PADDING), 0);
    for (index, flux) in fluxes.iter().enumerate() {
        floats(&mut bytes, &file.origins[index].map(|part| part * 1000.0));
        floats(&mut bytes, &file.directions[index]);
        ray(&mut bytes, &file.colour, index, *flux);
    }
    Ok(bytes)
}

fn number(count: usize) -> Result<i32> {
    i32::try_from(count).map_err(|_| FormatError::whole(format!("{count} is more than the format counts")))
}

fn floats(bytes: &mut Vec<u8>, values: &[f32]) {
    values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
}

fn head(bytes: &mut Vec<u8>, file: &RayFile, lumens: bool, total: f64, spectra: usize) -> Result<()> {
    let start = bytes.len();
    bytes.extend(MAGIC.0);
    // Created by a simulation.
    [MAGIC.1, 0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    let luminous = if file.unit == FluxUnit::Lumens { file.total as f32 } else { f32::NAN };
    floats(bytes, &[luminous, if lumens { f32::NAN } else { total as f32 }]);
    bytes.extend((file.len() as u64).to_le_bytes());
    // No date, and rays start where it is not known.
    bytes.extend([0; 28 + 4]);
    let (kind, range) = match &file.colour {
        RayColour::Unknown | RayColour::Tristimulus(_) => (0_i32, [f32::NAN; 3]),
        RayColour::Wavelength(wavelength) => (1, [*wavelength, f32::NAN, f32::NAN]),
        RayColour::Wavelengths(wavelengths) => (2, ends(wavelengths.iter())),
        RayColour::Spectrum(spectrum) => (3, ends(spectrum.wavelengths.iter())),
        RayColour::Spectra { spectra, .. } => (4, ends(spectra.iter().flat_map(|spectrum| &spectrum.wavelengths))),
    };
    bytes.extend(kind.to_le_bytes());
    floats(bytes, &range);
    [number(spectra)?, 0, 0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend([0; RESERVED]);
    debug_assert!(bytes.len() - start == 256, "the head's size");
    Ok(())
}

/// No wavelength for all, and the least and the greatest.
fn ends<'a>(wavelengths: impl Iterator<Item = &'a f32> + Clone) -> [f32; 3] {
    let least = wavelengths.clone().copied().fold(f32::INFINITY, f32::min);
    [f32::NAN, least, wavelengths.copied().fold(0.0, f32::max)]
}

fn flags(bytes: &mut Vec<u8>, colour: &RayColour, lumens: bool) {
    let wavelengths = matches!(colour, RayColour::Wavelengths(_));
    let (tristimulus, spectra) = (has_tristimulus(colour, lumens), matches!(colour, RayColour::Spectra { .. }));
    let flags = [true, true, !lumens, wavelengths, lumens, false, tristimulus, spectra];
    flags.iter().for_each(|flag| bytes.extend(i32::from(*flag).to_le_bytes()));
}

/// Tristimulus values are of luminous flux.
fn has_tristimulus(colour: &RayColour, lumens: bool) -> bool {
    lumens && matches!(colour, RayColour::Tristimulus(_))
}

/// What stands behind position and direction.
fn ray(bytes: &mut Vec<u8>, colour: &RayColour, index: usize, flux: f32) {
    match colour {
        RayColour::Wavelengths(wavelengths) => floats(bytes, &[flux, wavelengths[index]]),
        RayColour::Tristimulus(values) => floats(bytes, &[flux, values[index][0], values[index][2]]),
        RayColour::Spectra { index: numbers, .. } => floats(bytes, &[flux, numbers[index] as f32 + 1.0]),
        _ => floats(bytes, &[flux]),
    }
}
