//! The writer.

use crate::photometry::text::{encode, number, one_line};
use crate::photometry::{Goniogram, PhotometricType, Symmetry, Tilt};
use std::fmt::Write;

/// Characters in a line; LM-63-1995 allows 132.
const WIDTH: usize = 120;

/// Keywords that LM-63-2002 requires.
const REQUIRED: [&str; 4] = ["TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"];

/// Writes LM-63-2002 in metres, in the goniogram's own photometric type and symmetry, ISO 8859-1.
///
/// All factors are in the candela; numbers have ten digits. A goniogram without symmetry gets its planes at 0 and 360.
pub fn write(goniogram: &Goniogram) -> Vec<u8> {
    written(goniogram, "IESNA:LM-63-2002", "1")
}

/// How the intensities of an LM-63-2019 file came about: the code in the place that earlier revisions keep for the future.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Generation {
    /// Nobody says.
    #[default]
    Undefined,
    /// By a computer's simulation.
    Simulation,
}

impl Generation {
    fn code(self) -> &'static str {
        match self {
            Self::Undefined => "1.00001",
            Self::Simulation => "1.00010",
        }
    }
}

/// The same as LM-63-2019.
pub fn write_2019(goniogram: &Goniogram, generation: Generation) -> Vec<u8> {
    written(goniogram, "IES:LM-63-2019", generation.code())
}

fn written(goniogram: &Goniogram, version: &str, future: &str) -> Vec<u8> {
    let mut text = format!("{version}\n");
    header(&mut text, goniogram);
    tilt(&mut text, goniogram.tilt.as_ref());
    let circle = goniogram.photometric_type == PhotometricType::C && goniogram.symmetry == Symmetry::None;
    let expanded = circle.then(|| goniogram.expanded());
    let (horizontal, intensities) = match &expanded {
        Some(grid) => (&grid.horizontal, &grid.intensities),
        None => (&goniogram.horizontal, &goniogram.intensities),
    };
    head(&mut text, goniogram, horizontal.len(), future);
    list(&mut text, &goniogram.vertical);
    list(&mut text, horizontal);
    intensities.chunks(goniogram.vertical.len().max(1)).for_each(|plane| list(&mut text, plane));
    encode(&text)
}

fn header(text: &mut String, goniogram: &Goniogram) {
    for keyword in REQUIRED.iter().filter(|keyword| goniogram.header.iter().all(|line| !line.keyword.eq_ignore_ascii_case(keyword))) {
        // Writing to a string cannot fail, here and below.
        let _ = writeln!(text, "[{keyword}] N/A");
    }
    for line in &goniogram.header {
        let plain = !line.keyword.is_empty() && line.keyword.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let keyword = if plain { line.keyword.as_str() } else { "OTHER" };
        let _ = writeln!(text, "[{keyword}] {}", one_line(&line.text));
    }
}

fn tilt(text: &mut String, tilt: Option<&Tilt>) {
    let Some(tilt) = tilt else {
        text.push_str("TILT=NONE\n");
        return;
    };
    let _ = writeln!(text, "TILT=INCLUDE\n{}\n{}", tilt.lamp_to_luminaire, tilt.angles.len());
    list(text, &tilt.angles);
    list(text, &tilt.factors);
}

fn head(text: &mut String, goniogram: &Goniogram, planes: usize, future: &str) {
    let lamps = goniogram.lamps();
    let count = lamps.map_or(1, |lamps| lamps.count.max(1));
    let flux = lamps.filter(|lamps| !lamps.absolute).and_then(|lamps| lamps.flux);
    let lumens = flux.map_or(-1.0, |flux| flux / f64::from(count));
    let photometric_type = match goniogram.photometric_type {
        PhotometricType::C => 1,
        PhotometricType::B => 2,
        PhotometricType::A => 3,
    };
    let [width, length, height] = goniogram.opening.lm63().map(number);
    let vertical = goniogram.vertical.len();
    let lumens = number(lumens);
    let _ = writeln!(text, "{count} {lumens} 1 {vertical} {planes} {photometric_type} 2 {width} {length} {height}");
    let _ = writeln!(text, "1 {future} {}", number(lamps.map_or(0.0, |lamps| lamps.watts)));
}

/// Numbers in lines of a bounded length.
fn list(text: &mut String, values: &[f64]) {
    let mut length = 0;
    for value in values.iter().map(|value| number(*value)) {
        if length > 0 && length + value.len() >= WIDTH {
            text.push('\n');
            length = 0;
        } else if length > 0 {
            text.push(' ');
        }
        length += value.len() + 1;
        text.push_str(&value);
    }
    text.push('\n');
}
