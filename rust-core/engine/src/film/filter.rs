//! Pixel filters as tables: the inverse of their cumulative distributions.

use crate::scene::Filter;
use gonio_camera::{FilterTable, KNOTS};

/// Tabulates a filter of the given full width in pixels.
pub fn tabulate(filter: Filter, width: f32) -> FilterTable {
    let steps = 8192;
    let mut cumulative = Vec::with_capacity(steps + 1);
    let mut sum = 0.0;
    cumulative.push(0.0);
    for i in 0..steps {
        sum += weight(filter, (i as f64 + 0.5) / steps as f64 * 2.0 - 1.0);
        cumulative.push(sum);
    }
    let inverse = (0..KNOTS).map(|k| inverse_at(&cumulative, sum * k as f64 / (KNOTS - 1) as f64) * width * 0.5).collect();
    FilterTable { inverse }
}

/// Position in [-1, 1] at which the cumulative sum reaches `target`.
fn inverse_at(cumulative: &[f64], target: f64) -> f32 {
    let steps = cumulative.len() - 1;
    let i = cumulative.partition_point(|c| *c < target).clamp(1, steps);
    let (low, high) = (cumulative[i - 1], cumulative[i]);
    let fraction = if high > low { (target - low) / (high - low) } else { 0.0 };
    (((i - 1) as f64 + fraction) / steps as f64 * 2.0 - 1.0) as f32
}

/// The filter at x in [-1, 1], unnormalised.
fn weight(filter: Filter, x: f64) -> f64 {
    match filter {
        Filter::Box => 1.0,
        Filter::Tent => 1.0 - x.abs(),
        // A standard deviation of a third of the half width.
        Filter::Gaussian => (-0.5 * (3.0 * x).powi(2)).exp(),
        Filter::BlackmanHarris => {
            let t = std::f64::consts::PI * (x + 1.0);
            0.35875 - 0.48829 * t.cos() + 0.14128 * (2.0 * t).cos() - 0.01168 * (3.0 * t).cos()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_reproduces_mean_and_variance() {
        for (filter, variance) in [(Filter::Box, 1.0 / 3.0), (Filter::Tent, 1.0 / 6.0)] {
            let table = tabulate(filter, 2.0);
            let n = 20_000;
            let values: Vec<f64> = (0..n)
                .map(|i| {
                    let x = (f64::from(i) + 0.5) / f64::from(n) * 256.0;
                    let k = x as usize;
                    f64::from(table.inverse[k]) + (x - k as f64) * f64::from(table.inverse[k + 1] - table.inverse[k])
                })
                .collect();
            let mean = values.iter().sum::<f64>() / f64::from(n);
            let found = values.iter().map(|v| v * v).sum::<f64>() / f64::from(n);
            assert!(mean.abs() < 1e-4, "{filter:?}: mean {mean}");
            assert!((found - variance).abs() < 2e-3 * variance + 1e-4, "{filter:?}: variance {found}");
        }
    }

    #[test]
    fn every_filter_is_symmetric_and_inside_its_width() {
        for filter in [Filter::Box, Filter::Tent, Filter::Gaussian, Filter::BlackmanHarris] {
            let table = tabulate(filter, 1.5);
            for (a, b) in table.inverse.iter().zip(table.inverse.iter().rev()) {
                assert!((a + b).abs() < 1e-3 && a.abs() <= 0.7501, "{filter:?}");
            }
        }
    }
}
