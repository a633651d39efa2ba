//! The reader.

use super::{COLUMN_NAME, MAGIC, PADDING, RESERVED, TEXT, TEXTS};
use crate::bsdf::bytes::{Cursor, floats};
use crate::error::{FormatError, Result};
use crate::rays::collect::{Collector, StatedFlux, count, is_wavelength};
use crate::rays::{FluxUnit, LengthUnit, RayColour, RayFile, RayFormat, Spectrum};

/// The numbers of the head that are used.
struct Head {
    lumens: f32,
    watts: f32,
    rays: u64,
    spectral: i32,
    wavelength: f32,
    spectra: usize,
    further: usize,
    text: usize,
}

/// Where in a ray each kind of number stands; `None` where there is none.
struct Columns {
    watts: Option<usize>,
    wavelength: Option<usize>,
    lumens: Option<usize>,
    tristimulus: Option<usize>,
    spectrum: Option<usize>,
    all: usize,
}

/// Reads a TM-25 file. Polarisation and further columns are not read.
///
/// # Errors
/// A head that contradicts itself, or fewer rays than it states (unless `lenient`).
pub fn read(bytes: &[u8], lenient: bool) -> Result<RayFile> {
    let mut cursor = Cursor::new(bytes);
    let head = head(&mut cursor)?;
    let mut columns = columns(&mut cursor)?;
    let texts = (0..TEXTS).map(|_| Ok(characters(cursor.take(TEXT, "the texts")?))).collect::<Result<Vec<String>>>()?;
    let spectra = spectra(&mut cursor, head.spectra)?;
    cursor.take(head.further.saturating_mul(COLUMN_NAME), "the names of further columns")?;
    cursor.take(head.text, "the text")?;
    columns.all += head.further;
    let stride = columns.all.checked_mul(4).ok_or_else(|| FormatError::whole("too many columns"))?;
    let (rays, warning) = count(head.rays, stride, cursor.rest().len(), lenient)?;
    let kind = Kind::of(&head, &columns, spectra)?;
    let mut collector = Collector::new(RayFormat::Tm25, LengthUnit::Millimetres, rays);
    warning.into_iter().for_each(|warning| collector.warn(warning));
    let known = |text: &&String| !["", "unknown", "none", "n/a"].contains(&text.trim().to_ascii_lowercase().as_str());
    let description: Vec<&str> = texts.iter().take(2).filter(known).map(|text| text.trim()).collect();
    collector.describe(&description.join(", "));
    let in_lumens = columns.lumens.is_some();
    let flux = columns.lumens.or(columns.watts).unwrap_or(0);
    let mut values = Vec::with_capacity(columns.all);
    for ray in cursor.rest().chunks_exact(stride).take(rays) {
        values.clear();
        values.extend(floats(ray));
        let mut own = [0.0; 7];
        own[..6].copy_from_slice(&values[..6]);
        own[6] = values[flux];
        let (extra, width) = kind.extra(&columns, &values);
        collector.push(&own, &extra[..width]);
    }
    let colour = kind.colour(collector.take_extra())?;
    let unit = if in_lumens { FluxUnit::Lumens } else { FluxUnit::Watts };
    let [lumens, watts] = [head.lumens, head.watts].map(|flux| Some(f64::from(flux)).filter(|flux| flux.is_finite()));
    collector.finish(colour, StatedFlux { rays: unit, lumens, watts, exact: true })
}

fn head(cursor: &mut Cursor<'_>) -> Result<Head> {
    if cursor.take(4, "the file type")? != MAGIC.0 {
        return Err(FormatError::byte(0, "not a TM-25 file: it does not begin with TM25"));
    }
    let version = cursor.i32("the version")?;
    if version != MAGIC.1 {
        return Err(FormatError::byte(4, format!("the version is {version}, expected {}", MAGIC.1)));
    }
    cursor.i32("the method of creation")?;
    let (lumens, watts) = (cursor.f32("the luminous flux")?, cursor.f32("the radiant flux")?);
    let rays = cursor.u64("the number of rays")?;
    cursor.take(28 + 4, "the date and the start of rays")?;
    let at = cursor.at();
    let spectral = cursor.i32("the kind of spectral data")?;
    if !(0..=4).contains(&spectral) {
        return Err(FormatError::byte(at, format!("the kind of spectral data is {spectral}, expected 0 to 4")));
    }
    let wavelength = cursor.f32("the wavelength")?;
    cursor.take(2 * 4, "the range of wavelengths")?;
    let mut number = |what: &str| -> Result<usize> {
        let at = cursor.at();
        let value = cursor.i32(what)?;
        usize::try_from(value).map_err(|_| FormatError::byte(at, format!("{what} is {value}, expected 0 or more")))
    };
    let spectra = number("the number of spectra")?;
    let further = number("the number of further columns")?;
    let text = number("the length of the text")?;
    cursor.take(RESERVED, "the head")?;
    Ok(Head { lumens, watts, rays, spectral, wavelength, spectra, further, text })
}

/// The flags: position, direction, radiant flux, wavelength, luminous flux, polarisation, tristimulus values, spectrum.
fn columns(cursor: &mut Cursor<'_>) -> Result<Columns> {
    let mut flags = [false; 8];
    for flag in &mut flags {
        let at = cursor.at();
        let value = cursor.i32("the flags")?;
        if !(0..=1).contains(&value) {
            return Err(FormatError::byte(at, format!("a flag is {value}, expected 0 or 1")));
        }
        *flag = value == 1;
    }
    let [position, direction, radiant, wavelength, luminous, polarised, tristimulus, spectrum] = flags;
    if !(position && direction && (radiant || luminous)) {
        return Err(FormatError::byte(cursor.at(), "rays have no position, direction or flux"));
    }
    let mut all = 6;
    let mut column = |there: bool, width: usize| {
        let at = there.then_some(all);
        all += if there { width } else { 0 };
        at
    };
    let (watts, wavelength, lumens) = (column(radiant, 1), column(wavelength, 1), column(luminous, 1));
    column(polarised, 6);
    let (tristimulus, spectrum) = (column(tristimulus, 2), column(spectrum, 1));
    Ok(Columns { watts, wavelength, lumens, tristimulus, spectrum, all })
}

/// Text in UTF-32 up to the first zero.
fn characters(bytes: &[u8]) -> String {
    let codes = bytes.chunks_exact(4).map(|code| u32::from_le_bytes([code[0], code[1], code[2], code[3]]));
    codes.take_while(|code| *code != 0).map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

fn spectra(cursor: &mut Cursor<'_>, count: usize) -> Result<Vec<Spectrum>> {
    let (start, mut spectra) = (cursor.at(), Vec::new());
    for _ in 0..count {
        let at = cursor.at();
        let pairs = cursor.u32("a spectrum's length")? as usize;
        let values: Vec<f32> = floats(cursor.take(pairs.saturating_mul(8), "a spectrum")?).collect();
        let wavelengths: Vec<f32> = values.iter().step_by(2).copied().collect();
        let weights: Vec<f32> = values.iter().skip(1).step_by(2).copied().collect();
        let sound = wavelengths.iter().all(|wavelength| is_wavelength(*wavelength)) && wavelengths.is_sorted_by(|a, b| a < b);
        if pairs == 0 || !sound || !weights.iter().all(|weight| (0.0..=1e12).contains(weight)) {
            return Err(FormatError::byte(at, "a spectrum's wavelengths do not increase, or its powers are negative or no numbers"));
        }
        spectra.push(Spectrum { wavelengths, weights });
    }
    let length = (cursor.at() - start) as usize;
    cursor.take(length.next_multiple_of(PADDING) - length, "the spectra")?;
    Ok(spectra)
}

/// What colour the rays have.
enum Kind {
    Unknown,
    Wavelength(f32),
    Wavelengths(usize),
    Tristimulus([usize; 2]),
    Spectrum(Spectrum),
    Spectra(usize, Vec<Spectrum>),
}

impl Kind {
    fn of(head: &Head, columns: &Columns, spectra: Vec<Spectrum>) -> Result<Self> {
        let none = |what: &str| FormatError::whole(format!("the head says that rays have {what}, but there is none"));
        Ok(match head.spectral {
            0 => match (columns.tristimulus, columns.lumens) {
                (Some(at), Some(lumens)) => Self::Tristimulus([at, lumens]),
                (Some(_), None) => return Err(none("tristimulus values with a luminous flux")),
                _ => Self::Unknown,
            },
            1 if is_wavelength(head.wavelength) => Self::Wavelength(head.wavelength),
            1 => return Err(none("one wavelength")),
            2 => Self::Wavelengths(columns.wavelength.ok_or_else(|| none("wavelengths"))?),
            3 => Self::Spectrum(spectra.into_iter().next().ok_or_else(|| none("a spectrum"))?),
            _ if spectra.is_empty() => return Err(none("spectra")),
            _ => Self::Spectra(columns.spectrum.ok_or_else(|| none("a spectrum's number"))?, spectra),
        })
    }

    /// The numbers of a ray's colour, and how many they are.
    fn extra(&self, columns: &Columns, values: &[f32]) -> ([f32; 3], usize) {
        debug_assert!(values.len() == columns.all, "a whole ray");
        match self {
            Self::Wavelengths(at) | Self::Spectra(at, _) => ([values[*at], 0.0, 0.0], 1),
            Self::Tristimulus([at, lumens]) => ([values[*at], values[*lumens], values[at + 1]], 3),
            _ => ([0.0; 3], 0),
        }
    }

    fn colour(self, extra: Vec<f32>) -> Result<RayColour> {
        Ok(match self {
            Self::Unknown => RayColour::Unknown,
            Self::Wavelength(wavelength) => RayColour::Wavelength(wavelength),
            Self::Wavelengths(_) => RayColour::Wavelengths(extra),
            Self::Tristimulus(_) => RayColour::Tristimulus(extra.chunks_exact(3).map(|xyz| [xyz[0], xyz[1], xyz[2]]).collect()),
            Self::Spectrum(spectrum) => RayColour::Spectrum(spectrum),
            Self::Spectra(_, spectra) => {
                // Files count from 1.
                let index = |number: &f32| (1.0..=spectra.len() as f32).contains(number).then(|| *number as u32 - 1);
                let index = extra.iter().map(index).collect::<Option<Vec<u32>>>();
                let index = index.ok_or_else(|| FormatError::whole(format!("a ray's spectrum is none of the {}", spectra.len())))?;
                RayColour::Spectra { spectra, index }
            }
        })
    }
}
