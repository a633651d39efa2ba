//! All levels send the same rays.

use super::cases::{finite, infinite, table};
use super::harness::{Rays, shoot};
use crate::{EmissionSampler, LightRecord};
use gonio_simd::Execution;

fn same(a: &Rays, b: &Rays, i: usize) -> bool {
    let close = |a: f32, b: f32, size: f32| (a - b).abs() <= 2e-3 * a.abs().max(size);
    let vectors = [(&a.origin, &b.origin, 1.0), (&a.direction, &b.direction, 1e-2), (&a.normal, &b.normal, 1e-2), (&a.flux, &b.flux, 1e-6)];
    a.light[i] == b.light[i] && vectors.iter().all(|(a, b, size)| (0..3).all(|k| close(a[k][i], b[k][i], *size)))
}

#[test]
fn all_levels_agree_with_the_scalar_one() {
    let records: Vec<LightRecord> = finite().iter().chain(&infinite()).map(|case| case.record).collect();
    let count = 1 << 13;
    for targets in [&[][..], &[([0.4f32, 0.3, 0.7], 0.5f32), ([-1.0, 0.4, 3.0], 0.4)][..]] {
        let lone = records.iter().step_by(9).map(|record| vec![*record]);
        for lights in lone.chain([records.clone()]) {
            let table = table(&lights);
            let sampler = EmissionSampler::new(&table, None, ([0.0; 3], 5.0), targets);
            let scalar = shoot(Execution::Scalar, &sampler, &table, 2, count);
            for execution in Execution::all() {
                let wide = shoot(execution, &sampler, &table, 2, count);
                let different = (0..count).filter(|i| !same(&scalar, &wide, *i)).count();
                // Roundings tip a choice here and there.
                assert!(different <= count / 200, "{}: {different} of {count} rays differ of {} lights", execution.name(), lights.len());
            }
        }
    }
}
