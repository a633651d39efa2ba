//! Zones of rooms after EN 12464-1: task areas with their immediate surround, the background, walls, the ceiling, and cylindrical illuminance where people are.

mod figures;
mod parts;
mod patch;
mod plan;
mod text;

#[cfg(test)]
mod tests;

pub use figures::Figures;
pub use plan::{Plan, Room, Task};
pub use text::lines;
