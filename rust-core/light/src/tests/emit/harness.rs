//! Batches of emitted rays at any level.

use crate::tests::harness::uniform;
use crate::{EmissionSampler, EmittedRay, LightTable};
use gonio_simd::{Column, Execution, F, Lanes, dispatch, padded};

/// Rays, column by column.
pub(super) struct Rays {
    pub(super) origin: [Column; 3],
    pub(super) normal: [Column; 3],
    pub(super) direction: [Column; 3],
    pub(super) flux: [Column; 3],
    pub(super) light: Column<u32>,
    pub(super) clear: Column,
}

/// Three values of a column triple.
pub(super) fn triple(columns: &[Column; 3], i: usize) -> [f64; 3] {
    [0, 1, 2].map(|k| f64::from(columns[k][i]))
}

/// As a function of its own: with all kinds of lights it is large.
#[inline(never)]
fn sample<L: Lanes>(l: L, sampler: &EmissionSampler, table: &LightTable, u: &[F<L>; 5]) -> EmittedRay<L> {
    l.vectorize(
        #[inline(always)]
        || sampler.sample(l, table, u[0], [u[1], u[2]], [u[3], u[4]]),
    )
}

#[inline(always)]
fn kernel<L: Lanes>(l: L, sampler: &EmissionSampler, table: &LightTable, u: &[Column; 5], rays: &mut Rays) {
    for at in (0..u[0].len()).step_by(L::COUNT) {
        let numbers = [l.load(&u[0], at), l.load(&u[1], at), l.load(&u[2], at), l.load(&u[3], at), l.load(&u[4], at)];
        let ray = sample(l, sampler, table, &numbers);
        let [x, y, z] = &mut rays.origin;
        ray.origin.store([x, y, z], at);
        let [x, y, z] = &mut rays.normal;
        ray.normal.store([x, y, z], at);
        let [x, y, z] = &mut rays.direction;
        ray.direction.store([x, y, z], at);
        let [r, g, b] = &mut rays.flux;
        ray.flux.store([r, g, b], at);
        ray.light.store(&mut rays.light, at);
        ray.clear.store(&mut rays.clear, at);
    }
}

/// Rays by random numbers.
pub(super) fn shoot(execution: Execution, sampler: &EmissionSampler, table: &LightTable, seed: u64, count: usize) -> Rays {
    let mut u: [Column; 5] = std::array::from_fn(|_| Column::new(count));
    for (k, column) in u.iter_mut().enumerate() {
        for i in 0..padded(count) {
            column[i] = uniform(seed, (5 * i + k) as u64);
        }
    }
    let three = || [Column::new(count), Column::new(count), Column::new(count)];
    let mut rays =
        Rays { origin: three(), normal: three(), direction: three(), flux: three(), light: Column::new(count), clear: Column::new(count) };
    dispatch!(execution, l => kernel(l, sampler, table, &u, &mut rays));
    rays
}

/// Mean and its standard error.
pub(super) fn mean(values: impl Iterator<Item = f64>, count: usize) -> [f64; 2] {
    let (sum, square) = values.fold((0.0, 0.0), |(sum, square), x| (sum + x, square + x * x));
    let mean = sum / count as f64;
    [mean, ((square / count as f64 - mean * mean).max(0.0) / count as f64).sqrt()]
}
