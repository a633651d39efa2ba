//! Files of spectra: text of wavelength and power, and TM-27.

pub(crate) mod glass;
pub(crate) mod metal;
pub(crate) mod response;
mod spdx;

use crate::source::Spectrum;
use gonio_formats::{FormatError, photometry::tm33, spectrum::read_text};

/// The longest file in bytes: a thousand times the longest of a spectrometer.
const LONGEST: usize = 64 << 20;

/// Reads a file's bytes: IES TM-27 (`.spdx`) or TM-33 where an XML document begins, else lines of nanometres and power. `name` is what it is called
/// unless the file says. Of several spectra the first is read.
///
/// # Errors
/// What is no such file, and what [`Spectrum::new`] refuses, with the line.
pub fn read(bytes: &[u8], name: &str) -> Result<Spectrum, FormatError> {
    if bytes.len() > LONGEST {
        return Err(FormatError::whole(format!("more than {LONGEST} bytes: no spectrum's file")));
    }
    let text = decoded(bytes)?;
    if !text.trim_start().starts_with('<') {
        return Spectrum::of(read_text(&text, name)?);
    }
    if tm33::looks_like(text.as_bytes()) { of_luminaire(&text, name) } else { spdx::read(&text, name) }
}

/// The first spectrum of a TM-33 luminaire.
fn of_luminaire(text: &str, name: &str) -> Result<Spectrum, FormatError> {
    let found = tm33::spectra(text.as_bytes())?;
    let count = found.len();
    let first = found.into_iter().next().ok_or_else(|| FormatError::whole("no spectrum"))?;
    let mut spectrum = Spectrum::of(first)?;
    if spectrum.name.is_empty() {
        name.clone_into(&mut spectrum.name);
    }
    if count > 1 {
        spectrum.notes.insert(0, format!("1 of {count} spectra is read"));
    }
    Ok(spectrum)
}

/// UTF-8, UTF-16 with its mark as spreadsheets write it, else Latin-1.
fn decoded(bytes: &[u8]) -> Result<String, FormatError> {
    let wide = |unit: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    let text: String = match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => String::from_utf8_lossy(rest).into_owned(),
        _ => std::str::from_utf8(bytes).map_or_else(|_| bytes.iter().map(|byte| char::from(*byte)).collect(), str::to_owned),
    };
    match text.find('\0') {
        Some(at) => Err(FormatError::byte(at as u64, "a zero byte: no text, expected lines of nm and power or TM-27's XML")),
        None => Ok(text),
    }
}

/// What a line holds between commas, semicolons, tabs and blanks.
fn cells(line: &str) -> Vec<&str> {
    line.split([',', ';', '\t', ' ']).map(str::trim).filter(|cell| !cell.is_empty()).collect()
}
