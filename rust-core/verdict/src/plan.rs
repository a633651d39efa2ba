//! A grid's values where they lie.

/// Values on a rectangle of equal cells, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plan {
    /// Cells along a row, and rows; the first row is drawn at the bottom.
    pub(crate) size: [usize; 2],
    /// Width and depth of a cell, m.
    pub(crate) spacing: [f64; 2],
    /// A value a cell, `None` where none was measured.
    pub(crate) values: Vec<Option<f64>>,
    /// What they are, as the files name it, and their unit.
    pub(crate) of: String,
    pub(crate) unit: String,
}

impl Plan {
    /// A plan whose numbers fit together and which has a value at least.
    pub(crate) fn new(size: [usize; 2], spacing: [f64; 2], values: Vec<Option<f64>>, of: &str, unit: &str) -> Option<Self> {
        let fits = size[0].checked_mul(size[1]) == Some(values.len());
        let sound = spacing.iter().all(|length| (1e-6..1e6).contains(length)) && values.iter().flatten().all(|value| value.is_finite());
        let whole = fits && sound && values.iter().flatten().next().is_some();
        whole.then(|| Self { size, spacing, values, of: of.to_owned(), unit: unit.to_owned() })
    }

    /// A coarser plan of at most so many cells, and how many of this one's cells along a side a cell of it is the mean of.
    pub(crate) fn coarser(&self, most: usize) -> (Self, usize) {
        let step = (1..).find(|step| self.size[0].div_ceil(*step) * self.size[1].div_ceil(*step) <= most.max(1)).unwrap_or(1);
        let size = self.size.map(|count| count.div_ceil(step));
        let mean = |cell: usize| {
            let [x, y] = [cell % size[0], cell / size[0]].map(|at| at * step);
            let rows = y..(y + step).min(self.size[1]);
            let within = rows.flat_map(|row| (x..(x + step).min(self.size[0])).map(move |column| row * self.size[0] + column));
            let (count, sum) =
                within.filter_map(|index| self.values[index]).fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
            (count > 0.0).then(|| sum / count)
        };
        let values = (0..size[0] * size[1]).map(mean).collect();
        let spacing = self.spacing.map(|length| length * step as f64);
        (Self { size, spacing, values, of: self.of.clone(), unit: self.unit.clone() }, step)
    }

    /// The least and the greatest value.
    pub(crate) fn range(&self) -> [f64; 2] {
        let each = || self.values.iter().flatten().copied();
        [each().fold(f64::INFINITY, f64::min), each().fold(f64::NEG_INFINITY, f64::max)]
    }
}
