//! Lines of wavelength and power: commas, semicolons, tabs or blanks between numbers, decimal commas where these leave them free.

use super::{MOST, SpectralPoint, SpectralPower, quoted};
use crate::error::{FormatError, Result};

/// What begins a comment.
const COMMENTS: [&str; 4] = ["#", "%", "//", "!"];

/// What a line holds.
enum Line<'a> {
    /// Wavelength, power, and the columns that follow.
    Numbers { nm: f64, power: f64, more: usize },
    /// Words: a header or the file's end.
    Words,
    /// A wavelength with something else beside it.
    Broken(&'a str),
    /// Commas that may stand between numbers or within them.
    Unclear,
}

/// Reads lines of wavelength in nm and power. `name` is what it is called.
///
/// # Errors
/// What is no such text, and what [`SpectralPower::new`] refuses, with the line.
pub fn read_text(text: &str, name: &str) -> Result<SpectralPower> {
    let mut points: Vec<SpectralPoint> = Vec::new();
    // The first words behind numbers: a file may end with some.
    let mut words: Option<(u64, &str)> = None;
    let mut more = 0;
    for (number, line) in (1_u64..).zip(text.lines()) {
        let bare = line.trim();
        if bare.is_empty() || COMMENTS.iter().any(|mark| bare.starts_with(mark)) {
            continue;
        }
        match understood(bare) {
            Line::Numbers { nm, power, more: columns } => {
                if let Some((at, text)) = words {
                    return Err(FormatError::line(at, format!("{} amid the numbers, expected wavelength in nm and power", quoted(text))));
                }
                points.push(SpectralPoint { nm, power, line: Some(number) });
                more = more.max(columns);
                if points.len() > MOST {
                    return Err(FormatError::line(number, format!("more than {MOST} points: no spectrum of a lamp")));
                }
            }
            Line::Words if points.is_empty() => {}
            Line::Words => {
                words.get_or_insert((number, bare));
            }
            Line::Broken(text) => {
                return Err(FormatError::line(number, format!("{} is no number, expected the power beside the wavelength", quoted(text))));
            }
            Line::Unclear => {
                let problem = "commas may stand between numbers or within them here: put semicolons, tabs or blanks between the numbers";
                return Err(FormatError::line(number, format!("{}: {problem}", quoted(bare))));
            }
        }
    }
    if points.is_empty() {
        return Err(FormatError::whole("no line of wavelength in nm and power; expected such lines or TM-27's XML"));
    }
    let mut spectrum = SpectralPower::new(name, &points)?;
    if more > 0 {
        let last = more + 2;
        let which = if more == 1 { "column 3 is".to_owned() } else { format!("columns 3 to {last} are") };
        spectrum.notes.insert(0, format!("the second column is the spectrum, {which} left out"));
    }
    Ok(spectrum)
}

/// The line's cells, and whether a comma is a decimal point in them.
fn cells(line: &str) -> Option<(Vec<&str>, bool)> {
    let split = |mark: char| line.split(mark).map(|cell| cell.trim().trim_matches('"').trim()).collect::<Vec<_>>();
    if line.contains(';') {
        return Some((split(';'), true));
    }
    if line.contains('\t') {
        return Some((split('\t'), true));
    }
    if !line.contains(',') {
        return Some((line.split_whitespace().collect(), true));
    }
    let blank: Vec<&str> = line.split_whitespace().collect();
    let decimal = |cell: &&str| number(cell, true).is_some() && !cell.ends_with(',') && !cell.starts_with(',');
    if blank.len() >= 2 && blank.iter().all(decimal) && !line.contains('.') {
        return Some((blank, true));
    }
    let cells = split(',');
    // 380,5,0,12 has two numbers or four.
    let whole = |cell: &&str| !cell.is_empty() && cell.bytes().all(|byte| byte.is_ascii_digit());
    if cells.len() > 2 && cells.iter().all(whole) { None } else { Some((cells, false)) }
}

fn number(cell: &str, decimal_comma: bool) -> Option<f64> {
    if decimal_comma && cell.contains(',') && !cell.contains('.') {
        return cell.replacen(',', ".", 1).parse().ok();
    }
    cell.parse().ok()
}

fn understood(line: &str) -> Line<'_> {
    let Some((cells, comma)) = cells(line) else { return Line::Unclear };
    let Some(nm) = cells.first().and_then(|cell| number(cell, comma)) else { return Line::Words };
    let Some(second) = cells.get(1).filter(|cell| !cell.is_empty()) else { return Line::Broken(line) };
    match number(second, comma) {
        Some(power) => Line::Numbers { nm, power, more: cells[2..].iter().filter(|cell| !cell.is_empty()).count() },
        // A title such as "400 W lamp" is words; a cell that a mark divides off is meant as a number.
        None if line.contains([',', ';', '\t']) => Line::Broken(second),
        None => Line::Words,
    }
}
