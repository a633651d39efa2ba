//! Coefficients times columns of the sky, on lanes: panels of points, a register of which meets a few columns at a time.

use gonio_simd::{Execution, F, Lanes, dispatch};
use std::thread;

/// Points of a panel.
const WIDE: usize = 16;
/// Steps that share a pass over a panel.
const TALL: usize = 8;
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
            let execution = Execution::detect();
            thread::scope(|scope| {
                let parts = product.chunks_mut(panels * WIDE * steps).zip(self.values.chunks(panels * self.patches * WIDE));
                for (product, values) in parts {
                    scope.spawn(move || {
                        let panels = product.chunks_mut(WIDE * steps).zip(values.chunks_exact(self.patches * WIDE));
                        for (product, panel) in panels {
                            dispatch!(execution, l => panel_times(l, self.patches, panel, columns, product));
                        }
                    });
                }
            });
        }
        product
    }
}

/// One panel's rows of the product.
#[inline(always)]
fn panel_times<L: Lanes>(l: L, patches: usize, panel: &[f32], columns: &[f32], product: &mut [f32]) {
    let steps = columns.len() / patches;
    for (first, columns) in (0..).step_by(TALL).zip(columns.chunks(TALL * patches)) {
        let count = columns.len() / patches;
        // What is left over at the end is summed along with itself.
        let tall: [&[f32]; TALL] = std::array::from_fn(|step| &columns[step.min(count - 1) * patches..][..patches]);
        for lane in (0..WIDE).step_by(L::COUNT) {
            let sums = tile(l, panel, lane, tall);
            for (step, sum) in sums.iter().enumerate().take(count) {
                let values = sum.to_array();
                let rows = product.chunks_exact_mut(steps).skip(lane).take(L::COUNT);
                rows.zip(values).for_each(|(row, value)| row[first + step] = value);
            }
        }
    }
}

/// Sums of a register of a panel's points under a few columns.
#[inline(always)]
fn tile<L: Lanes>(l: L, panel: &[f32], lane: usize, columns: [&[f32]; TALL]) -> [F<L>; TALL] {
    let mut sums = [l.f(0.0); TALL];
    for first in (0..columns[0].len()).step_by(RUN) {
        let end = columns[0].len().min(first + RUN);
        let mut short = [l.f(0.0); TALL];
        let mut patch = first;
        while patch < end {
            let points = l.load(panel, patch * WIDE + lane);
            for step in 0..TALL {
                short[step] = points.mul_add(l.f(columns[step][patch]), short[step]);
            }
            patch += 1;
        }
        for step in 0..TALL {
            sums[step] += short[step];
        }
    }
    sums
}
