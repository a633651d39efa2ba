//! Response curves of cameras and other sensors: a table of wavelengths with a column for each channel.

use super::{LONGEST, cells, decoded};
use crate::table::linear;
use gonio_formats::{
    FormatError,
    spectrum::{MOST, quoted},
};

/// The most channels of a sensor.
const MOST_CHANNELS: usize = 64;
/// The fewest points of a curve.
const FEWEST: usize = 5;

/// A sensor's channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Their names.
    pub names: Vec<String>,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// By channel: the response at each of these, in any unit.
    pub curves: Vec<Vec<f64>>,
}

impl Response {
    /// Reads lines of nm and responses with commas, semicolons, tabs or blanks between them; a line of names may stand first. Lines that begin with `#` are
    /// left out.
    ///
    /// # Errors
    /// What is no table of numbers, wavelengths that do not increase or are no nanometres, fewer than five of them, channels without a name of their own.
    pub fn read(bytes: &[u8]) -> Result<Self, FormatError> {
        if bytes.len() > LONGEST {
            return Err(FormatError::whole(format!("more than {LONGEST} bytes: no sensor's file")));
        }
        let text = decoded(bytes)?;
        let mut found = Self { names: Vec::new(), wavelengths_nm: Vec::new(), curves: Vec::new() };
        for (number, line) in (1_u64..).zip(text.lines()) {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let cells = cells(line);
            if found.wavelengths_nm.is_empty() && found.names.is_empty() && cells.iter().all(|cell| cell.parse::<f64>().is_err()) {
                found.names = cells.iter().skip(1).map(|cell| (*cell).to_owned()).collect();
                continue;
            }
            found.add(&cells, number)?;
        }
        found.complete()
    }

    fn add(&mut self, cells: &[&str], line: u64) -> Result<(), FormatError> {
        let number = |cell: &&str| {
            let found = cell.parse::<f64>().ok().filter(|value| value.is_finite());
            found.ok_or_else(|| FormatError::line(line, format!("{} is no number", quoted(cell))))
        };
        let numbers = cells.iter().map(number).collect::<Result<Vec<f64>, _>>()?;
        let (nm, responses) = numbers.split_first().ok_or_else(|| FormatError::line(line, "an empty row".to_owned()))?;
        if self.curves.is_empty() {
            self.curves = vec![Vec::new(); responses.len()];
        }
        if responses.is_empty() || responses.len() != self.curves.len() || responses.len() > MOST_CHANNELS {
            let problem =
                format!("{} channels beside the wavelength, expected {}", responses.len(), self.curves.len().clamp(1, MOST_CHANNELS));
            return Err(FormatError::line(line, problem));
        }
        if self.wavelengths_nm.last().is_some_and(|before| nm <= before) {
            return Err(FormatError::line(line, format!("{nm} nm does not lie beyond the wavelength before")));
        }
        if !(100.0..=10_000.0).contains(nm) {
            return Err(FormatError::line(line, format!("{nm} is no wavelength of a camera in nm, expected 100 to 10,000")));
        }
        if self.wavelengths_nm.len() >= MOST {
            return Err(FormatError::line(line, format!("more than {MOST} rows")));
        }
        self.wavelengths_nm.push(*nm);
        self.curves.iter_mut().zip(responses).for_each(|(curve, response)| curve.push(*response));
        Ok(())
    }

    fn complete(mut self) -> Result<Self, FormatError> {
        if self.wavelengths_nm.len() < FEWEST {
            return Err(FormatError::whole(format!(
                "{} rows of wavelength and responses, expected {FEWEST} at least",
                self.wavelengths_nm.len()
            )));
        }
        let count = self.curves.len();
        if self.names.is_empty() {
            self.names =
                if count == 3 { ["R", "G", "B"].map(str::to_owned).into() } else { (1..=count).map(|k| format!("channel{k}")).collect() };
        }
        let mut different = self.names.clone();
        different.sort();
        different.dedup();
        if self.names.len() != count || different.len() != count {
            let names = self.names.iter().map(|name| quoted(name)).collect::<Vec<_>>().join(", ");
            return Err(FormatError::whole(format!("{count} channels with the names {names}, expected a name of its own for each")));
        }
        Ok(self)
    }

    /// By channel: the response at a wavelength in nm, linear between points and zero beyond them.
    pub fn at(&self, nm: f64) -> Vec<f64> {
        self.curves.iter().map(|curve| linear(&self.wavelengths_nm, curve, nm)).collect()
    }
}
