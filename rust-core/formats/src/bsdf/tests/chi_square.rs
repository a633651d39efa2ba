//! Pearson's test of samples against their density, over the sphere.

use core::f64::consts::{PI, TAU};

use super::super::direction::{Direction, through};
use super::super::quadrature::quadrature;
use super::super::sampling::Sampler;
use super::Random;

/// Bins over the cosine and the azimuth.
const BINS: [usize; 2] = [16, 24];

/// Points of each bin that the density is summed up at.
const POINTS: usize = 1024;

const SAMPLES: usize = 100_000;

/// Fails if samples to some view directions do not follow the density; one in a hundred of all runs with other seeds would.
pub(super) fn test(sampler: &Sampler<'_>, views: &[Direction], seed: u64) {
    // Šidák: so many tests that each may only fail with this probability.
    let level = 1.0 - 0.99_f64.powf(1.0 / views.len() as f64);
    for (i, &wo) in views.iter().enumerate() {
        let expected = expected(sampler, wo);
        let observed = observed(sampler, wo, seed + i as u64);
        let (statistic, freedom) = statistic(&expected, &observed);
        let p = upper_tail(statistic, freedom);
        assert!(
            p > level,
            "to {wo:?}: chi-square {statistic:.1} with {freedom} degrees of freedom, p = {p:.2e}, expected above {level:.1e}"
        );
    }
}

/// The integral of the density over the sphere, by a quadrature that is dense where half vectors are near the normal.
pub(super) fn integral(sampler: &Sampler<'_>, wo: Direction) -> f64 {
    let up = if wo[2] < 0.0 { through(wo) } else { wo };
    let both = |d: Direction| sampler.pdf(wo, d) + sampler.pdf(wo, through(d));
    quadrature(up, 300).map(|node| both(node.direction) * node.solid_angle).sum()
}

/// How many samples of each bin; the last is for those that gave no direction.
fn expected(sampler: &Sampler<'_>, wo: Direction) -> Vec<f64> {
    let cell = 2.0 * TAU / (BINS[0] * BINS[1] * POINTS) as f64;
    let bin = |bin: usize| {
        // Roberts' R₂ sequence: no borders of cells or patches run along its points.
        let place = |i: usize, step: f64, bin: usize, bins: usize| (bin as f64 + (0.5 + step * i as f64).fract()) / bins as f64;
        let density = |i: usize| {
            let z = 2.0 * place(i, 0.754_877_666_2, bin % BINS[0], BINS[0]) - 1.0;
            let phi = TAU * place(i, 0.569_840_290_9, bin / BINS[0], BINS[1]) - PI;
            let sine = (1.0 - z * z).sqrt();
            sampler.pdf(wo, [sine * phi.cos(), sine * phi.sin(), z])
        };
        (0..POINTS).map(density).sum::<f64>() * cell * SAMPLES as f64
    };
    (0..BINS[0] * BINS[1]).map(bin).collect()
}

/// How many samples fell into each bin.
fn observed(sampler: &Sampler<'_>, wo: Direction, seed: u64) -> Vec<f64> {
    let mut random = Random(seed);
    let mut counts = vec![0.0; BINS[0] * BINS[1]];
    for _ in 0..SAMPLES {
        if let Some(sample) = sampler.sample(wo, [random.next(), random.next(), random.next()]) {
            let z = ((0.5 + 0.5 * sample.wi[2]) * BINS[0] as f64) as usize;
            let phi = ((sample.wi[1].atan2(sample.wi[0]) + PI) / TAU * BINS[1] as f64) as usize;
            counts[z.min(BINS[0] - 1) + BINS[0] * phi.min(BINS[1] - 1)] += 1.0;
            let pdf = sampler.pdf(wo, sample.wi);
            assert!((sample.pdf / pdf - 1.0).abs() < 1e-6, "sampled with {} and {pdf} by the density", sample.pdf);
        }
    }
    counts
}

/// The statistic, with bins of few expected samples put together, and the degrees of freedom. Samples without a direction are a bin.
fn statistic(expected: &[f64], observed: &[f64]) -> (f64, f64) {
    let lost = |counts: &[f64]| SAMPLES as f64 - counts.iter().sum::<f64>();
    let mut bins: Vec<(f64, f64)> = expected.iter().copied().zip(observed.iter().copied()).collect();
    bins.push((lost(expected).max(0.0), lost(observed)));
    bins.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut sum, mut count, mut pool) = (0.0, 0.0, (0.0, 0.0));
    for (e, o) in bins {
        pool = (pool.0 + e, pool.1 + o);
        if pool.0 >= 20.0 {
            sum += (pool.1 - pool.0) * (pool.1 - pool.0) / pool.0;
            count += 1.0;
            pool = (0.0, 0.0);
        }
    }
    (sum, count - 1.0)
}

/// The probability of a larger statistic: Wilson and Hilferty's normal approximation (1931), good to a few per cent of the tail.
fn upper_tail(statistic: f64, freedom: f64) -> f64 {
    let variance = 2.0 / (9.0 * freedom);
    let z = ((statistic / freedom).cbrt() - (1.0 - variance)) / variance.sqrt();
    if z < 0.0 {
        return 0.5;
    }
    // Abramowitz and Stegun 26.2.17.
    let t = 1.0 / (1.0 + 0.231_641_9 * z);
    let series = t * (0.319_381_530 + t * (-0.356_563_782 + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    (-0.5 * z * z).exp() / TAU.sqrt() * series
}

#[test]
fn the_tail_is_the_tables() {
    // Upper five and one per cent points of chi-square with 100 degrees of freedom.
    assert!((upper_tail(124.342, 100.0) - 0.05).abs() < 1e-3);
    assert!((upper_tail(135.807, 100.0) - 0.01).abs() < 3e-4);
}
