//! Densities on the unit square that depend on parameters, and their maps: the interpolants of RGL files.
//!
//! Dupuy and Jakob, An Adaptive Parameterization for Efficient Material Acquisition and Rendering (2018), supplement. A slice is a bilinear
//! density; between slices both density and cumulative sums are blended linearly, so that the map is exact for the blend.

/// Up to three parameters, so up to eight slices are blended.
const MOST_SLICES: usize = 8;

/// Functions on the unit square, bilinear between nodes, one for each combination of the parameters' knots.
///
/// `data` is flat, the last parameter fastest among slices, then rows (second coordinate of the square), then columns: as in the file, and
/// what a lane kernel gathers as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Interpolant {
    /// The parameters' knots, increasing, the slowest first.
    pub parameters: Vec<Vec<f32>>,
    /// Nodes along the first coordinate.
    pub columns: usize,
    /// Nodes along the second coordinate.
    pub rows: usize,
    /// The nodes' values.
    pub data: Vec<f32>,
}

/// A density on the unit square with the cumulative sums that its map needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Warp {
    /// The density; each slice integrates to one.
    pub density: Interpolant,
    /// Integrals over the first `r + 1` rows of patches, `rows − 1` a slice.
    pub marginal: Vec<f32>,
    /// Integrals along a row of nodes up to column `c + 1`, `rows × (columns − 1)` a slice.
    pub conditional: Vec<f32>,
}

/// Slices and their weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blend {
    slice: [usize; MOST_SLICES],
    weight: [f64; MOST_SLICES],
    count: usize,
}

/// A patch's column and row, and the place inside it.
struct Patch {
    column: usize,
    row: usize,
    x: f64,
    y: f64,
}

impl Interpolant {
    /// Nodes in a slice.
    fn slice_len(&self) -> usize {
        self.rows * self.columns
    }

    /// The slices around parameters, at most three; beyond the knots the last ones hold.
    pub(crate) fn blend(&self, parameters: &[f64]) -> Blend {
        let mut blend = Blend { slice: [0; MOST_SLICES], weight: [0.0; MOST_SLICES], count: 1 };
        blend.weight[0] = 1.0;
        for (knots, &x) in self.parameters.iter().zip(parameters) {
            let (low, t) = interval(knots, x);
            for i in 0..blend.count {
                blend.slice[i] = blend.slice[i] * knots.len() + low;
            }
            if t > 0.0 {
                for i in 0..blend.count {
                    blend.slice[i + blend.count] = blend.slice[i] + 1;
                    blend.weight[i + blend.count] = blend.weight[i] * t;
                    blend.weight[i] *= 1.0 - t;
                }
                blend.count *= 2;
            }
        }
        blend
    }

    /// The value at a place of the square.
    pub(crate) fn eval(&self, at: [f64; 2], blend: &Blend) -> f64 {
        let patch = self.patch(at);
        let [c0, c1] = self.edges(&patch, blend);
        lerp(c0, c1, patch.x)
    }

    /// The patch around a place.
    fn patch(&self, at: [f64; 2]) -> Patch {
        let (x, y) = (at[0].clamp(0.0, 1.0) * (self.columns - 1) as f64, at[1].clamp(0.0, 1.0) * (self.rows - 1) as f64);
        let (column, row) = ((x as usize).min(self.columns - 2), (y as usize).min(self.rows - 2));
        Patch { column, row, x: x - column as f64, y: y - row as f64 }
    }

    /// Values at the left and the right edge of a patch, at its `y`.
    fn edges(&self, patch: &Patch, blend: &Blend) -> [f64; 2] {
        let at = patch.row * self.columns + patch.column;
        let node = |offset: usize| blend.sum(&self.data, self.slice_len(), at + offset);
        [lerp(node(0), node(self.columns), patch.y), lerp(node(1), node(self.columns + 1), patch.y)]
    }
}

impl Blend {
    /// Slices with their weights, at most eight.
    pub(crate) fn new(slices: &[(usize, f64)]) -> Self {
        let mut blend = Self { slice: [0; MOST_SLICES], weight: [0.0; MOST_SLICES], count: slices.len().min(MOST_SLICES) };
        for (i, &(slice, weight)) in slices.iter().take(MOST_SLICES).enumerate() {
            (blend.slice[i], blend.weight[i]) = (slice, weight);
        }
        blend
    }

    /// The blend of one element of all slices of `stride` elements.
    fn sum(&self, data: &[f32], stride: usize, at: usize) -> f64 {
        (0..self.count).map(|i| self.weight[i] * f64::from(data[self.slice[i] * stride + at])).sum()
    }
}

impl Warp {
    /// The map of a density that is not negative. Slices are scaled to integrate to one; one without weight becomes uniform.
    pub(crate) fn new(mut density: Interpolant) -> Self {
        let (columns, rows) = (density.columns, density.rows);
        let (mut marginal, mut conditional) = (Vec::new(), Vec::new());
        for slice in density.data.chunks_exact_mut(rows * columns) {
            let sums: Vec<f64> = slice.chunks_exact(columns).map(|row| row_integral(row).last().copied().unwrap_or(0.0)).collect();
            let total: f64 = sums.windows(2).map(|w| 0.5 * (w[0] + w[1]) / (rows - 1) as f64).sum();
            if total > 0.0 {
                slice.iter_mut().for_each(|v| *v = (f64::from(*v) / total) as f32);
            } else {
                slice.fill(1.0);
            }
            let mut sums = Vec::with_capacity(rows);
            for row in slice.chunks_exact(columns) {
                let integral = row_integral(row);
                sums.push(integral.last().copied().unwrap_or(0.0));
                conditional.extend(integral.iter().map(|&v| v as f32));
            }
            let mut sum = 0.0;
            marginal.extend(sums.windows(2).map(|w| {
                sum += 0.5 * (w[0] + w[1]) / (rows - 1) as f64;
                sum as f32
            }));
        }
        Self { density, marginal, conditional }
    }

    /// Moves uniform places to the density; the place and the density there.
    pub(crate) fn sample(&self, u: [f64; 2], blend: &Blend) -> ([f64; 2], f64) {
        let (columns, rows) = (self.density.columns, self.density.rows);
        let y = u[1].clamp(f64::EPSILON, 1.0 - f64::EPSILON) * self.marginal(rows - 1, blend);
        let row = first(rows - 2, |i| self.marginal(i + 1, blend) < y);
        let [r0, r1] = [row, row + 1].map(|r| self.conditional(r, columns - 1, blend));
        let fy = sample_segment((y - self.marginal(row, blend)) * (rows - 1) as f64, r0, r1);

        let along = |c: usize| lerp(self.conditional(row, c, blend), self.conditional(row + 1, c, blend), fy);
        let x = u[0].clamp(f64::EPSILON, 1.0 - f64::EPSILON) * along(columns - 1);
        let column = first(columns - 2, |i| along(i + 1) < x);
        let [c0, c1] = self.density.edges(&Patch { column, row, x: 0.0, y: fy }, blend);
        let fx = sample_segment((x - along(column)) * (columns - 1) as f64, c0, c1);
        let at = [(column as f64 + fx) / (columns - 1) as f64, (row as f64 + fy) / (rows - 1) as f64];
        (at, lerp(c0, c1, fx))
    }

    /// [`Warp::sample`] undone: the uniform place and the density.
    pub(crate) fn invert(&self, at: [f64; 2], blend: &Blend) -> ([f64; 2], f64) {
        let (columns, rows) = (self.density.columns, self.density.rows);
        let patch = self.density.patch(at);
        let [c0, c1] = self.density.edges(&patch, blend);
        let along = |c: usize| lerp(self.conditional(patch.row, c, blend), self.conditional(patch.row + 1, c, blend), patch.y);
        let x = segment_integral(patch.x, c0, c1) / (columns - 1) as f64 + along(patch.column);
        let [r0, r1] = [patch.row, patch.row + 1].map(|r| self.conditional(r, columns - 1, blend));
        let y = segment_integral(patch.y, r0, r1) / (rows - 1) as f64 + self.marginal(patch.row, blend);
        let share = |part: f64, whole: f64| if whole > 0.0 { (part / whole).clamp(0.0, 1.0) } else { 0.0 };
        ([share(x, along(columns - 1)), share(y, self.marginal(rows - 1, blend))], lerp(c0, c1, patch.x))
    }

    /// The integral over the first `rows` rows of patches.
    fn marginal(&self, rows: usize, blend: &Blend) -> f64 {
        if rows == 0 { 0.0 } else { blend.sum(&self.marginal, self.density.rows - 1, rows - 1) }
    }

    /// The integral along a row of nodes over the first `columns` columns of patches.
    fn conditional(&self, row: usize, columns: usize, blend: &Blend) -> f64 {
        let width = self.density.columns - 1;
        if columns == 0 { 0.0 } else { blend.sum(&self.conditional, self.density.rows * width, row * width + columns - 1) }
    }
}

/// The lower of the two knots around `x`, and how far `x` is to the next.
fn interval(knots: &[f32], x: f64) -> (usize, f64) {
    if knots.len() < 2 {
        return (0, 0.0);
    }
    let low = knots.partition_point(|&k| f64::from(k) < x).saturating_sub(1).min(knots.len() - 2);
    let (start, end) = (f64::from(knots[low]), f64::from(knots[low + 1]));
    (low, ((x - start) / (end - start)).clamp(0.0, 1.0))
}

/// The first number below `count` for which `below` is false, else `count`.
fn first(count: usize, below: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = (low + high) / 2;
        if below(middle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}

/// Running integrals of a line of nodes on the unit interval.
fn row_integral(row: &[f32]) -> Vec<f64> {
    let mut sum = 0.0;
    let step = 0.5 / (row.len() - 1) as f64;
    row.windows(2)
        .map(|w| {
            sum += step * (f64::from(w[0]) + f64::from(w[1]));
            sum
        })
        .collect()
}

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + t * (b - a)
}

/// The integral from 0 to `x` of a linear function with these ends.
fn segment_integral(x: f64, v0: f64, v1: f64) -> f64 {
    x * lerp(v0, v1, 0.5 * x)
}

/// Where the integral of a linear function with these ends reaches `area`.
fn sample_segment(area: f64, v0: f64, v1: f64) -> f64 {
    // The root without cancellation when the ends are nearly equal.
    let root = (v0 * v0 + 2.0 * area * (v1 - v0)).max(0.0).sqrt();
    if v0 + root > 0.0 { (2.0 * area / (v0 + root)).clamp(0.0, 1.0) } else { 0.0 }
}
