//! The virtual goniophotometer: light is followed from a luminaire's sources through the luminaire, and counted by direction where it leaves.
//!
//! C–γ photometry as in CIE 121 and EN 13032-1: the luminaire's frame has γ = 0 along −z, C0 along +x, C90 along +y. Intensities are far-field
//! ones: flux into a cell of directions over its solid angle, wherever in the luminaire it leaves.

mod angles;
pub mod colour;
mod csv;
mod division;
mod frame;
mod opening;
mod options;
mod product;
mod ray_files;
mod reading;
mod rounds;
mod run;
mod screen;
mod shining;
mod sources;
mod stop;
mod tally;

#[cfg(test)]
mod tests;

pub use crate::light_paths::Progress;
pub use angles::{Angles, MOST_DIRECTIONS, direction_of};
pub use frame::Frame;
pub use opening::{Extent, Opening};
pub use options::Options;
pub use product::Product;
pub use reading::{Fluxes, Reading, ScreenReading, Value};
pub use run::measure;
pub use screen::Screen;
pub use sources::Rays;
pub use stop::{MOST_RAYS, Stop};
