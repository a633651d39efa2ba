//! Solving a problem.

use crate::{
    error::DimmingError,
    problem::Problem,
    program::Program,
    reached::{Reached, Verdict},
};

/// Levels, and what they make of the targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Of each group.
    pub levels: Vec<f64>,
    /// Of each target.
    pub targets: Vec<Reached>,
    /// Of all groups at these levels, W.
    pub watts: f64,
}

impl Solution {
    /// Whether no target is missed by more than the error.
    pub fn meets_all(&self) -> bool {
        self.targets.iter().all(|target| target.verdict != Verdict::NotMet)
    }
}

impl Problem {
    /// The levels that serve the goal best among those that meet the targets. Where none do, they miss them by the least sum of relative shortfalls.
    /// The same problem has the same answer always.
    ///
    /// # Errors
    /// Numbers out of their range, targets that name no area, and a solver that gives up.
    pub fn solve(&self) -> Result<Solution, DimmingError> {
        self.check()?;
        let levels = Program::new(self)?.levels()?;
        self.at(levels)
    }

    /// What given levels make of the targets.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn at(&self, levels: Vec<f64>) -> Result<Solution, DimmingError> {
        let targets = self.targets.iter().map(|target| Reached::new(self, target, &levels)).collect::<Result<_, _>>()?;
        let watts = self.groups.iter().zip(&levels).map(|(group, level)| group.watts * level).sum();
        Ok(Solution { levels, targets, watts })
    }
}
