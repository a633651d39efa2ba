//! The keys of one table of a TOML file, each with its line.

use crate::error::{Result, RoadError};
use gonio_formats::FormatError;
use std::path::Path;
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// Letters that a wrong key may share with a known one to be taken for a slip, of 1.
const ALIKE: f64 = 0.6;

/// Numbers that a key takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    least: f64,
    most: f64,
    /// Whether the least itself is too little.
    open: bool,
    unit: &'static str,
}

/// Widths of roads and paths.
pub(super) const WIDE: Bounds = Bounds::above(0.0, 100.0, " m");

impl Bounds {
    /// Above a number, up to another.
    pub(super) const fn above(least: f64, most: f64, unit: &'static str) -> Self {
        Self { least, most, open: true, unit }
    }
    /// From a number to another.
    pub(super) const fn from(least: f64, most: f64, unit: &'static str) -> Self {
        Self { least, most, open: false, unit }
    }

    fn holds(&self, value: f64) -> bool {
        value <= self.most && if self.open { value > self.least } else { value >= self.least }
    }

    fn told(&self) -> String {
        let Self { least, most, unit, .. } = self;
        if self.open { format!("above {least} and up to {most}{unit}") } else { format!("from {least} to {most}{unit}") }
    }
}

/// A TOML file.
#[derive(Clone, Copy, Debug)]
pub(super) struct File<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl File<'_> {
    /// A problem at a byte.
    pub(super) fn problem(&self, byte: usize, problem: String) -> RoadError {
        let line = 1 + self.text.bytes().take(byte).filter(|byte| *byte == b'\n').count() as u64;
        RoadError::content(self.path, FormatError::line(line, problem))
    }
}

/// One table: `[road]`, or one of several `[[row]]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Keys<'a> {
    /// What it is called in messages.
    pub(super) name: &'a str,
    file: &'a File<'a>,
    table: &'a DeTable<'a>,
    /// Where it begins.
    start: usize,
}

impl<'a> Keys<'a> {
    pub(super) fn new(name: &'a str, file: &'a File<'a>, table: &'a DeTable<'a>, start: usize) -> Self {
        Self { name, file, table, start }
    }

    /// The file that they stand in.
    pub(super) fn path(&self) -> &'a Path {
        self.file.path
    }

    /// A problem of a value.
    pub(super) fn problem(&self, value: &Spanned<DeValue<'_>>, problem: &str) -> RoadError {
        self.file.problem(value.span().start, format!("{}: {problem}", self.name))
    }

    /// A problem of the key with a name, or of the table that lacks it.
    pub(super) fn problem_of(&self, key: &str, problem: &str) -> RoadError {
        match self.table.get(key) {
            Some(value) => self.problem(value, &format!("{key} {problem}")),
            None => self.file.problem(self.start, format!("{}: {key} {problem}", self.name)),
        }
    }

    /// Refuses keys that are not known.
    pub(super) fn check(&self, known: &[&str]) -> Result<()> {
        let Some(key) = self.table.keys().filter(|key| !known.contains(&key.get_ref().as_ref())).min_by_key(|key| key.span().start) else {
            return Ok(());
        };
        let name = key.get_ref();
        let alike = |other: &&&str| strsim::jaro_winkler(name, other);
        let nearest = known.iter().max_by(|a, b| alike(a).total_cmp(&alike(b)));
        let hint = match nearest.filter(|nearest| alike(nearest) >= ALIKE) {
            Some(nearest) => format!("did you mean '{nearest}'?"),
            None => format!("known are {}", known.join(", ")),
        };
        let shown: String = name.chars().take(40).collect();
        Err(self.file.problem(key.span().start, format!("{}: the key '{shown}' is not known; {hint}", self.name)))
    }

    pub(super) fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.table.get(key)
    }

    /// A number within bounds, if the key is there.
    pub(super) fn number(&self, key: &str, bounds: Bounds) -> Result<Option<f64>> {
        self.get(key).map(|value| self.bounded(key, value, bounds)).transpose()
    }

    /// A number that has to be there.
    pub(super) fn needed(&self, key: &str, bounds: Bounds) -> Result<f64> {
        self.number(key, bounds)?.ok_or_else(|| self.problem_of(key, &format!("is missing, expected a number {}", bounds.told())))
    }

    fn bounded(&self, key: &str, value: &Spanned<DeValue<'_>>, bounds: Bounds) -> Result<f64> {
        let expected = bounds.told();
        let Some(number) = plain(value.get_ref()) else {
            let kind = value.get_ref().type_str();
            return Err(self.problem(value, &format!("{key} is a {kind}, expected a number {expected}")));
        };
        if bounds.holds(number) {
            Ok(number)
        } else {
            Err(self.problem(value, &format!("{key} is {number}, expected a number {expected}")))
        }
    }

    /// So many numbers within bounds, if the key is there.
    pub(super) fn numbers<const N: usize>(&self, key: &str, bounds: Bounds) -> Result<Option<[f64; N]>> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let list = value.get_ref().as_array().filter(|list| list.len() == N);
        let list = list.ok_or_else(|| self.problem(value, &format!("{key} is not a list of {N} numbers {}", bounds.told())))?;
        let mut numbers = [0.0; N];
        for (number, value) in numbers.iter_mut().zip(list.iter()) {
            *number = self.bounded(key, value, bounds)?;
        }
        Ok(Some(numbers))
    }

    /// A whole number from 1 on, if the key is there.
    pub(super) fn count(&self, key: &str, most: u32) -> Result<Option<u32>> {
        let Some(number) = self.number(key, Bounds::from(1.0, f64::from(most), ""))? else { return Ok(None) };
        match number.fract() == 0.0 {
            true => Ok(Some(number as u32)),
            false => Err(self.problem_of(key, &format!("is {number}, expected a whole number from 1 to {most}"))),
        }
    }

    /// A text, if the key is there.
    pub(super) fn text(&self, key: &str) -> Result<Option<&'a str>> {
        let text = |value: &'a Spanned<DeValue<'a>>| {
            let found = value.get_ref().as_str().filter(|text| !text.is_empty());
            found.ok_or_else(|| self.problem(value, &format!("{key} is not a text, expected one between quotation marks")))
        };
        self.get(key).map(text).transpose()
    }

    /// A text that has to be there.
    pub(super) fn needed_text(&self, key: &str, expected: &str) -> Result<&'a str> {
        self.text(key)?.ok_or_else(|| self.problem_of(key, &format!("is missing, expected {expected}")))
    }

    /// One of several words, if the key is there.
    pub(super) fn word<T: Copy>(&self, key: &str, words: &[(&str, T)]) -> Result<Option<T>> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        match words.iter().find(|(word, _)| *word == text) {
            Some((_, meaning)) => Ok(Some(*meaning)),
            None => {
                let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
                let shown: String = text.chars().take(40).collect();
                Err(self.problem_of(key, &format!("is '{shown}', expected one of {}", known.join(", "))))
            }
        }
    }

    /// Tables of a list under a key, with their places; none where the key is not there.
    pub(super) fn tables(&self, key: &str) -> Result<Vec<(&'a DeTable<'a>, usize)>> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        let wrong = |value| self.problem(value, &format!("{key} is not a list of tables, expected [[{key}]]"));
        let list = value.get_ref().as_array().ok_or_else(|| wrong(value))?;
        list.iter().map(|entry| Ok((entry.get_ref().as_table().ok_or_else(|| wrong(entry))?, entry.span().start))).collect()
    }

    /// A table under a key with its place, if the key is there.
    pub(super) fn table(&self, key: &str) -> Result<Option<(&'a DeTable<'a>, usize)>> {
        let Some(value) = self.get(key) else { return Ok(None) };
        match value.get_ref().as_table() {
            Some(table) => Ok(Some((table, value.span().start))),
            None => Err(self.problem(value, &format!("{key} is not a table, expected [{key}]"))),
        }
    }
}

/// What a number of TOML is worth; none of anything else.
fn plain(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(number) => number.as_str().parse().ok(),
        DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix()).ok().map(|number| number as f64),
        _ => None,
    }
}
