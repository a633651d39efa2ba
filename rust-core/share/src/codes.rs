//! Light in whole steps of its logarithm: 0 is black, each further code is the same share brighter than the one before.

/// Light this many powers of two below a group's mean is black.
const DEPTH: f64 = 20.0;

/// How codes of a group mean light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// Binary logarithm of the light that code 1 stands for.
    pub low: f64,
    /// Codes in each power of two.
    pub per_stop: u32,
}

impl Steps {
    /// Steps that reach from 2⁻²⁰ of the mean of a group's values up; values are finite, what is not above 0 is black.
    pub fn of(values: &[f32], per_stop: u32) -> Self {
        let sum: f64 = values.iter().map(|value| f64::from(value.max(0.0))).sum();
        let mean = sum / values.len().max(1) as f64;
        let low = if mean > 0.0 { (mean.log2() - DEPTH).floor() } else { 0.0 };
        Self { low, per_stop }
    }

    /// The code nearest to a light, by logarithm.
    pub fn code(self, light: f32) -> u16 {
        if light <= 0.0 {
            return 0;
        }
        let place = (f64::from(light).log2() - self.low) * f64::from(self.per_stop);
        // Singles span 277 powers of two: their codes fit.
        if place < -0.5 { 0 } else { 1 + place.round() as u16 }
    }

    /// The light that a code stands for.
    pub fn light(self, code: u16) -> f64 {
        if code == 0 { 0.0 } else { (self.low + f64::from(code - 1) / f64::from(self.per_stop)).exp2() }
    }

    /// The largest share by which a code's light differs from the light that it was made of.
    pub fn error(self) -> f64 {
        (0.5 / f64::from(self.per_stop)).exp2() - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_comes_back_within_half_a_step() {
        let values: Vec<f32> = (0..4000u16).map(|i| 10f32.powf(f32::from(i) * 2e-3 - 4.0)).collect();
        for per_stop in [96, 32] {
            let steps = Steps::of(&values, per_stop);
            for value in &values {
                let back = steps.light(steps.code(*value));
                let share = (back / f64::from(*value)).log2().abs() * f64::from(per_stop);
                assert!(share <= 0.5 + 1e-9 || f64::from(*value).log2() < steps.low, "{value} became {back}");
            }
        }
    }

    #[test]
    fn black_stays_black_and_far_below_the_mean_is() {
        let steps = Steps::of(&[0.0, -1.0, 8.0, 8.0], 96);
        assert_eq!([0.0, -1.0, 1e-9].map(|light| steps.code(light)), [0; 3]);
        assert_eq!(steps.light(0), 0.0);
        assert_eq!(Steps::of(&[0.0; 3], 96).code(0.0), 0);
        assert_eq!(Steps::of(&[], 96).low, 0.0);
    }

    #[test]
    fn all_singles_have_codes() {
        let steps = Steps::of(&[f32::MIN_POSITIVE; 4], 96);
        let back = steps.light(steps.code(f32::MAX));
        assert!((back / f64::from(f32::MAX) - 1.0).abs() <= steps.error() * 1.01);
    }
}
