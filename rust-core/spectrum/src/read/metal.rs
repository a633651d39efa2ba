//! Files of a metal's n and k: rows of wavelength, n and k, or a block of n and one of k, as the refractiveindex.info database gives them.

use super::{LONGEST, cells, decoded};
use crate::{index::to_nanometres, metal::MetalIndex, table::linear};
use gonio_formats::{
    FormatError,
    spectrum::{MOST, quoted},
};

/// Wavelengths and numbers.
type Curve = [Vec<f64>; 2];

/// Reads text of rows `wavelength n k`, or rows `wavelength n` and behind a head with a k rows `wavelength k`. Commas, semicolons, tabs or blanks stand
/// between numbers, wavelengths are nm or micrometres; rows without numbers, as in the database's YAML, are left out.
///
/// # Errors
/// Rows that mix both forms, and what [`MetalIndex::new`] refuses.
pub fn read_metal(bytes: &[u8], name: &str) -> Result<MetalIndex, FormatError> {
    if bytes.len() > LONGEST {
        return Err(FormatError::whole(format!("more than {LONGEST} bytes: no metal's file")));
    }
    let text = decoded(bytes)?;
    let mut curves: [Curve; 2] = Default::default();
    let mut block = 0;
    for (line, row) in (1_u64..).zip(text.lines()) {
        let cells = cells(row);
        let numbers: Vec<f64> = cells.iter().map_while(|cell| cell.parse().ok()).collect();
        match numbers.as_slice() {
            [] => block = if cells.last().is_some_and(|cell| *cell == "k") && cells.len() == 2 { 1 } else { block },
            [nm, n, k] if cells.len() == 3 && block == 0 && curves[0][0].len() == curves[1][0].len() => {
                add(&mut curves[0], [*nm, *n]);
                add(&mut curves[1], [*nm, *k]);
            }
            [nm, value] if cells.len() == 2 && (block == 1 || curves[1][0].is_empty()) => add(&mut curves[block], [*nm, *value]),
            _ if !row.trim_start().starts_with(|c: char| c.is_ascii_digit()) => {}
            _ => return Err(FormatError::line(line, format!("{} was found, expected a wavelength, n and k", quoted(row)))),
        }
        if curves[0][0].len() > MOST {
            return Err(FormatError::line(line, format!("more than {MOST} rows")));
        }
    }
    let [[mut wavelengths, n], [at, k]] = curves;
    if at.is_empty() {
        return Err(FormatError::whole("no extinction k: expected rows of a wavelength, n and k, of a metal"));
    }
    let k = if at == wavelengths { k } else { wavelengths.iter().map(|nm| linear(&at, &k, *nm)).collect() };
    to_nanometres(&mut wavelengths);
    MetalIndex::new(name, wavelengths, n, k)
}

fn add(curve: &mut Curve, [nm, value]: [f64; 2]) {
    curve[0].push(nm);
    curve[1].push(value);
}
