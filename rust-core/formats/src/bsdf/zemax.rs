//! Zemax's tabular BSDF, the "BSDF Data Interchange" format of Radiant Imaging: reflection or transmission over angles about the specular
//! direction, on explicit lists of angles.
//!
//! Numbers are 1/sr, without the cosine; the total integrated scatter (`TIS`) that stands before each block is only checked to be a
//! number, and written as the table's own integral. `PlaneSymmetrical` data has azimuths from 0° to 180°.

use core::f64::consts::TAU;
use core::fmt::Write;

use super::axis::{Axis, Mode, degrees};
use super::colour::Channels;
use super::coordinates::Coordinates;
use super::hemispheres::Hemispheres;
use super::table::{Layout, Table};
use super::text::{Words, shown};
use crate::error::{FormatError, Result};

/// The header's lists of angles, in the order of the table's axes.
const AXES: [&str; 4] = ["SampleRotation", "AngleOfIncidence", "ScatterAzimuth", "ScatterRadial"];

/// Whether a text looks like such a file: its first line that is no comment begins with one of the header's words.
pub(crate) fn is_zemax(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    let word = first.and_then(|line| line.split_whitespace().next()).unwrap_or("");
    ["Source", "Symmetry", "SpectralContent", "ScatterType"].iter().any(|name| word.eq_ignore_ascii_case(name))
}

/// The text with all comment lines made empty, so that lines keep their numbers.
fn without_comments(text: &str) -> String {
    let line = |line: &str| if line.trim_start().starts_with('#') { "\n".into() } else { line.to_owned() + "\n" };
    text.lines().map(line).collect()
}

/// What the header says.
struct Header {
    bilateral: bool,
    channels: Channels,
    hemispheres: Hemispheres,
    angles_deg: [Vec<f64>; 4],
}

/// Reads a file.
///
/// # Errors
/// When a word of the header is not known, a list of angles does not increase, or numbers are missing, negative or no numbers.
pub fn read(text: &str) -> Result<Table> {
    let text = without_comments(text);
    let mut words = Words::new(&text, 1);
    let header = header(&mut words)?;
    let axes = header.axes(words.line())?;
    let bilateral = header.bilateral;
    let layout = Layout {
        coordinates: Coordinates::Specular,
        axes,
        channels: header.channels,
        hemispheres: header.hemispheres,
        reciprocal: false,
        bilateral,
    };
    let channels = layout.channels.count();
    // Each number is at least a digit and a separator.
    let count = layout.value_count()?;
    if count > words.bytes_left() / 2 + 1 {
        return Err(FormatError::line(words.line(), format!("{} bytes left, expected {count} numbers", words.bytes_left())));
    }
    let cells = count / channels;
    let blocks = header.angles_deg[0].len() * header.angles_deg[1].len();
    let mut values = vec![0.0; count];
    for channel in 0..channels {
        begin(&mut words)?;
        for block in 0..blocks {
            expect(&mut words, "TIS")?;
            words.number("the total integrated scatter")?;
            for cell in block * (cells / blocks)..(block + 1) * (cells / blocks) {
                let value = words.number("a BSDF value")?;
                if !(value.is_finite() && value >= 0.0) {
                    return Err(FormatError::line(words.line(), format!("value {value}, expected zero or more")));
                }
                values[cell * channels + channel] = value as f32;
            }
        }
        expect(&mut words, "DataEnd")?;
    }
    Table::new(layout, values)
}

/// Reads up to the radial angles.
fn header(words: &mut Words<'_>) -> Result<Header> {
    let mut bilateral = None;
    let mut channels = Channels::Luminance;
    let mut hemispheres = Hemispheres::ReflectionFront;
    let mut angles: [Option<Vec<f64>>; 4] = [None, None, None, None];
    while angles.iter().any(Option::is_none) {
        let Some(word) = words.word() else {
            return Err(FormatError::line(words.line(), "the text ends inside the header"));
        };
        let word = word.to_ascii_lowercase();
        if let Some(axis) = AXES.iter().position(|name| name.eq_ignore_ascii_case(&word)) {
            let count = words.number("a number of angles")?;
            if !(count >= 1.0 && count.fract() == 0.0) {
                return Err(FormatError::line(words.line(), format!("{count} angles, expected a whole number from 1 on")));
            }
            angles[axis] = Some(words.numbers(count as usize, "an angle in degrees")?);
            continue;
        }
        let value = words.word().unwrap_or("").to_ascii_lowercase();
        match (word.as_str(), value.as_str()) {
            ("source", _) => {}
            ("symmetry", "planesymmetrical") => bilateral = Some(true),
            ("symmetry", "asymmetrical" | "asymmetrical4d") => bilateral = Some(false),
            ("spectralcontent", "monochrome") => channels = Channels::Luminance,
            ("spectralcontent", "xyz" | "tristimulus") => channels = Channels::Xyz,
            ("scattertype", "brdf") => hemispheres = Hemispheres::ReflectionFront,
            ("scattertype", "btdf") => hemispheres = Hemispheres::TransmissionFront,
            _ => return Err(FormatError::line(words.line(), format!("\"{} {}\" in the header is not known", shown(&word), shown(&value)))),
        }
    }
    let bilateral = bilateral.ok_or_else(|| FormatError::line(words.line(), "no Symmetry in the header"))?;
    Ok(Header { bilateral, channels, hemispheres, angles_deg: angles.map(Option::unwrap_or_default) })
}

impl Header {
    /// The table's axes.
    fn axes(&self, line: u64) -> Result<Vec<Axis>> {
        let mut axes = Vec::new();
        for (i, list) in self.angles_deg.iter().enumerate() {
            let radians = list.iter().map(|d| d.to_radians()).collect();
            let axis = Axis::new(radians, self.mode(i));
            axes.push(axis.map_err(|error| FormatError::line(line, format!("{}: {}", AXES[i], error.problem)))?);
        }
        Ok(axes)
    }

    /// Rotations and azimuths of a full turn are periodic, unless the list repeats its first angle itself.
    fn mode(&self, axis: usize) -> Mode {
        let list = &self.angles_deg[axis];
        let span = list[list.len() - 1] - list[0];
        let is_turn = axis == 0 || axis == 2 && !self.bilateral;
        if is_turn && list.len() > 1 && span > 180.0 && span < 359.999 { Mode::Periodic { period: TAU } } else { Mode::Linear }
    }
}

/// The name of the channel and the beginning of its data.
fn begin(words: &mut Words<'_>) -> Result<()> {
    let name = words.word().unwrap_or("");
    if !name.eq_ignore_ascii_case("Monochrome") && !name.to_ascii_lowercase().starts_with("tristimulus") {
        return Err(FormatError::line(words.line(), format!("\"{}\", expected Monochrome or Tristimulus", shown(name))));
    }
    expect(words, "DataBegin")
}

fn expect(words: &mut Words<'_>, word: &str) -> Result<()> {
    let found = words.word().unwrap_or("");
    if found.eq_ignore_ascii_case(word) {
        return Ok(());
    }
    Err(FormatError::line(words.line(), format!("\"{}\", expected {word}", shown(found))))
}

/// The file of a table over angles about the specular direction.
///
/// # Errors
/// When the table has other coordinates, bands or RGB, or comes from the back.
pub fn write(table: &Table) -> Result<String> {
    let layout = table.layout();
    let names: &[&str] = match layout.channels {
        Channels::Luminance => &["Monochrome"],
        Channels::Xyz => &["TristimulusX", "TristimulusY", "TristimulusZ"],
        _ => return Err(FormatError::whole("only luminance and XYZ can be written as Zemax")),
    };
    if layout.coordinates != Coordinates::Specular || !layout.hemispheres.is_from_front() {
        return Err(FormatError::whole("only a table over angles about the specular direction, from the front, can be written as Zemax"));
    }
    let rotations = layout.axes[0].knots().len();
    let symmetry = match (layout.bilateral, rotations) {
        (true, _) => "PlaneSymmetrical",
        (false, 1) => "Asymmetrical",
        (false, _) => "Asymmetrical4D",
    };
    let content = if names.len() == 1 { "Monochrome" } else { "XYZ" };
    let kind = if layout.hemispheres.is_reflection() { "BRDF" } else { "BTDF" };
    let mut text = format!("Source  Measured\nSymmetry  {symmetry}\nSpectralContent  {content}\nScatterType  {kind}\n");
    for (name, axis) in AXES.iter().zip(&layout.axes) {
        let angles: Vec<String> = axis.knots().iter().map(|&x| degrees(x).to_string()).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name}  {}\n{}", angles.len(), angles.join("\t"));
    }
    for (channel, name) in names.iter().enumerate() {
        let _ = writeln!(text, "\n{name}\nDataBegin");
        blocks(table, channel, names.len(), &mut text);
        text.push_str("DataEnd\n");
    }
    Ok(text)
}

/// One channel's blocks: for each rotation and incidence the total, then a line of radial values for each azimuth.
fn blocks(table: &Table, channel: usize, channels: usize, text: &mut String) {
    let axes = &table.layout().axes;
    let (azimuths, radials) = (axes[2].knots().len(), axes[3].knots().len());
    let incidences = axes[1].knots();
    for (i, block) in table.values().chunks_exact(azimuths * radials * channels).enumerate() {
        let value = |v: &f32| if v.is_nan() { 0.0 } else { *v };
        let place = [axes[0].knots()[i / incidences.len()], incidences[i % incidences.len()], 0.0, 0.0];
        let (wi, _) = table.layout().coordinates.directions(&place);
        let _ = writeln!(text, "TIS {:.6}", table.total(wi, channel));
        for line in block.chunks_exact(radials * channels) {
            let numbers: Vec<String> = line.iter().skip(channel).step_by(channels).map(|v| format!("{:e}", value(v))).collect();
            let _ = writeln!(text, "{}", numbers.join("\t"));
        }
    }
}
