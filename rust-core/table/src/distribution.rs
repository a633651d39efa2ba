//! Piecewise-constant distributions in one and two dimensions.
//!
//! Inversion keeps the order of the random numbers, so stratified points stay stratified. The search starts at a guide table (Chen and Asau,
//! On Generating Random Variates from an Empirical Distribution, AIIE Transactions 6(2), 1974) and takes two steps on average whatever the data.

use gonio_simd::{F, Lanes, U};

/// Cumulative sums of one row, ending in exactly 1, and where to start searching them. Rows without weight become uniform.
fn push_row(weights: &[f32], cumulative: &mut Vec<f32>, guide: &mut Vec<u32>) -> f64 {
    let clean = |w: f32| if w > 0.0 && w.is_finite() { f64::from(w) } else { 0.0 };
    let total: f64 = weights.iter().map(|&w| clean(w)).sum();
    let count = weights.len();
    let first = cumulative.len();
    let mut sum = 0.0;
    cumulative.push(0.0);
    for (i, &w) in weights.iter().enumerate() {
        sum += if total > 0.0 { clean(w) / total } else { 1.0 / count as f64 };
        cumulative.push(if i + 1 == count { 1.0 } else { sum.min(1.0) as f32 });
    }
    let row = &cumulative[first..];
    let mut at = 0;
    for slot in 0..=count {
        let low = slot as f32 / count as f32;
        while at + 1 < count && row[at + 1] <= low {
            at += 1;
        }
        guide.push(at as u32);
    }
    total
}

/// The interval of `cumulative[row..]` that holds `u`: lanes of different rows may search at once.
#[inline(always)]
fn find<L: Lanes>(l: L, cumulative: &[f32], guide: &[u32], row: U<L>, count: u32, u: F<L>) -> U<L> {
    // Rows of `count` intervals have `count + 1` entries in both tables.
    let start = row * (count + 1);
    let slot = (u * count as f32).to_i32().min(count - 1);
    let mut low = l.gather_integers(guide, start + slot);
    // One more interval above, because rounding may put `u` beyond its slot.
    let mut high = (l.gather_integers(guide, start + slot + 1) + 2).min(count);
    loop {
        let open = (low + 1).lt(high);
        if !open.any() {
            return low;
        }
        let middle = (low + high) >> 1;
        let above = l.gather(cumulative, start + middle).le(u);
        low = (open & above).select(middle, low);
        high = open.and_not(above).select(middle, high);
    }
}

/// A place in `[0, 1)` and the density there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample1D<L: Lanes> {
    /// The place.
    pub x: F<L>,
    /// Density with respect to `x`.
    pub pdf: F<L>,
    /// The interval that holds the place.
    pub index: U<L>,
}

/// A density on `[0, 1)`, constant on each of some equal intervals.
#[derive(Clone, Debug)]
pub(crate) struct Distribution1D {
    cumulative: Vec<f32>,
    guide: Vec<u32>,
    count: u32,
}

impl Distribution1D {
    /// In proportion to `weights`; what is not positive and finite counts as zero, and the density is uniform where nothing is left.
    pub(crate) fn new(weights: &[f32]) -> Self {
        let weights = if weights.is_empty() { &[1.0] } else { weights };
        let (mut cumulative, mut guide) = (Vec::new(), Vec::new());
        push_row(weights, &mut cumulative, &mut guide);
        Self { cumulative, guide, count: weights.len() as u32 }
    }
    /// Takes `u` in `[0, 1)` to a place.
    #[inline(always)]
    pub(crate) fn sample<L: Lanes>(&self, l: L, u: F<L>) -> Sample1D<L> {
        let index = find(l, &self.cumulative, &self.guide, l.u(0), self.count, u);
        place(l, &self.cumulative, index, index, self.count, u)
    }
    /// Density at `x`.
    #[inline(always)]
    pub(crate) fn pdf<L: Lanes>(&self, l: L, x: F<L>) -> F<L> {
        let [low, high] = l.gather_pairs(&self.cumulative, interval(x, self.count));
        (high - low) * self.count as f32
    }
}

/// The interval of `count` that holds `x`.
#[inline(always)]
fn interval<L: Lanes>(x: F<L>, count: u32) -> U<L> {
    (x.saturate() * count as f32).to_i32().min(count - 1)
}

/// The place in interval `index` whose cumulative sums start at `entry`.
#[inline(always)]
fn place<L: Lanes>(l: L, cumulative: &[f32], entry: U<L>, index: U<L>, count: u32, u: F<L>) -> Sample1D<L> {
    let [low, high] = l.gather_pairs(cumulative, entry);
    let width = high - low;
    // Below 1 by an ulp, so that the place stays in its interval.
    let inside = ((u - low) / width.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON / 2.0);
    Sample1D { x: (index.to_float() + inside) * (1.0 / count as f32), pdf: width * count as f32, index }
}

/// A density on the unit square, constant on each cell of a grid: a marginal over rows, and a conditional density in each row.
#[derive(Clone, Debug)]
pub struct Distribution2D {
    rows: Distribution1D,
    cumulative: Vec<f32>,
    guide: Vec<u32>,
    width: u32,
    mean: f64,
}

impl Distribution2D {
    /// In proportion to `weights`, row by row, `width` a row; cleaned as for [`Distribution1D::new`]. Missing weights count as zero.
    pub fn new(weights: &[f32], width: usize) -> Self {
        let width = width.max(1);
        let height = weights.len().div_ceil(width).max(1);
        let (mut cumulative, mut guide) = (Vec::with_capacity(height * (width + 1)), Vec::with_capacity(height * (width + 1)));
        let mut sums = Vec::with_capacity(height);
        let mut padded = vec![0.0; width];
        for row in 0..height {
            let given = weights.get(row * width..((row + 1) * width).min(weights.len())).unwrap_or_default();
            padded.fill(0.0);
            padded[..given.len()].copy_from_slice(given);
            sums.push(push_row(&padded, &mut cumulative, &mut guide));
        }
        let largest = sums.iter().copied().fold(0.0, f64::max);
        let relative: Vec<f32> = sums.iter().map(|s| if largest > 0.0 { (s / largest) as f32 } else { 1.0 }).collect();
        let mean = sums.iter().sum::<f64>() / (width * height) as f64;
        Self { rows: Distribution1D::new(&relative), cumulative, guide, width: width as u32, mean }
    }
    /// Mean of the weights, the integral over the unit square.
    pub fn integral(&self) -> f64 {
        self.mean
    }
    /// Takes `u` in the unit square to a place (x across a row, y along the rows) and the density there.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, u: [F<L>; 2]) -> ([F<L>; 2], F<L>) {
        let y = self.rows.sample(l, u[1]);
        let index = find(l, &self.cumulative, &self.guide, y.index, self.width, u[0]);
        let x = place(l, &self.cumulative, y.index * (self.width + 1) + index, index, self.width, u[0]);
        ([x.x, y.x], x.pdf * y.pdf)
    }
    /// Density at a place.
    #[inline(always)]
    pub fn pdf<L: Lanes>(&self, l: L, place: [F<L>; 2]) -> F<L> {
        let row = interval(place[1], self.rows.count);
        let entry = row * (self.width + 1) + interval(place[0], self.width);
        let [low, high] = l.gather_pairs(&self.cumulative, entry);
        (high - low) * self.width as f32 * self.rows.pdf(l, place[1])
    }
}
