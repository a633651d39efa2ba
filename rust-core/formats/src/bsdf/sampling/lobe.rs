//! Piecewise constant densities over the square of normals, one for each slice of view directions.

use super::super::direction::{angles_of, solid_angle_per_square};

/// Densities over the square of normals (columns along the polar angle, rows along the azimuth), for every slice of view directions.
///
/// Flat arrays, as a lane kernel searches them.
#[derive(Clone, Debug, PartialEq)]
pub struct Lobe {
    /// Cells along the polar angle.
    pub columns: usize,
    /// Cells along the azimuth.
    pub rows: usize,
    /// For each slice the share of light that this lobe has among the lobes of its side.
    pub share: Vec<f32>,
    /// For each slice the cumulative weight of columns, `columns + 1` entries from 0 to 1.
    pub marginal: Vec<f32>,
    /// For each slice and column the cumulative weight of rows, `rows + 1` entries from 0 to 1.
    pub conditional: Vec<f32>,
}

impl Lobe {
    pub(super) fn new(columns: usize, rows: usize) -> Self {
        Self { columns, rows, share: Vec::new(), marginal: Vec::new(), conditional: Vec::new() }
    }

    /// Adds a slice with these weights of cells, column by column; its share is set to their sum for now.
    pub(super) fn push(&mut self, weights: &[f64]) {
        let sums: Vec<f64> = weights.chunks_exact(self.rows).map(|column| column.iter().sum()).collect();
        cumulate(&sums, &mut self.marginal);
        weights.chunks_exact(self.rows).for_each(|column| cumulate(column, &mut self.conditional));
        self.share.push(sums.iter().sum::<f64>() as f32);
    }

    /// A place in the square from two uniform numbers.
    pub(super) fn sample(&self, slice: usize, u: [f64; 2]) -> [f64; 2] {
        let (column, x) = find(&self.marginal[slice * (self.columns + 1)..][..=self.columns], u[0]);
        let (row, y) = find(self.column(slice, column), u[1]);
        [(column as f64 + x) / self.columns as f64, (row as f64 + y) / self.rows as f64]
    }

    /// The density of a place per solid angle of normals.
    pub(super) fn density(&self, slice: usize, square: [f64; 2]) -> f64 {
        let cell = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
        let (column, row) = (cell(square[0], self.columns), cell(square[1], self.rows));
        let step = |cumulative: &[f32], i: usize| f64::from(cumulative[i + 1]) - f64::from(cumulative[i]);
        let marginal = step(&self.marginal[slice * (self.columns + 1)..], column) * self.columns as f64;
        let conditional = step(self.column(slice, column), row) * self.rows as f64;
        marginal * conditional / solid_angle_per_square(square[0]).max(f64::MIN_POSITIVE)
    }

    fn column(&self, slice: usize, column: usize) -> &[f32] {
        &self.conditional[(slice * self.columns + column) * (self.rows + 1)..][..=self.rows]
    }

    /// The angles of a cell's point, with `x` and `y` from 0 to 1 inside the cell, and the solid angle that the cell would have if all of it
    /// were like that point.
    pub(super) fn point(&self, column: usize, row: usize, x: f64, y: f64) -> ((f64, f64), f64) {
        let square = [(column as f64 + x) / self.columns as f64, (row as f64 + y) / self.rows as f64];
        (angles_of(square), solid_angle_per_square(square[0]) / (self.columns * self.rows) as f64)
    }
}

/// Cumulative weights from 0 to exactly 1; uniform if there is no weight.
fn cumulate(weights: &[f64], cumulative: &mut Vec<f32>) {
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    cumulative.push(0.0);
    for (i, weight) in weights.iter().enumerate() {
        sum += if total > 0.0 { weight / total } else { 1.0 / weights.len() as f64 };
        cumulative.push(if i + 1 == weights.len() { 1.0 } else { sum.min(1.0) as f32 });
    }
}

/// The interval of cumulative weights that holds `u`, and how far `u` is inside it.
fn find(cumulative: &[f32], u: f64) -> (usize, f64) {
    let above = cumulative.partition_point(|&c| f64::from(c) <= u).clamp(1, cumulative.len() - 1);
    let (low, high) = (f64::from(cumulative[above - 1]), f64::from(cumulative[above]));
    let inside = if high > low { (u - low) / (high - low) } else { 0.5 };
    // A place in the next cell would have another density than the one it was sampled with.
    (above - 1, inside.clamp(0.0, 1.0 - 1e-12))
}
