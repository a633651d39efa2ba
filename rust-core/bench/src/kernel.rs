//! What a stage hands over to be measured.

use super::Breakdown;
use gonio::error::Result;
use gonio_simd::Execution;

/// A batch of work that runs at any level.
pub(super) trait Kernel {
    /// Does the work once.
    fn run(&mut self, execution: Execution) -> Result<()>;
    /// Whether there is a version on the standard library's functions.
    fn has_standard(&self) -> bool {
        false
    }
    /// Does the work on the standard library's functions, one value at a time.
    fn run_standard(&mut self) {}
    /// What the last run computed, on which all versions agree.
    fn outcome(&self) -> Outcome;
    /// Where the time of a whole render went, level by level.
    fn breakdown(&self) -> Option<Breakdown> {
        None
    }
}

/// A number that tells whether two levels did the same work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outcome {
    /// The number.
    pub(super) value: f64,
    /// How far the levels' numbers may lie apart, as a share of the number.
    pub(super) tolerance: f64,
}

/// Sums of tens of thousands of `f32` results that differ by some ulp from level to level, and by more where a result is ill-conditioned.
pub(super) const ROUNDING: f64 = 1e-4;

impl Outcome {
    /// The mean magnitude of columns of results, which may differ by rounding; results that are not finite count as 0.
    pub(super) fn of<'a>(columns: impl IntoIterator<Item = &'a [f32]>) -> Self {
        let (mut sum, mut count) = (0.0, 0.0);
        for x in columns.into_iter().flatten().filter(|x| x.is_finite()) {
            sum += f64::from(x.abs());
            count += 1.0;
        }
        Self { value: sum / f64::max(count, 1.0), tolerance: ROUNDING }
    }
}

/// A row of the table before it is measured.
pub(super) struct Case {
    /// What is done.
    pub(super) name: String,
    /// What is counted.
    pub(super) unit: &'static str,
    /// How many of these a run does.
    pub(super) count: usize,
    pub(super) kernel: Box<dyn Kernel>,
}

impl Case {
    pub(super) fn new(name: impl Into<String>, unit: &'static str, count: usize, kernel: impl Kernel + 'static) -> Self {
        Self { name: name.into(), unit, count, kernel: Box::new(kernel) }
    }
}
