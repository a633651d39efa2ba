//! What `gonio annual -o` keeps of a year.

use crate::{
    annual::{
        kept_path,
        plots::{Layout, Times},
        series,
    },
    file::read,
};
use gonio::{Error, Result, annual::told};
use gonio_annual::{Coefficients, Grid};
use serde::Deserialize;
use serde_json::Value;
use std::path::Path;

/// The longest files in bytes.
const LONGEST_JSON: u64 = 1 << 30;
const LONGEST_SERIES: u64 = 1 << 36;

/// A year of daylight on grids.
#[derive(Debug, Deserialize)]
pub(super) struct Year {
    pub(super) weather: String,
    pub(super) place: String,
    pub(super) latitude_deg: f64,
    pub(super) longitude_deg: f64,
    pub(super) schedule: String,
    pub(super) doubts: Vec<String>,
    #[serde(flatten)]
    pub(super) times: Times,
    #[serde(rename = "grids")]
    values: Vec<Value>,
    #[serde(default)]
    diagnostics: Vec<Told>,
    #[serde(skip)]
    pub(super) grids: Vec<KeptGrid>,
}

/// What was not as the stage asks.
#[derive(Debug, Deserialize)]
struct Told {
    severity: String,
    origin: String,
    message: String,
}

/// A grid's year.
#[derive(Debug)]
pub(super) struct KeptGrid {
    pub(super) name: String,
    pub(super) grid: Grid,
    /// Names of the groups of windows.
    pub(super) groups: Vec<String>,
    pub(super) layout: Option<Layout>,
    /// Means of all points by step, lx.
    pub(super) means: Vec<f32>,
}

impl Year {
    /// Reads a folder.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        let path = kept_path(folder);
        if !path.exists() {
            let problem = format!("{}: there is no {}; 'gonio annual -o' writes it", folder.display(), file_name(&path));
            return Err(Error::setting("annual", problem));
        }
        let wrong = |problem: String| Error::Format { path: path.clone(), line: None, problem };
        let bytes = read(&path, LONGEST_JSON, "year of 'gonio annual'")?;
        let mut year: Self = serde_json::from_slice(&bytes).map_err(|error| wrong(format!("no year of 'gonio annual': {error}")))?;
        for value in std::mem::take(&mut year.values) {
            let grid = serde_json::from_value(value.clone()).map_err(|error| wrong(format!("no grid of 'gonio annual': {error}")))?;
            let name = value["name"].as_str().unwrap_or_default().to_owned();
            let means = means(folder, &name, year.times.a_day() * year.times.sunrise_sunset_h.len())?;
            let groups = serde_json::from_value(value["groups"].clone()).unwrap_or_default();
            year.grids.push(KeptGrid { layout: Layout::read(&value), name, grid, groups, means });
        }
        Ok(year)
    }

    /// The weather file's name.
    pub(super) fn file(&self) -> String {
        file_name(Path::new(&self.weather))
    }

    /// What was not as the stage asks, a line each.
    pub(super) fn warnings(&self) -> Vec<String> {
        let warnings = self.diagnostics.iter().filter(|told| told.severity == "warning");
        warnings
            .map(|Told { origin, message, .. }| if origin.is_empty() { message.clone() } else { format!("{origin}: {message}") })
            .collect()
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Means of a grid's points by step.
fn means(folder: &Path, name: &str, steps: usize) -> Result<Vec<f32>> {
    let [path, ..] = series::paths(folder, name);
    let read = Coefficients::read(&path, &read(&path, LONGEST_SERIES, "series of 'gonio annual'")?).map_err(told)?;
    if read.columns != steps {
        let problem = format!("{} steps were found, expected the year's {steps}", read.columns);
        return Err(Error::Format { path, line: None, problem });
    }
    let mut sums = vec![0.0_f64; steps];
    for row in read.mean(None).chunks_exact(steps) {
        sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += f64::from(*value));
    }
    Ok(sums.into_iter().map(|sum| (sum / read.points as f64) as f32).collect())
}
