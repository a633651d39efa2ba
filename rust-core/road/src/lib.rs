//! Road lighting by the conventions of EN 13201-3:2015 and CIE 140: what a driver sees of a straight, level road by its rows of luminaires.
//!
//! [`Road::read`] takes a TOML file, [`Road::evaluate`] gives [`Results`], [`Road::optimise`] looks for the largest spacing that meets what
//! was required, [`text`] and [`sheet`] put results before a reader.
//!
//! The road's frame, in metres: x along the road in the direction of traffic, y from the right edge of the carriageway to the left, z up.
//! Angles are in degrees. Formulas are the norms', their tables are not part of this crate.

#![forbid(unsafe_code)]

mod areas;
mod contours;
mod energy;
mod error;
mod evaluate;
mod field;
mod glare;
mod illuminance;
mod input;
mod line;
mod luminance;
mod optimise;
mod required;
mod results;
mod road;
pub mod sheet;
mod standard;
mod surface;
#[cfg(test)]
mod tests;
pub mod text;

pub use error::RoadError;
pub use optimise::Best;
pub use required::{Class, KEYS, Requirement};
pub use results::{Classed, Edge, Energy, Field, Footing, Illuminances, Observed, Results, SurfaceFigures, Verdict};
pub use road::{Footpath, Period, Ranges, Reach, Road, Row, Side};
pub use standard::Standard;
pub use surface::{Material, Surface, Table};
