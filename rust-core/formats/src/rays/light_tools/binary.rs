//! The binary form: a head of 44 bytes, the rays, and a mark at the end.

use super::Head;
use crate::bsdf::bytes::{Cursor, floats};
use crate::error::{FormatError, Result};
use crate::rays::{LengthUnit, RayFile, RayFormat};

/// What a file begins and ends with.
const MAGIC: &[u8] = b"LTRF";
const END: &[u8] = b"LTRFEND";

/// Units of length by their number; 0 is whatever the model had.
const UNITS: [LengthUnit; 8] = [
    LengthUnit::Millimetres,
    LengthUnit::Millimetres,
    LengthUnit::Centimetres,
    LengthUnit::Metres,
    LengthUnit::Inches,
    LengthUnit::Feet,
    LengthUnit::Micrometres,
    LengthUnit::Nanometres,
];

/// Reads binary ray data. The head has no count: the mark at the end says that nothing is missing.
///
/// # Errors
/// A head of another kind, or no mark behind a whole number of rays (unless `lenient`).
pub fn read(bytes: &[u8], lenient: bool) -> Result<RayFile> {
    let mut cursor = Cursor::new(bytes);
    if cursor.take(MAGIC.len(), "the signature")? != MAGIC {
        return Err(FormatError::byte(0, "not LightTools ray data: it does not begin with LTRF"));
    }
    let (head, system) = head(&mut cursor)?;
    let stride = 4 * head.width();
    let rest = cursor.rest();
    let body = rest.strip_suffix(END);
    let rays = body.unwrap_or(rest).len() / stride;
    let whole = body.is_some_and(|body| body.len() % stride == 0);
    if !whole && (!lenient || rays == 0) {
        let problem = format!("{rays} whole rays are there, but no mark of the end behind them: the file is cut off or damaged");
        return Err(FormatError::byte(bytes.len() as u64, problem));
    }
    let mut collector = head.collector(rays);
    if !whole {
        collector.warn(format!("{rays} whole rays are there, but no mark of the end behind them"));
    }
    if system {
        collector.warn("the unit of length is the model's own: millimetres are taken".into());
    }
    let mut values = Vec::with_capacity(head.width());
    for ray in body.unwrap_or(rest).chunks_exact(stride) {
        values.clear();
        values.extend(floats(ray));
        head.push(&mut collector, &values);
    }
    head.finish(collector)
}

/// The head, and whether its unit of length is the model's own.
fn head(cursor: &mut Cursor<'_>) -> Result<(Head, bool)> {
    let mut one_of = |what: &str, most: u32| -> Result<u32> {
        let at = cursor.at();
        let value = cursor.u32(what)?;
        if value > most {
            return Err(FormatError::byte(at, format!("{what} is {value}, expected 0 to {most}")));
        }
        Ok(value)
    };
    let version = one_of("the version", 3)?;
    one_of("the minor version", u32::MAX)?;
    let lumens = one_of("the kind of flux", 1)? == 1;
    let far_field = one_of("the kind of field", 1)? == 1;
    let colour = one_of("the kind of colour", 2)?;
    let unit = one_of("the unit of length", UNITS.len() as u32 - 1)?;
    let mut origin = [0.0; 3];
    for part in &mut origin {
        *part = cursor.f32("the origin")?;
    }
    let flux = f64::from(cursor.f32("the flux")?);
    let polarised = version == 3 && cursor.u32("the polarisation")? != 0;
    if colour == 1 || polarised {
        return Err(FormatError::whole("LightTools ray data with tristimulus values or polarisation are not read: export TM-25"));
    }
    let head =
        Head { format: RayFormat::LightTools, lumens, far_field, wavelengths: colour == 2, unit: UNITS[unit as usize], origin, flux };
    Ok((head, unit == 0))
}
