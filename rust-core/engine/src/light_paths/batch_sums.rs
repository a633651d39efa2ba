//! What one batch brings, by cell, until it is complete.

use super::Channels;

/// Sums of one batch, in the order of its paths: a batch is one worker's, so double precision is exact enough and always the same.
#[derive(Clone, Debug)]
pub struct BatchSums {
    values: Vec<Channels>,
    /// Cells that are not empty.
    touched: Vec<u32>,
    is_touched: Vec<bool>,
}

impl BatchSums {
    /// Empty sums.
    pub fn new(cells: usize) -> Self {
        Self { values: vec![[0.0; 3]; cells], touched: Vec::new(), is_touched: vec![false; cells] }
    }

    /// Adds to a cell.
    #[inline]
    pub fn add(&mut self, cell: usize, value: Channels) {
        if !self.is_touched[cell] {
            self.is_touched[cell] = true;
            self.touched.push(cell as u32);
        }
        for (sum, value) in self.values[cell].iter_mut().zip(value) {
            *sum += value;
        }
    }

    /// Hands on what is not empty, and empties it.
    pub fn drain(&mut self, mut take: impl FnMut(usize, Channels)) {
        for cell in self.touched.drain(..) {
            let cell = cell as usize;
            self.is_touched[cell] = false;
            take(cell, std::mem::take(&mut self.values[cell]));
        }
    }
}
