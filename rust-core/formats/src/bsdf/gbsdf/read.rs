//! Reading `.gbsdf`.

use super::super::axis::{Axis, Mode};
use super::super::bytes::{doubles, floats};
use super::super::colour::Channels;
use super::super::coordinates::Coordinates;
use super::super::hemispheres::Hemispheres;
use super::super::table::{Layout, Table};
use super::super::text::shown;
use super::MAGIC;
use super::scan::Scan;
use crate::error::Result;

/// Reads a file's tables.
///
/// # Errors
/// When a word is not known, a table is not complete, axes do not increase, or values are missing, negative or infinite.
pub fn read(bytes: &[u8]) -> Result<Vec<Table>> {
    let mut scan = Scan::new(bytes);
    for expected in MAGIC.split(' ') {
        let found = scan.word().unwrap_or("");
        if found != expected {
            return Err(scan.error(format!("\"{}\", expected \"{MAGIC}\"", shown(found))));
        }
    }
    let mut tables: Vec<Table> = Vec::new();
    while let Some(word) = scan.word() {
        match word {
            "title" => drop(scan.rest_of_line()),
            "table" => {
                let table = table(&mut scan)?;
                if tables.iter().any(|t| t.layout().hemispheres == table.layout().hemispheres) {
                    return Err(scan.error(format!("a second table for {}", table.layout().hemispheres.name())));
                }
                if tables.iter().any(|t| t.layout().channels != table.layout().channels) {
                    return Err(scan.error("a table with other channels than the first one's"));
                }
                tables.push(table);
            }
            other => return Err(scan.error(format!("\"{}\", expected title or table", shown(other)))),
        }
    }
    if tables.is_empty() { Err(scan.error("the file ends without a table")) } else { Ok(tables) }
}

/// A table from its hemispheres to `end`.
fn table(scan: &mut Scan<'_>) -> Result<Table> {
    let hemispheres = known(scan, "a pair of hemispheres such as reflection-front", Hemispheres::from_name)?;
    let coordinates = known(scan, "isotropic, anisotropic, half-difference or specular", Coordinates::from_name)?;
    let mut layout =
        Layout { coordinates, axes: Vec::new(), channels: Channels::Luminance, hemispheres, reciprocal: false, bilateral: false };
    loop {
        match scan.expect_word("axis, channels, reciprocal, bilateral or values")? {
            "reciprocal" => layout.reciprocal = known(scan, "yes or no", yes_or_no)?,
            "bilateral" => layout.bilateral = known(scan, "yes or no", yes_or_no)?,
            "channels" => layout.channels = channels(scan)?,
            "axis" => {
                let axis = axis(scan, &layout)?;
                layout.axes.push(axis);
            }
            "values" => break,
            other => return Err(scan.error(format!("\"{}\", expected axis, channels, reciprocal, bilateral or values", shown(other)))),
        }
    }
    let count = layout.value_count().map_err(|error| scan.error(error.problem))?;
    let values = values(scan, count)?;
    match scan.word() {
        Some("end") => Table::new(layout, values).map_err(|error| scan.error(error.problem)),
        other => Err(scan.error(format!("\"{}\", expected end after {count} values", shown(other.unwrap_or(""))))),
    }
}

/// The next axis: its name, what happens between knots, their number, and they in degrees.
fn axis(scan: &mut Scan<'_>, layout: &Layout) -> Result<Axis> {
    let name = scan.expect_word("an axis's name")?;
    let names = layout.coordinates.axis_names();
    if names.get(layout.axes.len()) != Some(&name) {
        let expected = names.get(layout.axes.len()).copied().unwrap_or("no further axis");
        return Err(scan.error(format!("axis \"{}\", expected {expected}", shown(name))));
    }
    let mode = match scan.expect_word("linear, nearest or periodic")? {
        "linear" => Mode::Linear,
        "nearest" => Mode::Nearest,
        "periodic" => Mode::Periodic { period: scan.number("a period in degrees")?.to_radians() },
        other => return Err(scan.error(format!("\"{}\", expected linear, nearest or periodic", shown(other)))),
    };
    let count = scan.count("a number of angles", 2)?;
    let angles = scan.numbers(count, "an angle in degrees")?;
    Axis::new(angles.iter().map(|d| d.to_radians()).collect(), mode).map_err(|error| scan.error(format!("{name}: {}", error.problem)))
}

fn channels(scan: &mut Scan<'_>) -> Result<Channels> {
    match scan.expect_word("luminance, rgb, xyz or bands")? {
        "luminance" => Ok(Channels::Luminance),
        "rgb" => Ok(Channels::Rgb),
        "xyz" => Ok(Channels::Xyz),
        "bands" => {
            let count = scan.count("a number of bands", 2)?;
            let wavelengths = scan.numbers(count, "a wavelength in nm")?;
            Channels::bands(wavelengths).map_err(|error| scan.error(error.problem))
        }
        other => Err(scan.error(format!("\"{}\", expected luminance, rgb, xyz or bands", shown(other)))),
    }
}

/// The values in the encoding that the next word names.
fn values(scan: &mut Scan<'_>, count: usize) -> Result<Vec<f32>> {
    match scan.expect_word("text, f32 or f64")? {
        "text" => {
            if count > scan.bytes_left() / 2 + 1 {
                return Err(scan.error(format!("{} bytes left, expected {count} values", scan.bytes_left())));
            }
            (0..count).map(|_| Ok(scan.number("a value in 1/sr")? as f32)).collect()
        }
        "f32" => Ok(floats(scan.raw(count, 4)?).collect()),
        "f64" => Ok(doubles(scan.raw(count, 8)?).map(|x| x as f32).collect()),
        other => Err(scan.error(format!("\"{}\", expected text, f32 or f64", shown(other)))),
    }
}

fn known<T>(scan: &mut Scan<'_>, what: &str, find: impl Fn(&str) -> Option<T>) -> Result<T> {
    let word = scan.expect_word(what)?;
    find(word).ok_or_else(|| scan.error(format!("\"{}\", expected {what}", shown(word))))
}

fn yes_or_no(word: &str) -> Option<bool> {
    match word {
        "yes" => Some(true),
        "no" => Some(false),
        _ => None,
    }
}
