//! Sums in fixed point: whole numbers add up to the same bits in any order.

use std::sync::atomic::{AtomicI64, Ordering};

/// R, G, B, or X, Y, Z.
pub type Channels = [f64; 3];

/// How much more than its mean share a path may carry where all paths of a sum meet in one cell: chances of lights, and roulette.
const MARGIN_BITS: i32 = 8;
/// Bits of a sum without its sign.
const BITS: i32 = 62;
/// Most bits behind the binary point, so that the scale and its inverse are normal numbers.
const MOST_SCALE: i32 = 1000;

/// Sums of three channels each, to which many threads add at once.
#[derive(Debug)]
pub struct FixedSums {
    cells: Box<[[AtomicI64; 3]]>,
    /// A power of two.
    scale: f64,
}

impl FixedSums {
    /// Empty sums with room for `most` values that are `typical` in the mean (its largest channel counts), all of them in one cell: the power
    /// of all lights, and the most paths.
    pub fn new(cells: usize, typical: Channels, most: u64) -> Self {
        let cells = (0..cells).map(|_| Default::default()).collect();
        Self { cells, scale: 2.0_f64.powi(scale_bits(typical, most)) }
    }

    /// How many sums there are.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Units that one is made of.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// A value in the sums' units; what is no number counts as nothing.
    #[inline]
    pub fn units(&self, value: f64) -> i64 {
        (value * self.scale).round_ties_even() as i64
    }

    /// Adds to a cell.
    #[inline]
    pub fn add(&self, cell: usize, value: Channels) {
        self.add_units(cell, value.map(|value| self.units(value)));
    }

    /// Adds what is in the sums' units already.
    #[inline]
    pub fn add_units(&self, cell: usize, units: [i64; 3]) {
        for (sum, units) in self.cells[cell].iter().zip(units) {
            if units != 0 {
                sum.fetch_add(units, Ordering::Relaxed);
            }
        }
    }

    /// A cell's sum.
    pub fn get(&self, cell: usize) -> Channels {
        let [r, g, b] = &self.cells[cell];
        [r, g, b].map(|sum| sum.load(Ordering::Relaxed) as f64 / self.scale)
    }
}

/// Bits behind the binary point.
fn scale_bits(typical: Channels, most: u64) -> i32 {
    let largest = typical.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return 0;
    }
    let whole = largest.log2().ceil() as i32 + most.max(1).ilog2() as i32 + 1;
    (BITS - MARGIN_BITS - whole).clamp(-MOST_SCALE, MOST_SCALE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_the_same_in_any_order_and_from_any_thread() {
        let values: Vec<f64> = (0..1000).map(|i| 1.0 / f64::from(1 + i * i % 917)).collect();
        let (forth, back, shared) = (sums(), sums(), sums());
        values.iter().for_each(|value| forth.add(0, [*value, -value, 0.0]));
        values.iter().rev().for_each(|value| back.add(0, [*value, -value, 0.0]));
        std::thread::scope(|scope| {
            for half in values.chunks(500) {
                let shared = &shared;
                scope.spawn(move || half.iter().for_each(|value| shared.add(0, [*value, -value, 0.0])));
            }
        });
        assert_eq!(forth.get(0), back.get(0));
        assert_eq!(forth.get(0), shared.get(0));
        let exact: f64 = values.iter().sum();
        assert!((forth.get(0)[0] - exact).abs() < 1e-9 * exact);
    }

    fn sums() -> FixedSums {
        FixedSums::new(2, [0.5, 1.0, 0.0], 1 << 20)
    }

    #[test]
    fn all_paths_may_meet_in_one_cell() {
        for typical in [1e-30, 1.0, 3e4, 1e30] {
            let (most, margin) = (1_u64 << 40, 200.0);
            let sums = FixedSums::new(1, [0.0, typical, 0.0], most);
            assert!(margin * typical * most as f64 * sums.scale() < i64::MAX as f64, "{typical}");
            assert!(typical * sums.scale() > 1e3, "{typical}");
        }
    }

    #[test]
    fn what_is_no_number_adds_nothing() {
        let sums = FixedSums::new(1, [0.0; 3], 1);
        sums.add(0, [f64::NAN, 3.0, 0.0]);
        assert_eq!(sums.get(0), [0.0, 3.0, 0.0]);
    }
}
