//! One axis: knots, and the search for the interval that holds a value.

use gonio_simd::{F, Lanes, U};
use std::f32::consts::TAU;

/// Up to this many knots the search compares with all of them.
const COMPARED: usize = 64;
/// Up to this many knots stand in registers.
const IN_REGISTERS: usize = 32;

/// Strictly increasing knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    knots: Vec<f32>,
    /// Each interval's lower knot and the reciprocal of its width, one after the other.
    intervals: Vec<f32>,
    /// The same for axes whose intervals fit in registers; infinity behind the last start.
    starts: [f32; IN_REGISTERS],
    reciprocals: [f32; IN_REGISTERS],
    /// Halvings of these intervals until one is left.
    halvings: u32,
    /// For longer axes.
    guide: Option<Guide>,
    around: Around,
    nearest: bool,
}

/// What happens beyond the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Around {
    /// The ends' values hold.
    Nothing,
    /// All repeats after this distance, which the last knot is from the first.
    Period(f32),
    /// A turn changes nothing; in the gap between the last knot and the first the nearer one holds.
    Turn,
}

/// Where to start searching: for each of many equal cells, the interval that holds the cell's lower end.
#[derive(Clone, Debug, PartialEq)]
struct Guide {
    /// Cells per unit.
    density: f32,
    first: Vec<u32>,
    /// Steps that lead from there to any value's interval.
    steps: u32,
}

/// An interval, and how far a value lies into it.
#[derive(Clone, Copy, Debug)]
pub struct Place<L: Lanes> {
    /// Number of the lower knot.
    pub index: U<L>,
    /// 0 at the lower knot, 1 at the upper one.
    pub fraction: F<L>,
}

impl Axis {
    /// An axis with these knots; `None` unless there is one and they are finite and strictly increase.
    pub fn new(knots: Vec<f32>) -> Option<Self> {
        if knots.is_empty() || knots.iter().any(|knot| !knot.is_finite()) || knots.windows(2).any(|pair| pair[0] >= pair[1]) {
            return None;
        }
        let width = |pair: &[f32]| if pair.len() > 1 { 1.0 / (pair[1] - pair[0]) } else { 0.0 };
        let pairs = || knots.windows(2.min(knots.len()));
        let intervals: Vec<f32> = pairs().flat_map(|pair| [pair[0], width(pair).min(f32::MAX)]).collect();
        let (mut starts, mut reciprocals) = ([f32::INFINITY; IN_REGISTERS], [0.0; IN_REGISTERS]);
        starts[0] = knots[0];
        for (place, interval) in intervals.as_chunks::<2>().0.iter().take(IN_REGISTERS).enumerate() {
            [starts[place], reciprocals[place]] = *interval;
        }
        let halvings = (knots.len() - 1).next_power_of_two().ilog2();
        let guide = (knots.len() > COMPARED).then(|| Guide::new(&knots));
        Some(Self { knots, intervals, starts, reciprocals, halvings, guide, around: Around::Nothing, nearest: false })
    }

    /// An axis on which all repeats after `period`; the first knot's repetition is added, so that neighbours lie side by side. `None` as for
    /// [`Self::new`], the repetition included.
    pub fn periodic(mut knots: Vec<f32>, period: f32) -> Option<Self> {
        knots.push(knots.first()? + period);
        Some(Self { around: Around::Period(period), ..Self::new(knots)? })
    }

    /// The same of angles in radians about something: values are first brought to the knots by whole turns.
    #[must_use]
    pub fn turning(self) -> Self {
        Self { around: Around::Turn, ..self }
    }

    /// The same with the nearest knot's value everywhere.
    #[must_use]
    pub fn nearest(self) -> Self {
        Self { nearest: true, ..self }
    }

    /// Whether the last knot is the first one's repetition.
    pub fn repeats(&self) -> bool {
        matches!(self.around, Around::Period(_))
    }

    /// Knots.
    #[expect(clippy::len_without_is_empty, reason = "an axis has one knot at least")]
    pub fn len(&self) -> usize {
        self.knots.len()
    }

    /// The knots, in order.
    pub fn knots(&self) -> &[f32] {
        &self.knots
    }

    /// The first and the last knot.
    pub fn range(&self) -> [f32; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// The interval of each value; values beyond the ends are taken to the ends.
    #[inline(always)]
    pub fn locate<L: Lanes>(&self, l: L, x: F<L>) -> Place<L> {
        let x = self.brought(x);
        let index = match &self.guide {
            Some(guide) => self.search_from(l, x, guide),
            // Of sixteen lanes a lookup in registers is one instruction.
            None if L::COUNT == 16 && self.intervals.len() <= 2 * IN_REGISTERS => self.halve(l, x),
            None => self.count(l, x),
        };
        let (start, reciprocal) = if self.intervals.len() <= 2 * IN_REGISTERS {
            (l.lookup32(&self.starts, index), l.lookup32(&self.reciprocals, index))
        } else {
            let [start, reciprocal] = l.gather_pairs(&self.intervals, index << 1);
            (start, reciprocal)
        };
        let fraction = ((x - start) * reciprocal).saturate();
        Place { index, fraction: if self.nearest { l.f(1.0).keep_if(fraction.ge(0.5)) } else { fraction } }
    }

    /// A value brought to the knots by whole periods.
    #[inline(always)]
    fn brought<L: Lanes>(&self, x: F<L>) -> F<L> {
        let [first, last] = self.range();
        match self.around {
            Around::Nothing => x,
            Around::Period(period) => x - ((x - first) * period.recip()).floor() * period,
            Around::Turn => {
                let x = x - ((x - first) * TAU.recip()).floor() * TAU;
                (x - last).gt(first + TAU - x).select(x.lanes().f(first), x)
            }
        }
    }

    /// How many inner knots do not exceed each value.
    #[inline(always)]
    fn count<L: Lanes>(&self, l: L, x: F<L>) -> U<L> {
        let mut index = l.u(0);
        for knot in self.knots.iter().take(self.knots.len() - 1).skip(1) {
            index += x.ge(*knot).to_integers();
        }
        index
    }

    /// [`Self::count`] by halving, with the knots in registers.
    #[inline(always)]
    fn halve<L: Lanes>(&self, l: L, x: F<L>) -> U<L> {
        let mut index = l.u(0);
        for step in (0..self.halvings).rev() {
            let next = index + (1 << step);
            index = x.ge(l.lookup32(&self.starts, next)).select(next, index);
        }
        // Infinity is not below the places without knots.
        index.min(self.knots.len().saturating_sub(2) as u32)
    }

    #[inline(always)]
    fn search_from<L: Lanes>(&self, l: L, x: F<L>, guide: &Guide) -> U<L> {
        let last = self.knots.len() as u32 - 2;
        let cell = ((x - self.knots[0]) * guide.density).clamp(0.0, (guide.first.len() - 1) as f32).to_i32();
        let mut index = l.gather_integers(&guide.first, cell);
        for _ in 0..guide.steps {
            let next = (index + 1).min(last);
            index = x.ge(l.gather(&self.knots, next)).select(next, index);
        }
        index
    }
}

impl Guide {
    /// Four cells a knot on average.
    fn new(knots: &[f32]) -> Self {
        let cells = knots.len() * 4;
        let span = knots[knots.len() - 1] - knots[0];
        let density = (cells as f32 / span).min(f32::MAX);
        // A cell's number as the search rounds it, so that no value is beyond the steps from its cell.
        let cell = |x: f32| (((x - knots[0]) * density) as usize).min(cells - 1);
        let mut first = vec![0; cells];
        let mut steps = 0;
        let mut interval = 0;
        let mut knot = 1;
        for (number, entry) in first.iter_mut().enumerate() {
            // Knots of earlier cells lie below all values of this one.
            while knot < knots.len() - 1 && cell(knots[knot]) < number {
                interval = knot as u32;
                knot += 1;
            }
            *entry = interval;
            let within = knots[knot..knots.len() - 1].iter().take_while(|k| cell(**k) == number).count();
            steps = steps.max(within as u32);
        }
        Self { density, first, steps }
    }
}
