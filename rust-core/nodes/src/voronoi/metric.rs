//! Distances.

use super::Metric;
use gonio_simd::{F, Lanes};

/// Chooses the metric of a dimension: on a line all are the same.
#[inline(always)]
pub(super) fn of_dimensions(metric: Metric, dimensions: usize) -> Metric {
    if dimensions == 1 { Metric::Manhattan } else { metric }
}

/// A number that grows with a vector's length: what comparisons need.
#[inline(always)]
pub(super) fn measure<L: Lanes, const D: usize>(metric: Metric, vector: [F<L>; D], exponent: F<L>) -> F<L> {
    let mut sum = match metric {
        Metric::Euclidean => vector[0].squared(),
        Metric::Manhattan | Metric::Chebychev => vector[0].abs(),
        Metric::Minkowski => vector[0].abs().pow(exponent),
    };
    for &component in &vector[1..] {
        sum = match metric {
            Metric::Euclidean => component.mul_add(component, sum),
            Metric::Manhattan => sum + component.abs(),
            Metric::Chebychev => sum.max(component.abs()),
            Metric::Minkowski => sum + component.abs().pow(exponent),
        };
    }
    sum
}

/// The length of a vector by its [`measure`].
#[inline(always)]
pub(super) fn length<L: Lanes>(metric: Metric, measure: F<L>, exponent: F<L>) -> F<L> {
    match metric {
        Metric::Euclidean => measure.sqrt(),
        Metric::Manhattan | Metric::Chebychev => measure,
        Metric::Minkowski => measure.pow(exponent.recip()),
    }
}

/// The square of a vector's length.
#[inline(always)]
pub(super) fn squared<L: Lanes, const D: usize>(vector: [F<L>; D]) -> F<L> {
    dot(vector, vector)
}

/// The product of two vectors.
#[inline(always)]
pub(super) fn dot<L: Lanes, const D: usize>(a: [F<L>; D], b: [F<L>; D]) -> F<L> {
    let mut sum = a[0] * b[0];
    for axis in 1..D {
        sum = a[axis].mul_add(b[axis], sum);
    }
    sum
}
