//! A grid's year on disk: arrays of points × steps, and a table of the points.

use crate::file::put;
use gonio::Result;
use gonio_annual::{Chunk, Grid, to_npy};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Illuminances of a year in lx, row after row; it is dark where nothing was taken.
pub(super) struct Series {
    points: usize,
    steps: usize,
    total: Vec<f32>,
    direct: Option<Vec<f32>>,
}

/// The files of a grid: all light, direct light, the points.
pub(super) fn paths(folder: &Path, name: &str) -> [PathBuf; 3] {
    ["_total.npy", "_direct.npy", "_points.csv"].map(|ending| folder.join(format!("{name}{ending}")))
}

impl Series {
    pub(super) fn new(points: usize, steps: usize) -> Self {
        Self { points, steps, total: vec![0.0; points * steps], direct: None }
    }

    pub(super) fn take(&mut self, chunk: &Chunk<'_>) {
        put_steps(&mut self.total, self.steps, chunk.steps, chunk.total);
        if let Some(direct) = chunk.direct {
            let all = self.direct.get_or_insert_with(|| vec![0.0; self.points * self.steps]);
            put_steps(all, self.steps, chunk.steps, direct);
        }
    }

    /// Means of all points, by step.
    pub(super) fn means(&self) -> Vec<f32> {
        let mut sums = vec![0.0_f64; self.steps];
        for row in self.total.chunks_exact(self.steps) {
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += f64::from(*value));
        }
        sums.into_iter().map(|sum| (sum / self.points as f64) as f32).collect()
    }

    /// Writes what there is; gives the files.
    pub(super) fn write(&self, folder: &Path, name: &str, grid: &Grid) -> Result<Vec<PathBuf>> {
        let [total, direct, points] = paths(folder, name);
        put(&total, &to_npy(self.points, self.steps, &self.total))?;
        put(&points, table(grid).as_bytes())?;
        let mut written = vec![total, points];
        if let Some(values) = &self.direct {
            put(&direct, &to_npy(self.points, self.steps, values))?;
            written.push(direct);
        }
        Ok(written)
    }
}

/// Copies a chunk's columns to their places.
fn put_steps(all: &mut [f32], steps: usize, places: &[usize], chunk: &[f32]) {
    for (row, values) in all.chunks_exact_mut(steps).zip(chunk.chunks_exact(places.len())) {
        places.iter().zip(values).for_each(|(place, value)| row[*place] = *value);
    }
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
