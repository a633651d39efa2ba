//! What can be wrong with a problem.

use thiserror::Error;

/// Why there is no dimming.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DimmingError {
    /// A target's text cannot be read.
    #[error("'{text}' was found, {problem}")]
    Target {
        /// The text.
        text: String,
        /// What is wrong, and what was expected.
        problem: String,
    },
    /// A number or a name of the problem is wrong.
    #[error("{0}")]
    Problem(String),
    /// The solver gave up.
    #[error("the linear program of the dimming has no answer: {0}")]
    Solver(String),
}
