//! What a year's glare comes to.

use serde::Serialize;

/// Values that EN 17037 names, the strictest first.
const LIMITS: [f64; 3] = [0.35, 0.40, 0.45];
/// Share of the used time in which a value may be exceeded (EN 17037).
const EXCEEDED: f64 = 0.05;
/// Parts of the range from 0 to 1 that values are counted in.
const BINS: usize = 1000;

/// What a year's glare at an eye comes to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EyeGlare {
    /// Share of the used time with a DGP above 0.35.
    pub above_035: f64,
    /// Above 0.40.
    pub above_040: f64,
    /// Above 0.45.
    pub above_045: f64,
    /// The value that is exceeded in 5 % of the used time.
    pub dgp_5_percent: f64,
}

impl EyeGlare {
    pub(super) fn figures(self) -> [f64; 4] {
        [self.above_035, self.above_040, self.above_045, self.dgp_5_percent]
    }

    pub(super) fn of_figures([above_035, above_040, above_045, dgp_5_percent]: [f64; 4]) -> Self {
        Self { above_035, above_040, above_045, dgp_5_percent }
    }

    /// Which of 0.35, 0.40 and 0.45 are exceeded in no more than 5 % of the used time.
    pub fn keeps(&self) -> [bool; 3] {
        [self.above_035, self.above_040, self.above_045].map(|share| share <= EXCEEDED)
    }

    /// What EN 17037 calls it, by the strictest value that it keeps.
    pub fn level(&self) -> &'static str {
        ["high", "medium", "minimum"].into_iter().zip(self.keeps()).find(|(_, keeps)| *keeps).map_or("below the minimum", |(name, _)| name)
    }
}

/// Counts of an eye's values in the used time.
#[derive(Clone, Debug)]
pub(super) struct Counted([u32; BINS + 1]);

impl Counted {
    pub(super) fn none() -> Self {
        Self([0; BINS + 1])
    }

    pub(super) fn add(&mut self, value: f64) {
        self.0[(value * BINS as f64).clamp(0.0, BINS as f64) as usize] += 1;
    }

    /// Of so many used steps; those that were not counted are dark.
    pub(super) fn glare(&self, used: f64) -> EyeGlare {
        let above = |limit: f64| self.0[(limit * BINS as f64).round() as usize..].iter().map(|count| f64::from(*count)).sum::<f64>() / used;
        let (mut more, mut value) = (0.0, 0.0);
        for bin in (0..=BINS).rev() {
            more += f64::from(self.0[bin]) / used;
            if more > EXCEEDED {
                // The last bin is of all above.
                value = ((bin as f64 + 0.5) / BINS as f64).min(1.0);
                break;
            }
        }
        let [above_035, above_040, above_045] = LIMITS.map(above);
        EyeGlare { above_035, above_040, above_045, dgp_5_percent: value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_levels_are_of_the_used_time() {
        let mut counted = Counted::none();
        (0..6).for_each(|_| counted.add(0.42));
        (0..94).for_each(|_| counted.add(0.30));
        let found = counted.glare(100.0);
        assert_eq!(found.figures()[..3], [0.06, 0.06, 0.0]);
        assert!((found.dgp_5_percent - 0.4205).abs() < 1e-9);
        assert_eq!(found.level(), "minimum");
        assert_eq!(counted.glare(200.0).level(), "high");
    }
}
