//! Zemax OpticStudio's source files (OpticStudio user guide, "Source File"; extensions `.dat` and `.sdf`).
//!
//! Binary: a head of 208 bytes and then seven numbers of four bytes a ray (x, y, z, l, m, n, flux), or eight with the wavelength in µm behind
//! them. The guide says that OpticStudio uses the number of rays, the unit of length, the kind of rays and the unit of flux alone; so do we:
//! the whole flux is the rays' sum. Text: a line with the number of rays and the unit of length, and then a line for each ray, whose flux is in
//! a unit that the file does not tell.

use super::collect::{Collector, StatedFlux, count, is_seen};
use super::{FluxUnit, LengthUnit, RayColour, RayFile, RayFormat};
use crate::bsdf::bytes::{Cursor, floats};
use crate::error::{FormatError, Result};
use crate::photometry::text::{Lines, decode, parse};

/// Numbers that a binary file begins with: today's, and the one before.
const IDENTIFIERS: [i32; 2] = [1010, 8_675_309];

/// Bytes of the head.
const HEAD: usize = 208;

/// Bytes of the description in it.
const DESCRIPTION: usize = 100;

/// Units of length by their number.
const UNITS: [LengthUnit; 5] = [LengthUnit::Metres, LengthUnit::Inches, LengthUnit::Centimetres, LengthUnit::Feet, LengthUnit::Millimetres];

/// Whether the bytes begin with the number of a binary file and are as long as its head.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    bytes.len() >= HEAD && IDENTIFIERS.iter().any(|identifier| bytes.starts_with(&identifier.to_le_bytes()))
}

/// Whether a first line has a count and a unit of length, and a second one a ray.
pub(super) fn looks_like_text(head: &[u8]) -> bool {
    let Ok(text) = decode(head) else { return false };
    let mut lines = Lines::new(&text).map(|(_, line)| line).filter(|line| !line.trim().is_empty());
    let first: Option<Vec<f64>> = lines.next().and_then(|line| line.split_whitespace().map(parse).collect());
    let counts = first.is_some_and(|first| first.len() >= 2 && unit_of(first[1]).is_some() && first[0] >= 1.0 && first[0].fract() == 0.0);
    counts && lines.next().is_some_and(|line| line.split_whitespace().filter_map(parse).count() >= 7)
}

fn unit_of(number: f64) -> Option<LengthUnit> {
    (number.fract() == 0.0 && number >= 0.0).then(|| UNITS.get(number as usize).copied())?
}

/// Reads a binary source file.
///
/// # Errors
/// A head that is no such file's, or fewer rays than it states (unless `lenient`).
pub fn read(bytes: &[u8], lenient: bool) -> Result<RayFile> {
    if !looks_like(bytes) {
        return Err(FormatError::byte(0, "not a Zemax binary source file: its head begins with 1010"));
    }
    let mut cursor = Cursor::new(bytes);
    cursor.i32("the identifier")?;
    let stated = cursor.u32("the number of rays")?;
    let description = text(cursor.take(DESCRIPTION, "the description")?);
    // Fluxes, wavelength and angles are for who reads the head.
    cursor.take(7 * 4, "the fluxes and angles")?;
    let at = cursor.at();
    let number = cursor.u32("the unit of length")?;
    let unit = unit_of(f64::from(number));
    let unit = unit.ok_or_else(|| FormatError::byte(at, format!("the unit of length is {number}, expected 0 to 4")))?;
    let placed: Vec<f32> = floats(cursor.take(6 * 4, "the place")?).collect();
    cursor.take(7 * 4, "the scale")?;
    let at = cursor.at();
    let (kind, flux_type) = (cursor.i32("the kind of rays")?, cursor.i32("the unit of flux")?);
    let width = match kind {
        0 => 7,
        2 => 8,
        _ => return Err(FormatError::byte(at, format!("the kind of rays is {kind}, expected 0 (flux) or 2 (spectral)"))),
    };
    cursor.take(2 * 4, "the rest of the head")?;
    let (rays, warning) = count(stated.into(), 4 * width, cursor.rest().len(), lenient)?;
    let mut collector = Collector::new(RayFormat::Zemax, unit, rays);
    warning.into_iter().for_each(|warning| collector.warn(warning));
    if placed.iter().any(|value| *value != 0.0) {
        collector.warn("the head places the source elsewhere, which OpticStudio does not either: not moved".into());
    }
    collector.describe(&description);
    for ray in cursor.rest().chunks_exact(4 * width).take(rays) {
        push(&mut collector, floats(ray));
    }
    let lumens = kind == 0 && flux_type == 1;
    finish(collector, kind == 2, if lumens { FluxUnit::Lumens } else { FluxUnit::Watts })
}

/// Reads a text source file; its fluxes are in proportion, or watts where rays have wavelengths.
///
/// # Errors
/// A first line without a count and a unit of length, a line that is no ray, or fewer rays than stated (unless `lenient`).
pub fn read_text(bytes: &[u8], lenient: bool) -> Result<RayFile> {
    let text = decode(bytes)?;
    let mut lines = Lines::new(&text).filter(|(_, line)| !line.trim().is_empty());
    let first: Vec<f64> = lines.next().map(|(_, line)| line.split_whitespace().map_while(parse).collect()).unwrap_or_default();
    let (stated, unit) = (first.first().copied().unwrap_or(0.0), first.get(1).copied().and_then(unit_of));
    let Some(unit) = unit.filter(|_| stated >= 1.0 && stated.fract() == 0.0) else {
        return Err(FormatError::line(1, "expected the number of rays and a unit of length, 0 to 4"));
    };
    let mut collector = Collector::new(RayFormat::ZemaxText, unit, 0);
    let (mut there, mut width) = (0_u64, 0);
    for (number, line) in lines.take(stated as usize) {
        let mut ray = [0.0_f32; 8];
        let count = line.split_whitespace().take(8).zip(&mut ray).map(|(word, value)| *value = word.parse().unwrap_or(f32::NAN)).count();
        width = if width == 0 { count } else { width };
        if count < 7 || count != width {
            return Err(FormatError::line(number, format!("{count} numbers, expected {} of a ray", width.max(7))));
        }
        push(&mut collector, ray[..width].iter().copied());
        there += 1;
    }
    if there < stated as u64 {
        let problem = format!("the first line states {stated} rays, {there} are there");
        if !lenient || there == 0 {
            return Err(FormatError::whole(problem));
        }
        collector.warn(problem);
    }
    finish(collector, width == 8, if width == 8 { FluxUnit::Watts } else { FluxUnit::Relative })
}

fn push(collector: &mut Collector, mut values: impl Iterator<Item = f32>) {
    let mut ray = [0.0; 7];
    ray.iter_mut().for_each(|value| *value = values.next().unwrap_or(f32::NAN));
    // From µm to nm.
    let wavelength: Option<f32> = values.next().map(|wavelength| wavelength * 1000.0);
    collector.push(&ray, wavelength.as_slice());
}

fn finish(mut collector: Collector, spectral: bool, unit: FluxUnit) -> Result<RayFile> {
    let extra = collector.take_extra();
    if spectral && !is_seen(&extra) && !extra.is_empty() {
        return Err(FormatError::whole("no ray has a wavelength that is seen, expected some from 0.36 to 0.83 µm"));
    }
    let colour = if spectral { RayColour::Wavelengths(extra) } else { RayColour::Unknown };
    collector.finish(colour, StatedFlux { rays: unit, lumens: None, watts: None, exact: false })
}

/// Text up to the first zero.
fn text(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len());
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}

/// The bytes of a binary source file in millimetres: lumens, or watts and wavelengths where rays have their own.
///
/// Tristimulus values and spectra have no place in it and are left out.
///
/// # Errors
/// Fluxes that are only in proportion, wavelengths that are not seen, or more rays than the format counts.
pub fn write(file: &RayFile) -> Result<Vec<u8>> {
    let count = u32::try_from(file.len()).map_err(|_| FormatError::whole("more rays than a Zemax source file counts"))?;
    let wavelengths = match &file.colour {
        RayColour::Wavelengths(wavelengths) => Some(wavelengths),
        _ => None,
    };
    let fluxes = if wavelengths.is_some() { watts(file)? } else { file.fluxes.clone() };
    if file.unit == FluxUnit::Relative {
        return Err(FormatError::whole("the rays' fluxes are only in proportion: state a flux"));
    }
    let total: f64 = fluxes.iter().map(|flux| f64::from(*flux)).sum();
    let mut bytes = Vec::with_capacity(HEAD + 32 * file.len());
    bytes.extend(IDENTIFIERS[0].to_le_bytes());
    bytes.extend(count.to_le_bytes());
    let mut description = [0; DESCRIPTION];
    // The last byte stays zero.
    description.iter_mut().zip(file.description.bytes().take(DESCRIPTION - 1)).for_each(|(to, byte)| *to = byte);
    bytes.extend(description);
    let single = if let RayColour::Wavelength(wavelength) = file.colour { wavelength / 1000.0 } else { 0.0 };
    [total as f32, total as f32, single, 0.0, 0.0, 0.0, 0.0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend(4_u32.to_le_bytes());
    [0.0_f32; 6].iter().chain(&[1.0; 3]).chain(&[0.0; 4]).for_each(|value| bytes.extend(value.to_le_bytes()));
    let lumens = wavelengths.is_none() && file.unit == FluxUnit::Lumens;
    [if wavelengths.is_some() { 2_i32 } else { 0 }, i32::from(lumens), 0, 0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    for (index, flux) in fluxes.iter().enumerate() {
        let origin = file.origins[index].map(|part| part * 1000.0);
        let ray = origin.iter().chain(&file.directions[index]).chain([flux]);
        ray.for_each(|value| bytes.extend(value.to_le_bytes()));
        if let Some(wavelengths) = wavelengths {
            bytes.extend((wavelengths[index] / 1000.0).to_le_bytes());
        }
    }
    Ok(bytes)
}

/// Each ray's flux in watts.
pub(super) fn watts(file: &RayFile) -> Result<Vec<f32>> {
    if file.unit == FluxUnit::Watts {
        return Ok(file.fluxes.clone());
    }
    let unseen = || FormatError::whole("rays of a colour that is not seen have no flux in watts");
    let efficacies = file.efficacies().ok_or_else(unseen)?;
    let watt = |(flux, efficacy): (&f32, f64)| match *flux {
        0.0 => Ok(0.0),
        _ if efficacy <= 0.0 => Err(unseen()),
        flux => Ok((f64::from(flux) / efficacy) as f32),
    };
    file.fluxes.iter().zip(efficacies).map(watt).collect()
}
