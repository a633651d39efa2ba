//! Sums of flux by cell and side, in whole numbers: they come out the same in whatever order threads add.

use crate::{colour::luminance, transport::Arrivals};
use std::sync::atomic::{AtomicI64, Ordering};

/// Parts of the whole flux that the sums count by.
const UNIT: f64 = (1u64 << 24) as f64;
/// Parts of its square.
const SQUARE_UNIT: f64 = (1u64 << 28) as f64;

/// Direct light, its square and its number stand first in a row.
const COUNT: usize = 0;
const SQUARES: usize = 1;
const FLUX: usize = 2;

/// The sums of a cell's side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sums {
    /// Arrivals.
    pub(super) count: f64,
    /// Sum of the squares of their luminous flux.
    pub(super) squares: f64,
    /// Luminous flux that came straight from lights, and all other.
    pub(super) flux: [f64; 2],
    /// Red, green and blue, if they are kept.
    pub(super) colour: [f64; 3],
}

impl Sums {
    /// Both together.
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            count: self.count + other.count,
            squares: self.squares + other.squares,
            flux: [0, 1].map(|k| self.flux[k] + other.flux[k]),
            colour: [0, 1, 2].map(|k| self.colour[k] + other.colour[k]),
        }
    }
    /// Direct and indirect luminous flux.
    pub(super) fn total(&self) -> f64 {
        self.flux[0] + self.flux[1]
    }
    /// Standard error over the value; 1 where nothing has arrived.
    pub(super) fn relative_error(&self) -> f64 {
        if self.total() == 0.0 { 1.0 } else { (self.squares.sqrt() / self.total().abs()).min(1.0) }
    }
}

/// The table.
#[derive(Debug)]
pub(super) struct FluxTable {
    sums: Vec<AtomicI64>,
    width: usize,
    /// Flux that is one.
    scale: f64,
}

impl FluxTable {
    /// Bytes of so many cells' sides.
    pub(super) fn memory(rows: u64, colours: bool) -> u64 {
        rows * 8 * Self::width(colours) as u64
    }

    fn width(colours: bool) -> usize {
        // Counts, squares, and for direct and indirect light luminous flux or three colours.
        2 + 2 * if colours { 3 } else { 1 }
    }

    /// Empty sums; `power` is the luminous flux of all lights.
    pub(super) fn new(rows: usize, colours: bool, power: f64) -> Self {
        let width = Self::width(colours);
        Self { sums: (0..rows * width).map(|_| AtomicI64::new(0)).collect(), width, scale: power }
    }

    /// Adds an arrival to a row.
    pub(super) fn add(&self, row: usize, arrivals: &Arrivals, entry: usize) {
        let colour = [0, 1, 2].map(|k| f64::from(arrivals.flux[k][entry]) / self.scale);
        let share = luminance(colour);
        let indirect = usize::from(arrivals.bounces(entry) > 0);
        let row = &self.sums[row * self.width..(row + 1) * self.width];
        let put = |at: usize, value: f64| row[at].fetch_add(value.round() as i64, Ordering::Relaxed);
        put(COUNT, 1.0);
        put(SQUARES, share * share * SQUARE_UNIT);
        if self.width == FLUX + 2 {
            put(FLUX + indirect, share * UNIT);
        } else {
            (0..3).for_each(|k| {
                put(FLUX + 3 * indirect + k, colour[k] * UNIT);
            });
        }
    }

    /// The sums of a row, in lumens times paths.
    pub(super) fn row(&self, row: usize) -> Sums {
        let row = &self.sums[row * self.width..(row + 1) * self.width];
        let at = |at: usize| row[at].load(Ordering::Relaxed) as f64;
        let value = |place: usize| at(place) / UNIT * self.scale;
        let (flux, colour) = if self.width == FLUX + 2 {
            ([value(FLUX), value(FLUX + 1)], [0.0; 3])
        } else {
            let parts = [0, 1].map(|part| [0, 1, 2].map(|k| value(FLUX + 3 * part + k)));
            (parts.map(luminance), [0, 1, 2].map(|k| parts[0][k] + parts[1][k]))
        };
        Sums { count: at(COUNT), squares: at(SQUARES) / SQUARE_UNIT * self.scale * self.scale, flux, colour }
    }
}
