//! A grid's year on disk: arrays of points × steps, and a table of the points.

use crate::file::put;
use gonio::Result;
use gonio_annual::{Grid, Series, to_npy};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The files of a grid: all light, direct light, the points.
pub(crate) fn paths(folder: &Path, name: &str) -> [PathBuf; 3] {
    ["_total.npy", "_direct.npy", "_points.csv"].map(|ending| folder.join(format!("{name}{ending}")))
}

/// Writes what there is; gives the files.
pub(super) fn write(series: &Series, folder: &Path, name: &str, grid: &Grid) -> Result<Vec<PathBuf>> {
    let Series { points: count, steps, total: all, direct: straight } = series;
    let [total, direct, points] = paths(folder, name);
    put(&total, &to_npy(*count, *steps, all))?;
    put(&points, table(grid).as_bytes())?;
    let mut written = vec![total, points];
    if let Some(values) = straight {
        put(&direct, &to_npy(*count, *steps, values))?;
        written.push(direct);
    }
    Ok(written)
}

/// A line for each point; standard errors in columns of their own.
fn table(grid: &Grid) -> String {
    let errors = grid.standard_errors.as_ref().map(|errors| &errors.points);
    let row = |point: &Value, head: bool, suffix: &str| {
        let cells = point.as_object().into_iter().flatten().filter(|(name, _)| *name != HALVES);
        let cells = cells.map(|(name, value)| if head { format!(",{name}{suffix}") } else { format!(",{}", cell(value)) });
        let halves = point[HALVES].as_array().into_iter().flatten().zip(["100", "300", "500", "750"]);
        let halves = halves.map(|(value, lux)| if head { format!(",daylight_hours_{lux}{suffix}") } else { format!(",{}", cell(value)) });
        cells.chain(halves).collect::<String>()
    };
    let mut text = String::new();
    for (index, point) in grid.points.iter().enumerate() {
        let (point, error) = (json!(point), errors.map(|errors| json!(errors[index])));
        if index == 0 {
            let of_errors = error.as_ref().map(|error| row(error, true, "_standard_error")).unwrap_or_default();
            text += &format!("point{}{of_errors}\n", row(&point, true, ""));
        }
        let of_errors = error.as_ref().map(|error| row(error, false, "")).unwrap_or_default();
        text += &format!("{}{}{of_errors}\n", index + 1, row(&point, false, ""));
    }
    text
}

/// The name of the figures that are four.
const HALVES: &str = "daylight_hours_100_300_500_750";

/// A number, or nothing where it is not known.
fn cell(value: &Value) -> String {
    if value.is_null() { String::new() } else { value.to_string() }
}
