//! Files of an index of refraction: rows of wavelength and n, or the refractiveindex.info database's YAML, whose formulas are computed.

use super::{LONGEST, cells, decoded};
use crate::{
    glass::{Formula, GlassIndex, POSSIBLE},
    index::{MICROMETRES, nanometres, to_nanometres},
};
use gonio_formats::{
    FormatError,
    spectrum::{MOST, quoted},
};

/// What the lines of a file are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// Rows of wavelength and n, perhaps with k.
    Index,
    /// Extinction.
    Extinction,
    /// The formula of a number.
    Formula(usize),
}

/// What was read so far.
struct Reading {
    part: Part,
    /// Whether a section of the database stands here that has no data.
    skips: bool,
    wavelengths: Vec<f64>,
    n: Vec<f64>,
    formula: Option<Formula>,
    /// Where the formula holds, nm.
    reach: Option<[f64; 2]>,
    /// Whether an extinction was left out.
    extinct: bool,
}

/// Reads text of rows `wavelength n`, a third number k being left out, or the database's YAML: `tabulated n`, `tabulated nk`, and formulas 1 to 9.
/// Commas, semicolons, tabs or blanks stand between numbers, wavelengths are nm or micrometres.
///
/// # Errors
/// Rows that are none, with their line, and what [`GlassIndex::new`] refuses.
pub fn read_glass(bytes: &[u8], name: &str) -> Result<GlassIndex, FormatError> {
    if bytes.len() > LONGEST {
        return Err(FormatError::whole(format!("more than {LONGEST} bytes: no glass's file")));
    }
    let text = decoded(bytes)?;
    let mut reading =
        Reading { part: Part::Index, skips: false, wavelengths: Vec::new(), n: Vec::new(), formula: None, reach: None, extinct: false };
    for (line, row) in (1_u64..).zip(text.lines()) {
        reading.take(row).map_err(|problem| FormatError::line(line, problem))?;
    }
    reading.made(name)
}

impl Reading {
    /// Takes a line.
    fn take(&mut self, row: &str) -> Result<(), String> {
        if let Some(section) = section(row) {
            (self.skips, self.part) = (section != "DATA", Part::Index);
            return Ok(());
        }
        if self.skips {
            return Ok(());
        }
        let entry = row.trim().trim_start_matches("- ").trim_start();
        match (entry.split_once(':'), self.part) {
            (Some(("type", kind)), _) => self.start(kind.trim())?,
            (Some(("wavelength_range", range)), Part::Formula(_)) => self.reach = Some(reach(range)?),
            (Some(("coefficients", values)), Part::Formula(number)) => {
                let values: Result<Vec<f64>, _> = values.split_whitespace().map(str::parse).collect();
                let values = values.map_err(|_| format!("{} was found, expected the coefficients of formula {number}", quoted(row)))?;
                self.formula = Some(Formula::new(number, values)?);
            }
            (None, Part::Index) => self.add(row)?,
            _ => {}
        }
        Ok(())
    }

    /// Begins one of the database's kinds of data.
    fn start(&mut self, kind: &str) -> Result<(), String> {
        self.part = match (kind, kind.strip_prefix("formula ").map(str::parse)) {
            ("tabulated n" | "tabulated nk", _) => Part::Index,
            ("tabulated k", _) => Part::Extinction,
            (_, Some(Ok(number))) => Part::Formula(number),
            _ => return Err(format!("{} was found, expected tabulated n, tabulated nk or formula 1 to 9", quoted(kind))),
        };
        self.extinct |= self.part == Part::Extinction;
        Ok(())
    }

    /// Takes a row of wavelength and n.
    fn add(&mut self, row: &str) -> Result<(), String> {
        let cells = cells(row);
        let numbers: Vec<f64> = cells.iter().map_while(|cell| cell.parse().ok()).collect();
        match numbers.as_slice() {
            [] => {
                // The database's CSV has a block of n and one of k, each below its head.
                if cells.len() == 2 && cells[1] == "k" {
                    (self.part, self.extinct) = (Part::Extinction, true);
                }
                return Ok(());
            }
            [_, _] | [_, _, _] if cells.len() == numbers.len() => {}
            _ if !row.trim_start().starts_with(|c: char| c.is_ascii_digit()) => return Ok(()),
            _ => return Err(format!("{} was found, expected a wavelength and n", quoted(row))),
        }
        let [wavelength, n] = [numbers[0], numbers[1]];
        self.extinct |= numbers.len() == 3;
        if !(POSSIBLE[0]..=POSSIBLE[1]).contains(&n) && (0.38..=0.78).contains(&micrometres(wavelength)) {
            return Err(format!("an index of {n}, expected {} to {}", POSSIBLE[0], POSSIBLE[1]));
        }
        if self.wavelengths.last().is_some_and(|last| last.partial_cmp(&wavelength) != Some(std::cmp::Ordering::Less)) {
            return Err(format!("{wavelength} after {}, expected increasing wavelengths", self.wavelengths[self.wavelengths.len() - 1]));
        }
        if self.wavelengths.len() >= MOST {
            return Err(format!("more than {MOST} rows"));
        }
        self.wavelengths.push(wavelength);
        self.n.push(n);
        Ok(())
    }

    /// The index.
    fn made(self, name: &str) -> Result<GlassIndex, FormatError> {
        let Self { mut wavelengths, n, formula, reach, extinct, .. } = self;
        let mut made = match formula {
            Some(formula) => {
                let reach = reach.ok_or_else(|| FormatError::whole("a formula without its wavelength_range"))?;
                GlassIndex::of_formula(name, &formula, reach)?
            }
            None if wavelengths.is_empty() => {
                let expected = "rows of a wavelength and n, or the refractiveindex.info database's YAML with a formula or a table of n";
                return Err(FormatError::whole(format!("no index of refraction, expected {expected}")));
            }
            None => {
                to_nanometres(&mut wavelengths);
                let (wavelengths, n) = seen(&wavelengths, &n);
                GlassIndex::new(name, wavelengths, n)?
            }
        };
        if extinct {
            made.notes.push("its extinction k is left out: what the glass absorbs is told by the material's colour and depth".to_owned());
        }
        Ok(made)
    }
}

/// The name of the database's section that a line begins: capitals and a colon.
fn section(row: &str) -> Option<&str> {
    let (name, _) = row.split_once(':')?;
    (!name.is_empty() && name.chars().all(|c| c.is_ascii_uppercase() || c == '_')).then_some(name)
}

/// A range in micrometres as nanometres.
fn reach(text: &str) -> Result<[f64; 2], String> {
    let numbers: Vec<f64> = text.split_whitespace().map_while(|cell| cell.parse().ok()).collect();
    match numbers.as_slice() {
        [from, to] => Ok([nanometres(*from), nanometres(*to)]),
        _ => Err(format!("{} was found, expected the first and the last wavelength in micrometres", quoted(text))),
    }
}

/// The points of light, with the next on either side: what is beyond may have any index.
fn seen(wavelengths: &[f64], n: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let first = wavelengths.partition_point(|nm| *nm <= 380.0).saturating_sub(1);
    let last = (wavelengths.partition_point(|nm| *nm < 780.0) + 1).min(wavelengths.len()).max(first);
    (wavelengths[first..last].to_vec(), n[first..last].to_vec())
}

/// A wavelength of either unit in micrometres.
fn micrometres(wavelength: f64) -> f64 {
    if wavelength < MICROMETRES { wavelength } else { wavelength / 1000.0 }
}
