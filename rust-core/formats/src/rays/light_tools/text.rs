//! The text form: lines of words, a line for each ray, and a word at the end.

use super::Head;
use crate::error::{FormatError, Result};
use crate::photometry::text::{Lines, decode, parse, quote};
use crate::rays::{LengthUnit, RayFile, RayFormat};

/// Words for units of length.
const UNITS: [(&str, LengthUnit); 7] = [
    ("millimeters", LengthUnit::Millimetres),
    ("centimeters", LengthUnit::Centimetres),
    ("meters", LengthUnit::Metres),
    ("inches", LengthUnit::Inches),
    ("feet", LengthUnit::Feet),
    ("microns", LengthUnit::Micrometres),
    ("nanometers", LengthUnit::Nanometres),
];

/// Reads text ray data.
///
/// # Errors
/// A word that is not known, a line that is no ray, or no end (unless `lenient`).
pub fn read(bytes: &[u8], lenient: bool) -> Result<RayFile> {
    let text = decode(bytes)?;
    let mut lines = Lines::new(&text);
    let (head, name) = head(&mut lines)?;
    let mut collector = head.collector(0);
    collector.describe(&name);
    let (mut values, mut rays, mut ended) = (vec![0.0_f32; head.width()], 0_u64, false);
    for (number, line) in lines {
        let line = line.trim();
        if line.starts_with("lt_endofdata") {
            ended = true;
            break;
        }
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let words = line.split_whitespace();
        let count = words.clone().count();
        if count != values.len() {
            if lenient {
                break;
            }
            return Err(FormatError::line(number, format!("{count} numbers, expected {} of a ray", values.len())));
        }
        values.iter_mut().zip(words).for_each(|(value, word)| *value = word.parse().unwrap_or(f32::NAN));
        head.push(&mut collector, &values);
        rays += 1;
    }
    if !ended {
        let problem = format!("{rays} rays are there, but no lt_endofdata behind them");
        if !lenient {
            return Err(FormatError::whole(format!("{problem}: the file is cut off")));
        }
        collector.warn(problem);
    }
    head.finish(collector)
}

/// The lines before the rays, and the name of the data.
fn head(lines: &mut Lines<'_>) -> Result<(Head, String)> {
    let mut head = Head {
        format: RayFormat::LightToolsText,
        lumens: false,
        far_field: false,
        wavelengths: false,
        unit: LengthUnit::Millimetres,
        origin: [0.0; 3],
        flux: 0.0,
    };
    let mut name = String::new();
    for (number, line) in lines {
        let line = line.trim();
        if line.starts_with("lt_startofdata") {
            return Ok((head, name));
        }
        let Some((key, value)) = line.split_once(':').map(|(key, value)| (key.trim(), value.trim())) else { continue };
        let unknown = |expected: &str| Err(FormatError::line(number, format!("{key} is {}, expected {expected}", quote(value))));
        match key {
            "dataname" => name = value.to_owned(),
            "lt_datatype" if ["luminous_flux", "luminous_power"].contains(&value) => head.lumens = true,
            "lt_datatype" if ["radiant_power", "radiant_flux"].contains(&value) => head.lumens = false,
            "lt_datatype" => return unknown("luminous_flux or radiant_power"),
            "lt_far_field_data" if ["yes", "no"].contains(&value) => head.far_field = value == "yes",
            "lt_far_field_data" => return unknown("yes or no"),
            "lt_color_info" if ["none", "wavelength"].contains(&value) => head.wavelengths = value == "wavelength",
            "lt_color_info" => return unknown("none or wavelength"),
            "lt_length_units" => match UNITS.iter().find(|(known, _)| *known == value) {
                Some((_, unit)) => head.unit = *unit,
                None => return unknown("a unit of length such as millimeters"),
            },
            "lt_data_origin" => {
                let parts = value.split_whitespace().filter_map(parse);
                head.origin.iter_mut().zip(parts).for_each(|(origin, part)| *origin = part as f32);
            }
            "lt_radiant_flux" | "lt_luminous_flux" => head.flux = parse(value).unwrap_or(0.0),
            _ => {}
        }
    }
    Err(FormatError::whole("the file ends, expected lt_startofdata"))
}
