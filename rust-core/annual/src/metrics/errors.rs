//! Standard errors by the jackknife: a figure of the mean of all blocks, and the same without each of them (Efron and Stein 1981).

/// The standard error of a figure by what it is without each of the blocks.
pub(crate) fn jackknife(without: &[f64]) -> f64 {
    let count = without.len() as f64;
    let mean = without.iter().sum::<f64>() / count;
    ((count - 1.0) / count * without.iter().map(|value| (value - mean).powi(2)).sum::<f64>()).sqrt()
}
