//! When a room is used.

use crate::{
    error::{AnnualError, Result},
    year::Year,
};
use gonio_formats::FormatError;
use std::path::Path;

/// The steps of a year in which a room is used.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    used: Vec<bool>,
}

impl Schedule {
    /// Every day from one hour to another of the weather file's clock, such as 8 to 18, LM-83's 3650 hours.
    ///
    /// # Errors
    /// Hours that are none, or an end that is not after the beginning.
    pub fn daily(year: &Year, from: f64, to: f64) -> Result<Self> {
        if !(0.0 <= from && from < to && to <= 24.0) {
            return Err(AnnualError::setting("schedule", format!("{from}-{to} was found, expected hours from 0 to 24, such as 8-18")));
        }
        Self { used: year.steps.iter().map(|step| from <= step.hour && step.hour < to).collect() }.checked()
    }

    /// For each step whether the room is used.
    ///
    /// # Errors
    /// Another count than the year's steps, and a room that is never used.
    pub fn new(year: &Year, used: Vec<bool>) -> Result<Self> {
        if used.len() != year.steps.len() {
            let problem = format!("{} numbers were found, expected one for each of the weather's {} steps", used.len(), year.steps.len());
            return Err(AnnualError::setting("schedule", problem));
        }
        Self { used }.checked()
    }

    /// Reads a file's bytes: 0 or 1 for each step, the first number of each line; lines that begin with `#` and empty ones are left out.
    ///
    /// # Errors
    /// Other words, with their line, and another count than the year's steps.
    pub fn read(path: &Path, bytes: &[u8], year: &Year) -> Result<Self> {
        let wrong = |error| AnnualError::content(path, error);
        let text = std::str::from_utf8(bytes).map_err(|_| wrong(FormatError::whole("not a text in UTF-8: no schedule")))?;
        let mut used = Vec::with_capacity(year.steps.len());
        for (line, text) in (1..).zip(text.lines()).filter(|(_, text)| !text.trim().is_empty() && !text.starts_with('#')) {
            let word = text.split([',', ';', ' ', '\t']).next().unwrap_or_default();
            match word.trim().parse::<f64>() {
                Ok(0.0) => used.push(false),
                Ok(1.0) => used.push(true),
                _ => {
                    let shown: String = word.chars().take(40).collect();
                    return Err(wrong(FormatError::line(line, format!("'{shown}' was found, expected 0 or 1"))));
                }
            }
        }
        if used.len() != year.steps.len() {
            let problem = format!("{} numbers were found, expected one for each of the weather's {} steps", used.len(), year.steps.len());
            return Err(wrong(FormatError::whole(problem)));
        }
        Self { used }.checked()
    }

    fn checked(self) -> Result<Self> {
        if self.used.contains(&true) { Ok(self) } else { Err(AnnualError::setting("schedule", "no step of the year is used")) }
    }

    /// Whether the room is used in a step.
    pub fn is_used(&self, step: usize) -> bool {
        self.used[step]
    }

    /// Steps in which it is.
    pub fn count(&self) -> usize {
        self.used.iter().filter(|used| **used).count()
    }
}
