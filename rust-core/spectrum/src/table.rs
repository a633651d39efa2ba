//! Tables of the CIE over wavelengths in even steps.

/// Columns over wavelengths in even steps, linear between them and zero outside.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) names: Vec<&'static str>,
    start: f64,
    step: f64,
    columns: Vec<Vec<f64>>,
}

impl Table {
    /// A table of `data`: a line of names, then wavelength and values; empty cells are zero.
    pub(crate) fn new(text: &'static str) -> Self {
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next().unwrap_or_default().split(',').skip(1).collect();
        let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(0.0)).collect()).collect();
        let columns = (1..=names.len()).map(|column| rows.iter().map(|row| row[column]).collect()).collect();
        Self { names, start: rows[0][0], step: rows[1][0] - rows[0][0], columns }
    }

    /// A table of columns.
    pub(crate) fn of(start: f64, step: f64, columns: Vec<Vec<f64>>) -> Self {
        Self { names: Vec::new(), start, step, columns }
    }

    /// The wavelengths, nm, and a column's values.
    pub(crate) fn column(&self, column: usize) -> (Vec<f64>, &[f64]) {
        let values = &self.columns[column];
        ((0..values.len()).map(|k| self.start + self.step * k as f64).collect(), values)
    }

    /// A column's value at a wavelength in nm.
    pub(crate) fn at(&self, column: usize, nm: f64) -> f64 {
        let values = &self.columns[column];
        let place = (nm - self.start) / self.step;
        if !(0.0..=(values.len() - 1) as f64).contains(&place) {
            return 0.0;
        }
        let low = place.floor() as usize;
        let high = (low + 1).min(values.len() - 1);
        values[low] + (place - low as f64) * (values[high] - values[low])
    }

    /// The first `N` columns' values at a wavelength in nm.
    pub(crate) fn all<const N: usize>(&self, nm: f64) -> [f64; N] {
        std::array::from_fn(|column| self.at(column, nm))
    }
}

/// A curve's value at a wavelength in nm: linear between its points, zero beyond them.
pub(crate) fn linear(wavelengths: &[f64], power: &[f64], nm: f64) -> f64 {
    let above = wavelengths.partition_point(|point| *point < nm);
    if above == 0 || above == wavelengths.len() {
        return 0.0;
    }
    let t = (nm - wavelengths[above - 1]) / (wavelengths[above] - wavelengths[above - 1]);
    power[above - 1] + t * (power[above] - power[above - 1])
}
