//! The dimming of light groups that meets lighting targets at least power.
//!
//! Light adds up: what a point gets is what cannot be dimmed and, for each group, its level times what the group brings at full. So targets on means,
//! on the least and the greatest point and on their ratio are linear in the levels, and the least power is a linear program ([`Problem::solve`]).
//! So is the side of an isotherm that mixed light lies on, by its tristimulus values: correlated colour temperatures are limits as well.
//! Where the targets cannot be met together, the levels are those that miss them by the least sum of relative shortfalls.
//!
//! Levels are shares of the strength that was measured, from 0 to 1; power is proportional to them. Values are in the unit of what was measured.

#![forbid(unsafe_code)]

mod colour;
mod error;
mod estimate;
mod problem;
mod program;
mod reached;
mod rows;
mod solve;
mod target;
#[cfg(test)]
mod tests;

pub use colour::{Colour, Light};
pub use error::DimmingError;
pub use estimate::Estimate;
pub use problem::{Area, Goal, Group, Point, Problem};
pub use reached::{Reached, Verdict};
pub use solve::Solution;
pub use target::{Limit, Target};
