//! Histograms of sampled directions against the density that `eval` tells.

use super::harness::{View, random};
use super::rows;
use crate::Surface;

/// Bins along azimuth and polar angle of the whole sphere.
const AZIMUTHS: usize = 24;
const HEIGHTS: usize = 24;
/// Points of the midpoint rule along each side of a bin.
const POINTS: usize = 24;
pub(super) const SAMPLES: usize = 60_000;
/// Significance of the whole family of tests; each gets its share by Šidák's correction.
const SIGNIFICANCE: f64 = 1e-3;

/// Upper tail of the chi-square distribution, by the cube-root approximation of Wilson and Hilferty.
fn tail(statistic: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let z = ((statistic / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    0.5 * erfc(z / core::f64::consts::SQRT_2)
}

/// Complementary error function (Numerical Recipes' Chebyshev fit; relative error below 1.2e-7).
fn erfc(x: f64) -> f64 {
    const C: [f64; 10] = [
        -1.265_512_23,
        1.000_023_68,
        0.374_091_96,
        0.096_784_18,
        -0.186_288_06,
        0.278_868_07,
        -1.135_203_98,
        1.488_515_87,
        -0.822_152_23,
        0.170_872_77,
    ];
    let t = 1.0 / (1.0 + 0.5 * x.abs());
    let sum = C.iter().rev().fold(0.0, |sum, c| sum * t + c);
    let upper = t * (-x * x + sum).exp();
    if x >= 0.0 { upper } else { 2.0 - upper }
}

fn bin(wi: [f32; 3]) -> usize {
    let turn = (f64::from(wi[1]).atan2(f64::from(wi[0])) / core::f64::consts::TAU).rem_euclid(1.0);
    let height = f64::from(wi[2]).clamp(-1.0, 1.0).acos() / core::f64::consts::PI;
    let cell = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
    cell(height, HEIGHTS) * AZIMUTHS + cell(turn, AZIMUTHS)
}

/// Probability of each bin by integrating the density.
fn expected(view: &View) -> Vec<f64> {
    let (rows, columns) = (HEIGHTS * POINTS, AZIMUTHS * POINTS);
    let mut directions = Vec::with_capacity(rows * columns);
    for row in 0..rows {
        let (sin, z) = ((row as f64 + 0.5) / rows as f64 * core::f64::consts::PI).sin_cos();
        for column in 0..columns {
            let phi = (column as f64 + 0.5) / columns as f64 * core::f64::consts::TAU;
            directions.push([(sin * phi.cos()) as f32, (sin * phi.sin()) as f32, z as f32]);
        }
    }
    let cell = 2.0 * core::f64::consts::PI.powi(2) / (rows * columns) as f64;
    let mut bins = vec![0.0; AZIMUTHS * HEIGHTS];
    for (direction, (_, pdf)) in directions.iter().zip(view.eval(&directions)) {
        let sin = (1.0 - f64::from(direction[2]).powi(2)).max(0.0).sqrt();
        bins[bin(*direction)] += f64::from(pdf) * sin * cell;
    }
    bins
}

/// The p-value, and the densities' integral next to the share of usable samples.
pub(super) fn test(view: &View, seed: u64) -> (f64, f64, f64) {
    let mut counts = vec![0.0; AZIMUTHS * HEIGHTS];
    let mut usable = 0.0;
    for sample in view.sample(&random(SAMPLES, seed)).iter().filter(|s| s.pdf > 0.0 && !s.delta && !s.entered) {
        counts[bin(sample.wi)] += 1.0;
        usable += 1.0;
    }
    let expected = expected(view);
    let integral: f64 = expected.iter().sum();
    let (mut statistic, mut freedom, mut rest) = (0.0, -1.0, [0.0; 2]);
    for (count, probability) in counts.iter().zip(&expected) {
        let mean = probability * SAMPLES as f64;
        if mean < 10.0 {
            rest = [rest[0] + count, rest[1] + mean];
        } else {
            statistic += (count - mean) * (count - mean) / mean;
            freedom += 1.0;
        }
    }
    if rest[1] >= 5.0 {
        statistic += (rest[0] - rest[1]) * (rest[0] - rest[1]) / rest[1];
        freedom += 1.0;
    }
    (tail(statistic, freedom), integral, usable / SAMPLES as f64)
}

/// Tests all surfaces from some views, both ways through; `rule` is the midpoint rule's error at narrow peaks.
pub(super) fn test_all(rule: f64, views: &[fn(&Surface, bool) -> View]) {
    let surfaces = rows::all();
    let tests = (2 * surfaces.len() * views.len()) as f64;
    let threshold = 1.0 - (1.0 - SIGNIFICANCE).powf(1.0 / tests);
    let mut failures = Vec::new();
    for (row, (name, surface)) in surfaces.iter().enumerate() {
        for (column, view) in views.iter().enumerate() {
            for entering in [true, false] {
                let seed = 1 + (row * 8 + column * 2 + usize::from(entering)) as u64;
                let (p, integral, usable) = test(&view(surface, entering), seed);
                // Four standard errors of the share.
                let error = 4.0 * (usable * (1.0 - usable) / SAMPLES as f64).sqrt() + rule;
                if p < threshold || (integral - usable).abs() > error {
                    failures
                        .push(format!("{name}, view {column}, entering {entering}: p {p:.2e}, integral {integral:.5}, usable {usable:.5}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "threshold {threshold:.2e}\n{}", failures.join("\n"));
}

#[test]
fn samples_follow_their_density() {
    test_all(
        2e-3,
        &[
            |surface, entering| View::new(surface, 0.0, entering),
            |surface, entering| View::new(surface, 35.0, entering),
            |surface, entering| View::new(surface, 78.0, entering),
        ],
    );
}
