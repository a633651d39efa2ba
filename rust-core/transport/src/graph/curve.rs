//! Curves by tables: each component of a value looked up in its own column.

use gonio_simd::{F, Lanes};

/// Shifts stepped lookups by this part of an entry, so that rounding does not fall below an entry met exactly.
const STEP_SHIFT: f32 = 1e-5;

/// Four curves over one range.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Entries, the columns one after another.
    values: Vec<f32>,
    entries: usize,
    range: [f32; 2],
    /// Entries a unit of the argument; zero for an empty range.
    per_unit: f32,
    linear: bool,
    /// Slopes beyond the low and the high end.
    slopes: Option<[[f32; 4]; 2]>,
}

impl Curve {
    /// From rows that are evenly spread over the `range`; `linear` interpolates, else the entry below counts. Arguments outside are held to
    /// the range, or `extrapolate` goes on along the first and last two rows. Without rows it is zero.
    pub fn new(table: &[[f32; 4]], range: [f32; 2], linear: bool, extrapolate: bool) -> Self {
        let finite = |x: f32| if x.is_finite() { x } else { 0.0 };
        // Two entries at least, for interpolation reads pairs.
        let entries = table.len().max(2);
        let entry = |row: usize, column: usize| table.get(row).or(table.last()).map_or(0.0, |row| finite(row[column]));
        let values: Vec<f32> = (0..4).flat_map(|column| (0..entries).map(move |row| entry(row, column))).collect();
        let range = range.map(finite);
        let per_unit = finite((entries - 1) as f32 / (range[1] - range[0]));
        let slope = |row: usize| std::array::from_fn(|column| (entry(row + 1, column) - entry(row, column)) * per_unit);
        Self { values, entries, range, per_unit, linear, slopes: extrapolate.then(|| [slope(0), slope(entries - 2)]) }
    }

    /// The value at each component of the argument.
    #[inline(always)]
    pub(super) fn value<L: Lanes>(&self, l: L, argument: [F<L>; 4]) -> [F<L>; 4] {
        let mut out = argument;
        for (column, component) in out.iter_mut().enumerate() {
            *component = self.column_value(l, argument[column], column);
        }
        out
    }

    #[inline(always)]
    fn column_value<L: Lanes>(&self, l: L, argument: F<L>, column: usize) -> F<L> {
        let last = self.entries - 1;
        let first = (column * self.entries) as u32;
        let place = ((argument - self.range[0]) * self.per_unit).clamp(0.0, last as f32);
        let value = if self.linear {
            let below = place.floor().min((last - 1) as f32);
            let [low, high] = l.gather_pairs(&self.values, below.to_i32() + first);
            low.lerp(high, place - below)
        } else {
            let below = (place + STEP_SHIFT).floor().min(last as f32);
            l.gather(&self.values, below.to_i32() + first)
        };
        match self.slopes {
            None => value,
            Some([low, high]) => {
                let (below, above) = ((argument - self.range[0]).min(0.0), (argument - self.range[1]).max(0.0));
                below.mul_add(low[column], above.mul_add(high[column], value))
            }
        }
    }
}
