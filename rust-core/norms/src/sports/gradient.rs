//! How fast the light changes from a point to its neighbours.

use crate::lit::{Lit, Reading};

/// The steepest change of all neighbours along and across a field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Gradient {
    /// The greater over the lesser illuminance of two neighbours, with its standard error.
    pub(crate) ratio: Option<[f64; 2]>,
    /// Their difference in per cent of the greater, for so many metres as are asked for, with its standard error.
    pub(crate) percent: Option<[f64; 2]>,
}

impl Gradient {
    /// Of points row by row, so many along and across and so many metres from one to the next, for a way of `over` metres.
    pub(crate) fn new(lit: &Lit, [columns, rows]: [u32; 2], steps: [f64; 2], over: f64) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let at = |column: usize, row: usize| lit.readings.get(row * columns + column).copied().unwrap_or_default();
        let along = (0..rows).flat_map(|row| (1..columns).map(move |column| (at(column - 1, row), at(column, row), steps[0])));
        let across = (1..rows).flat_map(|row| (0..columns).map(move |column| (at(column, row - 1), at(column, row), steps[1])));
        along.chain(across).fold(Self::default(), |steepest, (a, b, step)| steepest.or(&Self::between(a, b, over / step)))
    }

    fn between(a: Reading, b: Reading, ways: f64) -> Self {
        let (more, less) = if a.lx >= b.lx { (a, b) } else { (b, a) };
        let part = less.over(more);
        Self { ratio: more.over(less), percent: part.map(|[part, error]| [100.0 * (1.0 - part) * ways, 100.0 * error * ways]) }
    }

    fn or(&self, other: &Self) -> Self {
        let steeper = |a: Option<[f64; 2]>, b: Option<[f64; 2]>| match (a, b) {
            (Some(a), Some(b)) => Some(if b[0] > a[0] { b } else { a }),
            (a, b) => a.or(b),
        };
        Self { ratio: steeper(self.ratio, other.ratio), percent: steeper(self.percent, other.percent) }
    }
}
