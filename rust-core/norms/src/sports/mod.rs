//! Fields of sports after EN 12193: illuminances on the ground and towards cameras, and how luminaires dazzle those who play and watch (CIE 112).

mod figures;
mod glare;
mod gradient;
mod plan;
mod spots;
mod text;

#[cfg(test)]
mod tests;

pub use figures::Figures;
pub use glare::Source;
pub use plan::{Camera, Field, Observer, Plan};
pub use text::lines;
