//! Curves by tables.

use crate::columns::Io;
use gonio_simd::{F, Lanes};

/// Shifts stepped lookups by this part of an entry, so that rounding does not fall below an entry met exactly.
const STEP_SHIFT: f32 = 1e-5;

/// One component's curve over a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    values: Vec<f32>,
    range: [f32; 2],
    /// Entries a unit of the argument; zero for an empty range.
    per_unit: f32,
    linear: bool,
    /// Slopes beyond the low and the high end.
    slopes: Option<[f32; 2]>,
}

impl Curve {
    /// From values that are evenly spread over the `range`; `linear` interpolates, else the entry below counts. Arguments outside are held to
    /// the range, or `extrapolate` goes on along the first and last two. Without values it is zero.
    pub fn new(values: impl Iterator<Item = f32>, range: [f32; 2], linear: bool, extrapolate: bool) -> Self {
        let finite = |x: f32| if x.is_finite() { x } else { 0.0 };
        let mut values: Vec<f32> = values.map(finite).collect();
        // Two entries at least, for interpolation reads pairs.
        let last = values.last().copied().unwrap_or(0.0);
        while values.len() < 2 {
            values.push(last);
        }
        let range = range.map(finite);
        let per_unit = finite((values.len() - 1) as f32 / (range[1] - range[0]));
        let slope = |entry: usize| (values[entry + 1] - values[entry]) * per_unit;
        let slopes = extrapolate.then(|| [slope(0), slope(values.len() - 2)]);
        Self { values, range, per_unit, linear, slopes }
    }

    /// The value at an argument.
    #[inline(always)]
    fn value<L: Lanes>(&self, l: L, argument: F<L>) -> F<L> {
        let last = self.values.len() - 1;
        let place = ((argument - self.range[0]) * self.per_unit).clamp(0.0, last as f32);
        let value = if self.linear {
            let below = place.floor().min((last - 1) as f32);
            let [low, high] = l.gather_pairs(&self.values, below.to_i32());
            low.lerp(high, place - below)
        } else {
            let below = (place + STEP_SHIFT).floor().min(last as f32);
            l.gather(&self.values, below.to_i32())
        };
        match self.slopes {
            None => value,
            Some([low, high]) => {
                let (below, above) = ((argument - self.range[0]).min(0.0), (argument - self.range[1]).max(0.0));
                below.mul_add(low, above.mul_add(high, value))
            }
        }
    }

    /// Looks up a column of arguments.
    #[inline(never)]
    pub(crate) fn run<L: Lanes>(&self, l: L, io: &mut Io<'_>) {
        l.vectorize(
            #[inline(always)]
            || {
                for at in (0..io.count).step_by(L::COUNT) {
                    let [argument] = io.load(l, at);
                    io.store(at, [self.value(l, argument)]);
                }
            },
        );
    }
}
