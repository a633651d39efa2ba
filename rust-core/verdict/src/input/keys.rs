//! The keys of one table of a TOML file, each with its line.

use crate::{
    error::{Result, VerdictError},
    names::{nearest, shown},
};
use gonio_formats::FormatError;
use std::path::Path;
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// A TOML file.
#[derive(Clone, Copy, Debug)]
pub(super) struct File<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl File<'_> {
    /// The line of a byte, from 1.
    pub(super) fn line(&self, byte: usize) -> u64 {
        1 + self.text.bytes().take(byte).filter(|byte| *byte == b'\n').count() as u64
    }

    /// A problem at a byte.
    pub(super) fn problem(&self, byte: usize, problem: String) -> VerdictError {
        VerdictError::new(self.path, FormatError::line(self.line(byte), problem))
    }
}

/// One table: the file's own, or one of several `[[require]]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Keys<'a> {
    /// What it is called in messages.
    name: &'a str,
    file: &'a File<'a>,
    table: &'a DeTable<'a>,
    /// Where it begins.
    start: usize,
}

impl<'a> Keys<'a> {
    pub(super) fn new(name: &'a str, file: &'a File<'a>, table: &'a DeTable<'a>, start: usize) -> Self {
        Self { name, file, table, start }
    }

    /// A problem of the key with a name, or of the table that lacks it.
    pub(super) fn problem_of(&self, key: &str, problem: &str) -> VerdictError {
        let start = self.table.get(key).map_or(self.start, |value| value.span().start);
        self.file.problem(start, format!("{}: {key} {problem}", self.name))
    }

    /// Refuses keys that are not known.
    pub(super) fn check(&self, known: &[&str]) -> Result<()> {
        let Some(key) = self.table.keys().filter(|key| !known.contains(&key.get_ref().as_ref())).min_by_key(|key| key.span().start) else {
            return Ok(());
        };
        let name = key.get_ref();
        let hint = match nearest(name, known.iter().copied()) {
            Some(nearest) => format!("did you mean '{nearest}'?"),
            None => format!("known are {}", known.join(", ")),
        };
        Err(self.file.problem(key.span().start, format!("{}: the key '{}' is not known; {hint}", self.name, shown(name))))
    }

    /// A number that fits, if the key is there.
    pub(super) fn number(&self, key: &str, fits: impl Fn(f64) -> bool, expected: &str) -> Result<Option<f64>> {
        let Some(value) = self.table.get(key) else { return Ok(None) };
        match plain(value.get_ref()) {
            None => Err(self.problem_of(key, &format!("is a {}, expected a number {expected}", value.get_ref().type_str()))),
            Some(number) if fits(number) => Ok(Some(number)),
            Some(number) => Err(self.problem_of(key, &format!("is {number}, expected a number {expected}"))),
        }
    }

    /// A text, if the key is there.
    pub(super) fn text(&self, key: &str) -> Result<Option<&'a str>> {
        let Some(value) = self.table.get(key) else { return Ok(None) };
        let found = value.get_ref().as_str().filter(|text| !text.trim().is_empty());
        found.map(Some).ok_or_else(|| self.problem_of(key, "is not a text, expected one between quotation marks"))
    }

    /// Tables of a list under a key, with their places; none where the key is not there.
    pub(super) fn tables(&self, key: &str) -> Result<Vec<(&'a DeTable<'a>, usize)>> {
        let Some(value) = self.table.get(key) else { return Ok(Vec::new()) };
        let wrong = || self.problem_of(key, &format!("is not a list of tables, expected [[{key}]]"));
        let list = value.get_ref().as_array().ok_or_else(wrong)?;
        let table = |entry: &'a Spanned<DeValue<'a>>| Ok((entry.get_ref().as_table().ok_or_else(wrong)?, entry.span().start));
        list.iter().map(table).collect()
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
