//! What is required.

use crate::bound::Bound;
use std::path::PathBuf;

/// A requirement: one line of the sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    /// The grid, meter, road or path: its name, or the end of its prim's path.
    pub area: String,
    /// The figure, by the name that the files or `docs/verdict.md` have for it.
    pub quantity: String,
    /// What the quantity is the mean, the minimum, … of, where the area has several: `cylindrical`.
    pub of: Option<String>,
    /// The file that the figure stands in, where several have one.
    pub file: Option<String>,
    /// The side of the limit.
    pub bound: Bound,
    /// The limit, in the unit below or the figure's own.
    pub limit: f64,
    /// The unit that the limit is in, as it was written.
    pub unit: Option<String>,
    /// Free words.
    pub label: Option<String>,
    /// What the measured figure is multiplied with.
    pub maintenance_factor: Option<f64>,
    /// The line of its `[[require]]`.
    pub line: u64,
}

/// A file of requirements.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirements {
    /// The file.
    pub path: PathBuf,
    /// The sheet's title.
    pub title: Option<String>,
    /// Free words for the sheet's head: which project, where, and who made it.
    pub project: Option<String>,
    /// The place.
    pub place: Option<String>,
    /// Who answers for the sheet.
    pub author: Option<String>,
    /// The requirements in their order, one at least.
    pub list: Vec<Requirement>,
}
