//! Emergency lighting after EN 1838: where light is to be measured on escape routes, in open areas and at points of emphasis, what the readings come to,
//! and from where luminaires may dazzle.
//!
//! The plan is a TOML file ([`Plan`]). Whoever calls measures at its points ([`Plan::spots`]) by direct light alone, and gives back readings in their
//! order ([`Figures::new`]). What a norm requires is the user's: see `gonio-verdict`.

#![forbid(unsafe_code)]

mod figures;
mod plan;
mod spots;
mod text;

#[cfg(test)]
mod tests;

pub use figures::{Figures, Lamp, Reading};
pub use plan::{Area, Place, Plan, Route};
pub use spots::Spot;
pub use text::lines;
