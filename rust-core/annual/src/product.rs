//! Coefficients times columns of the sky: plain loops over panels of points that the compiler turns into vector instructions.

use std::thread;

/// Points of a panel.
const WIDE: usize = 8;
/// Steps that share a pass over a panel.
const TALL: usize = 4;
/// Patches whose products are summed before they join the sum: shorter sums round less.
const RUN: usize = 64;

/// Coefficients laid out for products: panels of points, in each the points of a patch beside each other.
#[derive(Clone, Debug)]
pub struct Panels {
    points: usize,
    patches: usize,
    /// `[panel][patch][point]`.
    values: Vec<f32>,
}

impl Panels {
    /// Of points × patches, row after row.
    pub fn new(points: usize, patches: usize, rows: &[f32]) -> Self {
        let mut values = vec![0.0; points.div_ceil(WIDE) * patches * WIDE];
        for (point, row) in rows.chunks_exact(patches).enumerate().take(points) {
            let panel = &mut values[point / WIDE * patches * WIDE..][..patches * WIDE];
            panel.iter_mut().skip(point % WIDE).step_by(WIDE).zip(row).for_each(|(value, coefficient)| *value = *coefficient);
        }
        Self { points, patches, values }
    }

    /// Points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Patches.
    pub fn patches(&self) -> usize {
        self.patches
    }

    /// The product with columns of the sky, one after the other, on some threads: element `[point][step]`.
    pub fn times(&self, columns: &[f32], threads: usize) -> Vec<f32> {
        let steps = columns.len() / self.patches;
        let mut product = vec![0.0; self.points * steps];
        let panels = self.points.div_ceil(WIDE).div_ceil(threads.max(1)).max(1);
        if steps > 0 {
            thread::scope(|scope| {
                let parts = product.chunks_mut(panels * WIDE * steps).zip(self.values.chunks(panels * self.patches * WIDE));
                for (product, values) in parts {
                    scope.spawn(move || {
                        let panels = product.chunks_mut(WIDE * steps).zip(values.chunks_exact(self.patches * WIDE));
                        panels.for_each(|(product, panel)| self.panel_times(panel, columns, steps, product));
                    });
                }
            });
        }
        product
    }

    /// One panel's rows of the product.
    fn panel_times(&self, panel: &[f32], columns: &[f32], steps: usize, product: &mut [f32]) {
        for (first, columns) in (0..).step_by(TALL).zip(columns.chunks(TALL * self.patches)) {
            let count = columns.len() / self.patches;
            // What is left over at the end is summed along with itself.
            let tall: [&[f32]; TALL] = std::array::from_fn(|step| &columns[step.min(count - 1) * self.patches..][..self.patches]);
            let sums = tile(panel, tall);
            for (point, row) in product.chunks_exact_mut(steps).enumerate() {
                row[first..first + count].iter_mut().zip(&sums).for_each(|(value, sums)| *value = sums[point]);
            }
        }
    }
}

/// Sums of a panel under a few columns.
fn tile(panel: &[f32], columns: [&[f32]; TALL]) -> [[f32; WIDE]; TALL] {
    let mut sums = [[0.0; WIDE]; TALL];
    let mut first = 0;
    for run in panel.chunks(RUN * WIDE) {
        let length = run.len() / WIDE;
        let columns = columns.map(|column| &column[first..first + length]);
        let mut short = [[0.0_f32; WIDE]; TALL];
        for (patch, points) in run.chunks_exact(WIDE).enumerate() {
            for (sums, column) in short.iter_mut().zip(&columns) {
                let radiance = column[patch];
                sums.iter_mut().zip(points).for_each(|(sum, coefficient)| *sum += coefficient * radiance);
            }
        }
        sums.iter_mut().flatten().zip(short.iter().flatten()).for_each(|(sum, short)| *sum += short);
        first += length;
    }
    sums
}
