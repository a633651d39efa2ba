//! What was measured: the figures of files that gonio's commands print as JSON.

mod annual;
mod grids;
mod modelling;
mod road;
mod table;

use crate::{
    error::VerdictError,
    estimate::Estimate,
    names::{OTHER_CAPITALS, fit, listed, nearest, shown},
    note::Note,
    plan::Plan,
    unit::Unit,
};
use gonio_formats::FormatError;
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// A figure of an area.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Figure {
    /// Its name, and others that it goes by.
    pub(crate) key: String,
    pub(crate) aliases: Vec<String>,
    /// What it is the mean, the minimum, … of.
    pub(crate) of: Option<String>,
    /// Whether `of` has to be written for it to be meant by its key.
    pub(crate) wants_of: bool,
    /// `None` where the file has no number for it.
    pub(crate) value: Option<Estimate>,
    pub(crate) unit: Unit,
    pub(crate) notes: Vec<Note>,
    /// The plan that shows it, by its number among the area's.
    pub(crate) plan: Option<usize>,
}

impl Figure {
    /// A figure by its key, without anything beside it.
    fn new(key: &str, value: Option<Estimate>, unit: Unit) -> Self {
        let notes = Vec::new();
        Self { key: key.to_owned(), aliases: Vec::new(), of: None, wants_of: false, value, unit, notes, plan: None }
    }

    /// Whether somebody who writes this means the figure.
    pub(crate) fn is(&self, quantity: &str, of: Option<&str>) -> bool {
        let named = self.key == quantity || self.aliases.iter().any(|alias| alias == quantity);
        let short = self.key != quantity && named;
        named && of.map_or(!self.wants_of || short, |of| self.of.as_deref() == Some(of))
    }
}

/// A grid, a meter, a road, a path: what has figures.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Area {
    pub(crate) name: String,
    /// Other names that it goes by.
    pub(crate) aliases: Vec<String>,
    /// The number of its file.
    pub(crate) file: usize,
    pub(crate) figures: Vec<Figure>,
    pub(crate) plans: Vec<Plan>,
}

impl Area {
    fn new(name: &str, file: usize) -> Self {
        Self { name: name.to_owned(), aliases: Vec::new(), file, figures: Vec::new(), plans: Vec::new() }
    }
}

/// A file that was read.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    pub(crate) sha256: String,
}

impl Source {
    pub(crate) fn new(path: &Path, bytes: &[u8]) -> Self {
        let sha256 = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        Self { path: path.into(), sha256 }
    }
}

/// The figures of all files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    pub(crate) sources: Vec<Source>,
    pub(crate) areas: Vec<Area>,
}

impl Measured {
    /// Reads what `gonio measure`, `gonio annual`, `gonio annual-metrics` and `gonio road` print with `--json`.
    ///
    /// # Errors
    /// Bytes that are no JSON, or not that of one of these commands, with the file and what was found.
    pub fn read(files: &[(PathBuf, Vec<u8>)]) -> Result<Self, VerdictError> {
        let mut measured = Self::default();
        for (number, (path, bytes)) in files.iter().enumerate() {
            let areas = areas(bytes, number).map_err(|error| VerdictError::new(path, error))?;
            measured.areas.extend(areas);
            measured.sources.push(Source::new(path, bytes));
        }
        modelling::add(&mut measured.areas);
        Ok(measured)
    }
}

/// What a file holds.
type Found<T> = Result<T, FormatError>;

const EXPECTED: &str = "expected what 'gonio measure', 'gonio annual' or 'gonio road' print with --json";

fn areas(bytes: &[u8], file: usize) -> Found<Vec<Area>> {
    let whole: Value = serde_json::from_slice(bytes).map_err(|error| no_json(bytes, &error))?;
    let Value::Object(whole) = whole else {
        return Err(FormatError::whole(format!("no object of JSON, {EXPECTED}")));
    };
    let has = |key: &str| whole.contains_key(key);
    if has("meters") && has("grids") {
        grids::read(&whole, file)
    } else if has("weather") && has("grids") {
        annual::read(&whole, file)
    } else if has("l_av") && has("observers") {
        Ok(road::read(&whole, file))
    } else {
        let found = listed(whole.keys().map(String::as_str));
        let found = if found.is_empty() { "nothing was found".to_owned() } else { format!("'{found}' were found") };
        Err(FormatError::whole(format!("{found}, {EXPECTED}")))
    }
}

fn no_json(bytes: &[u8], error: &serde_json::Error) -> FormatError {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return FormatError::whole(format!("an empty file, {EXPECTED}"));
    }
    let message = error.to_string();
    let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(message, _)| message).to_owned();
    FormatError::line(error.line() as u64, format!("no JSON at column {}: {message}; {EXPECTED}", error.column()))
}

/// Objects of a list under a key; what is none is told.
fn objects<'a>(of: &'a Map<String, Value>, key: &str) -> Found<Vec<&'a Map<String, Value>>> {
    let wrong = || FormatError::whole(format!("'{key}' is not a list of objects, {EXPECTED}"));
    let list = of.get(key).and_then(Value::as_array).ok_or_else(wrong)?;
    list.iter().map(|entry| entry.as_object().ok_or_else(wrong)).collect()
}

/// A text under a key.
fn text<'a>(of: &'a Map<String, Value>, key: &str, what: &str) -> Found<&'a str> {
    let wrong = || FormatError::whole(format!("{what} has no '{key}', {EXPECTED}"));
    of.get(key).and_then(Value::as_str).ok_or_else(wrong)
}

/// A number under a key, if there is one.
fn number(of: &Map<String, Value>, key: &str) -> Option<f64> {
    of.get(key).and_then(Value::as_f64).filter(|value| value.is_finite())
}

/// A standard error, if there is one; one below 0 is told.
fn error(of: &Map<String, Value>, key: &str) -> Found<Option<f64>> {
    let found = number(of, key);
    match found {
        Some(error) if error < 0.0 => Err(FormatError::whole(format!("'{key}' is {error}, expected a standard error of zero or more"))),
        found => Ok(found),
    }
}

impl Measured {
    /// The areas that somebody may mean by a name, with their numbers and how well they fit; capitals count where any fits with them.
    pub(crate) fn meant(&self, written: &str) -> Vec<(usize, &Area, u8)> {
        let fits = |area: &Area| std::iter::once(&area.name).chain(&area.aliases).filter_map(|name| fit(written, name)).min();
        let all = || self.areas.iter().enumerate().filter_map(|(number, area)| Some((number, area, fits(area)?)));
        let capitals = all().any(|(.., fit)| fit < OTHER_CAPITALS);
        all().filter(|(.., fit)| !capitals || *fit < OTHER_CAPITALS).collect()
    }

    /// The number of the file that somebody wrote, or what to tell of it.
    pub(crate) fn file(&self, written: &str) -> Result<usize, String> {
        let paths: Vec<String> = self.sources.iter().map(|source| source.path.to_string_lossy().into_owned()).collect();
        let fits = |path: &String| fit(written, path).is_some_and(|fit| fit < OTHER_CAPITALS);
        paths.iter().position(fits).ok_or_else(|| {
            let known = || paths.iter().map(String::as_str);
            let hint = nearest(written, known()).map_or(String::new(), |nearest| format!("; did you mean '{}'?", shown(nearest)));
            format!("file '{}' is none of those given: {}{hint}", shown(written), listed(known()))
        })
    }
}
