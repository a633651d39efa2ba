//! What one worker's batches bring, by cell, until its work is done.

use super::{Channels, FixedSums};
use crate::colour::luminance;

/// Sums of the batch under way, and of those before it: no thread waits for another's.
#[derive(Clone, Debug)]
pub struct WorkerSums {
    /// Of the batch, in the order of its paths: a batch is one worker's, so double precision is exact enough and always the same.
    values: Vec<Channels>,
    /// The batch's cells that are not empty.
    touched: Vec<u32>,
    is_touched: Vec<bool>,
    /// Of complete batches, in units of the sums that they will be added to.
    units: Vec<[i64; 3]>,
    /// Squares of complete batches' luminance.
    squares: Vec<u128>,
}

impl WorkerSums {
    /// Empty sums.
    pub fn new(cells: usize) -> Self {
        Self {
            values: vec![[0.0; 3]; cells],
            touched: Vec::new(),
            is_touched: vec![false; cells],
            units: vec![[0; 3]; cells],
            squares: vec![0; cells],
        }
    }

    /// Adds to a cell of the batch.
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

    /// Ends the batch; `sums` have the units.
    pub(super) fn complete(&mut self, sums: &FixedSums) {
        for cell in self.touched.drain(..) {
            let cell = cell as usize;
            self.is_touched[cell] = false;
            let value = std::mem::take(&mut self.values[cell]);
            for (sum, value) in self.units[cell].iter_mut().zip(value) {
                *sum = sum.wrapping_add(sums.units(value));
            }
            let luminance = u128::from(sums.units(luminance(value)).unsigned_abs());
            self.squares[cell] += luminance * luminance;
        }
    }

    /// Hands on the sums and squares of complete batches, by cell, and empties them.
    pub(super) fn drain(&mut self, mut take: impl FnMut(usize, [i64; 3], u128)) {
        for (cell, (units, square)) in self.units.iter_mut().zip(&mut self.squares).enumerate() {
            if *units != [0; 3] || *square > 0 {
                take(cell, std::mem::take(units), std::mem::take(square));
            }
        }
    }
}
