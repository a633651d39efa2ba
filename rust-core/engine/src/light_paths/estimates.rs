//! Means over batches, and their standard errors.

use super::{Channels, FixedSums, WorkerSums};
use crate::colour::luminance;
use std::sync::{Mutex, PoisonError};

/// Sums over batches and squares of batches' luminance, by cell: the same bits whatever the order of the batches.
#[derive(Debug)]
pub struct BatchEstimates {
    sums: FixedSums,
    /// In the square of the sums' units.
    squares: Mutex<Box<[u128]>>,
}

/// A mean over batches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The mean of a path, by channel.
    pub mean: Channels,
    /// The variance of the mean's luminance, by what batches differ.
    pub variance: f64,
}

impl Estimate {
    /// The mean's luminance.
    pub fn luminance(&self) -> f64 {
        luminance(self.mean)
    }

    /// The standard error of the mean's luminance.
    pub fn error(&self) -> f64 {
        self.variance.sqrt()
    }

    /// The standard error over the value; infinite where there is no value.
    pub fn relative_error(&self) -> f64 {
        let value = self.luminance().abs();
        if value > 0.0 { self.error() / value } else { f64::INFINITY }
    }

    /// The same in another unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { mean: self.mean.map(|x| x * factor), variance: self.variance * factor * factor }
    }

    /// With another's that is independent of it.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self { mean: [0, 1, 2].map(|k| self.mean[k] + other.mean[k]), variance: self.variance + other.variance }
    }
}

impl BatchEstimates {
    /// Empty ones; `typical` is what a path carries, `most` the most paths there may be.
    pub fn new(cells: usize, typical: Channels, most: u64) -> Self {
        Self { sums: FixedSums::new(cells, typical, most), squares: Mutex::new(vec![0; cells].into()) }
    }

    /// Ends a worker's batch.
    pub fn complete(&self, worker: &mut WorkerSums) {
        worker.complete(&self.sums);
    }

    /// Adds what a worker's complete batches brought, and empties them.
    pub fn join(&self, worker: &mut WorkerSums) {
        let mut squares = self.squares.lock().unwrap_or_else(PoisonError::into_inner);
        worker.drain(|cell, units, square| {
            self.sums.add_units(cell, units);
            squares[cell] += square;
        });
    }

    /// What a path brings to a cell in the mean, after so many batches of so many paths. With a single batch nothing is known of the error.
    ///
    /// Batches are drawn together, so that they differ more than independent ones would: the error is rather too large.
    pub fn get(&self, cell: usize, batches: u64, paths: usize) -> Estimate {
        let (count, paths) = (batches.max(1) as f64, paths as f64);
        let sum = self.sums.get(cell);
        let square = self.squares.lock().unwrap_or_else(PoisonError::into_inner)[cell] as f64 / self.sums.scale().powi(2);
        let mean = luminance(sum) / count;
        let spread = (square / count - mean * mean).max(0.0);
        let variance = if batches > 1 { spread / (count - 1.0) } else { f64::INFINITY };
        Estimate { mean: sum.map(|x| x / (count * paths)), variance: variance / (paths * paths) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_those_of_batch_means() {
        let values = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0];
        let estimates = BatchEstimates::new(2, [10.0; 3], 1 << 20);
        // Two workers that share the batches.
        for values in values.chunks(4) {
            let mut worker = WorkerSums::new(2);
            for value in values {
                // Paths of a batch count together.
                worker.add(1, [0.25 * value; 3]);
                worker.add(1, [0.75 * value; 3]);
                estimates.complete(&mut worker);
            }
            estimates.join(&mut worker);
        }
        let found = estimates.get(1, values.len() as u64, 2);
        let mean = values.iter().sum::<f64>() / 6.0;
        let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (5.0 * 6.0);
        assert!((found.luminance() - mean / 2.0).abs() < 1e-9);
        assert!((found.variance - variance / 4.0).abs() < 1e-9, "{found:?}");
        assert_eq!(estimates.get(0, 6, 2), Estimate::default());
    }
}
