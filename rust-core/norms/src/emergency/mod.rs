//! Emergency lighting after EN 1838: where light is to be measured on escape routes, in open areas and at points of emphasis, what the readings come to,
//! and from where luminaires may dazzle. Measured by direct light alone.

mod figures;
mod plan;
mod spots;
mod text;

#[cfg(test)]
mod tests;

pub use figures::{Figures, Lamp};
pub use plan::{Area, Place, Plan, Route};
pub use text::lines;
