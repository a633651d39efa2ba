//! The lamp's flux by the luminaire's tilt: in the file itself (`TILT=INCLUDE`), or in one beside it (`TILT=` and its name).

use super::numbers::{Numbers, by_comma};
use crate::error::{FormatError, Result};
use crate::photometry::Tilt;
use crate::photometry::beside::Beside;
use crate::photometry::text::{Lines, decode, number, quote};

/// What a TILT line asks for. A file beside this one that cannot be used is a warning, and there are no factors.
///
/// # Errors
/// Factors in the file itself that make no sense, with the line.
pub(super) fn tilt(
    word: &str,
    numbers: &mut Numbers<'_>,
    beside: &mut Beside<'_>,
    warnings: &mut Vec<FormatError>,
) -> Result<Option<Tilt>> {
    if word.eq_ignore_ascii_case("NONE") {
        return Ok(None);
    }
    if word.eq_ignore_ascii_case("INCLUDE") {
        return factors(numbers).map(Some);
    }
    let found = file_name(word).ok_or_else(|| ": this is no file's name".to_owned()).and_then(|name| from_file(name, beside));
    let warn = |problem: &String| {
        warnings.push(FormatError::line(numbers.line(), format!("the TILT file {}{problem}; TILT=NONE is taken", quote(word))));
    };
    Ok(found.inspect_err(warn).ok())
}

/// The name that a file beside this one has: folders and drives, which are those of another machine, go.
fn file_name(word: &str) -> Option<&str> {
    word.rsplit(['/', '\\', ':']).next().filter(|name| !["", ".", ".."].contains(name))
}

/// The factors of a file that holds what `TILT=INCLUDE` would have here; a problem continues a sentence that names the file.
fn from_file(name: &str, beside: &mut Beside<'_>) -> std::result::Result<Tilt, String> {
    let bytes = beside(name).map_err(|problem| format!(" cannot be read: {problem}"))?;
    let read = || -> Result<(Tilt, Option<FormatError>)> { by_comma(&Lines::new(&decode(&bytes)?), "tilt factor", factors) };
    // What stands behind the factors is no part of them.
    read().map(|(tilt, _)| tilt).map_err(|error| format!(", {error}"))
}

fn factors(numbers: &mut Numbers<'_>) -> Result<Tilt> {
    let geometry = numbers.next("the lamp-to-luminaire geometry")?;
    if ![1.0, 2.0, 3.0].contains(&geometry) {
        let problem = format!("the lamp-to-luminaire geometry is {}, expected 1, 2 or 3", number(geometry));
        return Err(FormatError::line(numbers.line(), problem));
    }
    let count = numbers.count("tilt angles")?;
    let angles = numbers.axis("tilt angle", count)?;
    if let Some(index) = angles.angles.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(FormatError::line(angles.line(index + 1), "tilt angles do not increase"));
    }
    let mut factors = Vec::with_capacity(count);
    for _ in 0..count {
        let factor = numbers.next("a tilt factor")?;
        if factor < 0.0 {
            return Err(FormatError::line(numbers.line(), format!("a tilt factor is {}, expected 0 or more", number(factor))));
        }
        factors.push(factor);
    }
    Ok(Tilt { lamp_to_luminaire: geometry as u32, angles: angles.angles, factors })
}
