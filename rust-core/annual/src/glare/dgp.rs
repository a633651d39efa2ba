//! Daylight glare probability.

/// Daylight glare probability (Wienold and Christoffersen 2006) of E_v lx at the eye: 5.87·10⁻⁵ E_v + 0.0918 log₁₀(1 + s / E_v^1.87) + 0.16, at most 1, where
/// s is Σ L² ω / P² over the sources.
pub fn dgp(illuminance: f64, sources: f64) -> f64 {
    let of_sources = if illuminance > 0.0 { sources / illuminance.powf(1.87) } else { 0.0 };
    (5.87e-5 * illuminance + 0.0918 * (1.0 + of_sources).log10() + 0.16).min(1.0)
}

/// The same with Wienold's correction for little light, as evalglare has it below 1000 lx: times e^(0.024 E_v − 4) / (1 + e^(0.024 E_v − 4)).
pub fn dgp_low_light(illuminance: f64, sources: f64) -> f64 {
    let (dgp, exponential) = (dgp(illuminance, sources), (0.024 * illuminance.min(1000.0) - 4.0).exp());
    if illuminance < 1000.0 { dgp * exponential / (1.0 + exponential) } else { dgp }
}

/// The value of an hour: [`dgp_low_light`], 0 in the dark.
pub(super) fn of_hour(illuminance: f64, sources: f64) -> f64 {
    if illuminance > 0.0 { dgp_low_light(illuminance, sources) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_wienolds() {
        assert!((dgp(3000.0, 0.0) - 0.3361).abs() < 1e-9);
        assert!((dgp(3000.0, 3000_f64.powf(1.87) * 9.0) - 0.4279).abs() < 1e-9);
        assert!((of_hour(3000.0, 0.0) - 0.3361).abs() < 1e-9);
        assert!(of_hour(100.0, 1e9) < 0.2 && of_hour(0.0, 1e9) == 0.0);
    }
}
