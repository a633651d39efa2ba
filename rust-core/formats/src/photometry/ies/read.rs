//! The reader.

use super::numbers::{Numbers, by_comma};
use super::opening::opening;
use super::tilt::tilt;
use super::{Version, tilt_of};
use crate::error::{FormatError, Result};
use crate::photometry::arrange::arrange;
use crate::photometry::axis::Table;
use crate::photometry::beside::{Beside, nothing_beside};
use crate::photometry::check::Least;
use crate::photometry::plausible;
use crate::photometry::text::{LARGEST, Lines, decode, number};
use crate::photometry::{Goniogram, HeaderLine, LampSet, PhotometricType, Stated};

/// Metres in a foot.
const FOOT: f64 = 0.3048;

/// Header lines that are kept: no file has so many, and a text's record is far longer than an empty line.
const MOST_TEXTS: usize = 4096;

/// What stands between the TILT line and the angles.
struct Head {
    lamps: f64,
    lumens: f64,
    factor: f64,
    counts: [usize; 2],
    photometric_type: PhotometricType,
    /// The opening's width, length and height with their signs, in metres.
    dimensions: [f64; 3],
    dimensions_line: u64,
    /// Metres in the file's unit.
    unit: f64,
    watts: f64,
}

/// Reads an IES LM-63 file of any revision, photometric type and unit.
///
/// Candela are the file's values times its multiplier and ballast factor, and until LM-63-1991 times the ballast-lamp photometric factor;
/// the number of lamps and their lumens never scale them. Text before the `TILT=` line is kept as header lines. Tilt factors are kept and
/// not applied; where they stand in a file beside this one, that is a warning: [`read_with`] gets it.
///
/// # Errors
/// Anything without one sensible reading, with the line.
pub fn read(bytes: &[u8]) -> Result<Goniogram> {
    read_with(bytes, &mut nothing_beside)
}

/// The same, with the files beside it.
///
/// # Errors
/// As [`read`].
pub fn read_with(bytes: &[u8], beside: &mut Beside<'_>) -> Result<Goniogram> {
    let text = decode(bytes)?;
    let mut lines = Lines::new(&text);
    let (version, header, tilt_word) = header(&mut lines)?;
    let read = |numbers: &mut Numbers<'_>| {
        let mut warnings = Vec::new();
        let tilt = tilt(tilt_word, numbers, beside, &mut warnings)?;
        let head = head(version, numbers, &mut warnings)?;
        let table = table(&head, numbers, &mut warnings)?;
        Ok((tilt, head, table, warnings))
    };
    let ((tilt, mut head, mut table, mut warnings), more) = by_comma(&lines, "candela value", read)?;
    warnings.extend(more);
    table.order(&mut warnings)?;
    let symmetry = arrange(&mut table, head.photometric_type, &mut warnings)?;
    warnings.extend(head.mend_dimensions());
    let (opening, own) = opening(head.dimensions, version);
    if !own {
        let dimensions = head.dimensions.map(number).join(", ");
        let problem = format!("the opening's width, length, height {dimensions} m are not of this revision: read as {:?}", opening.shape);
        warnings.push(FormatError::line(head.dimensions_line, problem));
    }
    let lamps = lamp_set(&head, &header);
    let mut goniogram = Goniogram {
        photometric_type: head.photometric_type,
        symmetry,
        horizontal: table.horizontal.angles,
        vertical: table.vertical.angles,
        intensities: table.intensities,
        opening,
        body: [0.0; 3],
        lamp_sets: vec![lamps],
        lamp_set: 0,
        tilt,
        stated: Stated::default(),
        header,
        spectrum: None,
        warnings,
    };
    goniogram.check();
    Ok(goniogram)
}

/// Revision, texts, and what the TILT line says.
fn header<'a>(lines: &mut Lines<'a>) -> Result<(Version, Vec<HeaderLine>, &'a str)> {
    let (mut version, mut header) = (None, Vec::new());
    for (_, line) in lines.by_ref() {
        if let Some(tilt) = tilt_of(line) {
            return Ok((version.unwrap_or(Version::Lm1986), header, tilt));
        }
        let line = line.trim();
        if version.is_none() && !line.starts_with('[') {
            version = Version::named_by(line);
            if version.is_some() {
                continue;
            }
        }
        let keyword = line.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        let (keyword, text) = keyword.unwrap_or(("", line));
        if !line.is_empty() && header.len() < MOST_TEXTS {
            header.push(HeaderLine { keyword: keyword.trim().to_owned(), text: text.trim().to_owned() });
        }
    }
    Err(FormatError::line(lines.count.max(1), "the file ends, expected a line that starts with TILT="))
}

fn head(version: Version, numbers: &mut Numbers<'_>, warnings: &mut Vec<FormatError>) -> Result<Head> {
    let lamps = numbers.next("the number of lamps")?;
    let lumens = numbers.next("the lumens of a lamp")?;
    let mut factor = positive("the multiplier", numbers, warnings)?;
    let counts = [numbers.count("vertical angles")?, numbers.count("horizontal angles")?];
    let photometric_type = photometric_type(numbers)?;
    let unit = unit(numbers)?;
    let mut dimensions = [0.0; 3];
    for (dimension, name) in dimensions.iter_mut().zip(["width", "length", "height"]) {
        *dimension = numbers.next(&format!("the opening's {name}"))? * unit;
    }
    let dimensions_line = numbers.line();
    factor *= positive("the ballast factor", numbers, warnings)?;
    let before_1995 = matches!(version, Version::Lm1986 | Version::Lm1991);
    if before_1995 {
        factor *= positive("the ballast-lamp photometric factor", numbers, warnings)?;
    } else {
        let future = numbers.next("the field after the ballast factor")?;
        if future != 1.0 && version != Version::Lm2019 {
            let problem = format!("the field after the ballast factor is {}, expected 1: not multiplied", number(future));
            warnings.push(FormatError::line(numbers.line(), problem));
        }
    }
    let watts = numbers.next("the input watts")?;
    if watts < 0.0 {
        warnings.push(FormatError::line(numbers.line(), format!("the input watts are {}: not used", number(watts))));
    }
    Ok(Head { lamps, lumens, factor, counts, photometric_type, dimensions, dimensions_line, unit, watts: watts.max(0.0) })
}

impl Head {
    /// Takes millimetres, or no opening, for what is too long for a luminaire in the file's unit; a warning then.
    fn mend_dimensions(&mut self) -> Option<FormatError> {
        let millimetres = plausible::from_millimetres(self.dimensions.map(|d| d / self.unit));
        let largest = self.dimensions.map(f64::abs).into_iter().fold(0.0, f64::max);
        if largest <= plausible::LONGEST {
            return None;
        }
        let found = format!("the opening is {} m long", number(largest));
        let (dimensions, taken) = match millimetres {
            Some(metres) => (metres, "its numbers are taken as millimetres"),
            None => ([0.0; 3], "no luminaire is: a point is taken"),
        };
        self.dimensions = dimensions;
        Some(FormatError::line(self.dimensions_line, format!("{found}; {taken}")))
    }
}

/// A factor; one that is not positive counts as 1.
fn positive(what: &str, numbers: &mut Numbers<'_>, warnings: &mut Vec<FormatError>) -> Result<f64> {
    let value = numbers.next(what)?;
    if value > 0.0 {
        return Ok(value);
    }
    warnings.push(FormatError::line(numbers.line(), format!("{what} is {}: 1 is taken", number(value))));
    Ok(1.0)
}

fn photometric_type(numbers: &mut Numbers<'_>) -> Result<PhotometricType> {
    let code = numbers.next("the photometric type")?;
    let known = [(1.0, PhotometricType::C), (2.0, PhotometricType::B), (3.0, PhotometricType::A)];
    known.into_iter().find(|(known, _)| *known == code).map(|(_, photometric_type)| photometric_type).ok_or_else(|| {
        let problem = format!("the photometric type is {}, expected 1 (C), 2 (B) or 3 (A)", number(code));
        FormatError::line(numbers.line(), problem)
    })
}

/// Metres in the file's unit.
fn unit(numbers: &mut Numbers<'_>) -> Result<f64> {
    let code = numbers.next("the units type")?;
    if code == 1.0 {
        Ok(FOOT)
    } else if code == 2.0 {
        Ok(1.0)
    } else {
        Err(FormatError::line(numbers.line(), format!("the units type is {}, expected 1 (feet) or 2 (metres)", number(code))))
    }
}

/// Angles and candela.
fn table(head: &Head, numbers: &mut Numbers<'_>, warnings: &mut Vec<FormatError>) -> Result<Table> {
    let [vertical, horizontal] = head.counts;
    let line = numbers.line();
    let most = numbers.remaining() / 2 + 1;
    let values = vertical.checked_mul(horizontal).filter(|values| values.saturating_add(vertical + horizontal) <= most);
    let Some(values) = values else {
        let problem =
            format!("{vertical} vertical and {horizontal} horizontal angles, but the rest of the file has room for {most} numbers");
        return Err(FormatError::line(line, problem));
    };
    let vertical = numbers.axis("vertical angle", vertical)?;
    let horizontal = numbers.axis("horizontal angle", horizontal)?;
    let (mut intensities, mut least) = (Vec::with_capacity(values), Least::default());
    for _ in 0..values {
        let value = numbers.next("a candela value")?;
        if (value * head.factor).abs() > LARGEST {
            let problem =
                format!("{} times the file's factors is {:e} cd, expected {LARGEST:e} at most", number(value), value * head.factor);
            return Err(FormatError::line(numbers.line(), problem));
        }
        least.see(value * head.factor, numbers.line());
        intensities.push(value * head.factor);
    }
    least.repair(&mut intensities, warnings)?;
    Ok(Table { horizontal, vertical, intensities })
}

fn lamp_set(head: &Head, header: &[HeaderLine]) -> LampSet {
    let text = |keyword: &str| header.iter().find(|line| line.keyword.eq_ignore_ascii_case(keyword)).map(|line| line.text.clone());
    let flux = (head.lumens > 0.0 && head.lamps > 0.0).then_some(head.lumens * head.lamps);
    LampSet {
        count: head.lamps.max(0.0) as u32,
        name: text("LAMP").or_else(|| text("LAMPCAT")).unwrap_or_default(),
        flux,
        absolute: flux.is_none(),
        watts: head.watts,
        ..LampSet::default()
    }
}
