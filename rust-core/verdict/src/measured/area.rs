//! What has figures, and what a figure is.

use crate::{estimate::Estimate, names::spelt, note::Note, plan::Plan, unit::Unit};
use serde_json::{Map, Value};

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
    pub(super) fn new(key: &str, value: Option<Estimate>, unit: Unit) -> Self {
        let notes = Vec::new();
        Self { key: key.to_owned(), aliases: Vec::new(), of: None, wants_of: false, value, unit, notes, plan: None }
    }

    /// Whether somebody who writes this means the figure.
    pub(crate) fn is(&self, quantity: &str, of: Option<&str>) -> bool {
        let named = self.key == quantity || self.aliases.iter().any(|alias| alias == quantity);
        let short = self.key != quantity && named;
        named && of.map_or(!self.wants_of || short, |of| self.of.as_deref().map(spelt).as_deref() == Some(of))
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
    pub(super) fn new(name: &str, file: usize) -> Self {
        Self { name: name.to_owned(), aliases: Vec::new(), file, figures: Vec::new(), plans: Vec::new() }
    }
}

/// Areas whose figures have the notes of their file.
pub(super) fn with_notes(mut areas: Vec<Area>, whole: &Map<String, Value>) -> Vec<Area> {
    let listed = |key: &str| whole.get(key).and_then(Value::as_array).into_iter().flatten();
    let told = listed("notes").chain(listed("doubts")).filter_map(Value::as_str).map(str::to_owned);
    let warnings = listed("diagnostics").filter(|found| found["severity"] == "warning").filter_map(|found| {
        let [origin, message] = [&found["origin"], &found["message"]].map(Value::as_str);
        Some(format!("{}: {}", origin?, message?))
    });
    let notes: Vec<Note> = told.chain(warnings).map(Note::Told).collect();
    let figures = areas.iter_mut().flat_map(|area| &mut area.figures);
    figures.for_each(|figure| figure.notes.extend(notes.iter().cloned()));
    areas
}
