//! r-tables: the reduced luminance coefficient by two angles.

use crate::standard::Standard;

/// A table of the reduced luminance coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// β in degrees, increasing from 0 to 180; 0 is light from beyond the point.
    pub(super) beta: Vec<f64>,
    /// tan γ, increasing from 0.
    pub(super) tangent: Vec<f64>,
    /// r in 1/sr: `values[row * beta.len() + column]`.
    pub(super) values: Vec<f64>,
}

impl Table {
    /// The same with every value times a factor.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.values.iter_mut().for_each(|value| *value *= factor);
        self
    }

    /// The largest tan γ.
    pub fn farthest(&self) -> f64 {
        self.tangent.last().copied().unwrap_or(0.0)
    }

    /// r in 1/sr at β in degrees and tan γ; nothing beyond the table's last row.
    pub fn reduced(&self, beta: f64, tangent: f64, standard: Standard) -> f64 {
        let beta = beta.abs().min(180.0);
        if tangent > self.farthest() {
            return 0.0;
        }
        let nodes = |axis: &[f64], at: f64| match standard {
            Standard::En13201 => linear(axis, at),
            Standard::Cie140 => quadratic(axis, at),
        };
        let (row, rows) = nodes(&self.tangent, tangent);
        let (column, columns) = nodes(&self.beta, beta);
        let value = |r: usize, c: usize| self.values.get((row + r) * self.beta.len() + column + c).copied().unwrap_or(0.0);
        let along = |r: usize| -> f64 { columns.iter().enumerate().map(|(c, weight)| nothing_of_nothing(*weight, || value(r, c))).sum() };
        let found: f64 = rows.iter().enumerate().map(|(r, weight)| nothing_of_nothing(*weight, || along(r))).sum();
        // A parabola through a steep fall swings below zero.
        found.max(0.0)
    }
}

/// A weight times a value that is not looked at for the weight 0: it may lie outside.
fn nothing_of_nothing(weight: f64, value: impl Fn() -> f64) -> f64 {
    if weight == 0.0 { 0.0 } else { weight * value() }
}

/// The first of the nodes about a place on an axis, and the weights of these nodes.
fn linear(axis: &[f64], at: f64) -> (usize, [f64; 3]) {
    let index = axis.partition_point(|node| *node <= at).saturating_sub(1);
    let Some(next) = axis.get(index + 1) else { return (index, [1.0, 0.0, 0.0]) };
    let t = (at - axis[index]) / (next - axis[index]);
    (index, [1.0 - t, t, 0.0])
}

/// The same for the parabola through the node that is nearest and its two neighbours.
fn quadratic(axis: &[f64], at: f64) -> (usize, [f64; 3]) {
    if axis.len() < 3 {
        return linear(axis, at);
    }
    let after = axis.partition_point(|node| *node <= at).min(axis.len() - 1).max(1);
    let nearest = if at - axis[after - 1] < axis[after] - at { after - 1 } else { after };
    let first = nearest.clamp(1, axis.len() - 2) - 1;
    let [a, b, c] = [axis[first], axis[first + 1], axis[first + 2]];
    let weight = |own: f64, p: f64, q: f64| (at - p) * (at - q) / ((own - p) * (own - q));
    (first, [weight(a, b, c), weight(b, a, c), weight(c, a, b)])
}
