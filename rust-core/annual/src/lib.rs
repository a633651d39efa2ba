//! A year of daylight without ray tracing: the sky's matrix of a weather file, its product with daylight coefficients, and what practice asks of it.
//!
//! [`Year::read`] takes an EPW or WEA file, [`sky::SkyMatrix`] gives every patch's radiance as Radiance's `gendaymtx` does, [`Coefficients::read`]
//! takes what a ray tracer found, [`evaluate`] puts them together and gives a [`Grid`] of metrics.
//!
//! Directions are (east, north, up), angles in radians where their names do not say degrees, hours those of the weather file's clock.

#![forbid(unsafe_code)]

mod chunk;
mod coefficients;
mod daylight_factor;
mod dew_point;
mod division;
mod electric;
mod error;
mod evaluate;
mod glare;
mod group;
mod metrics;
mod position_index;
mod product;
mod schedule;
mod series;
pub mod sky;
mod sun;
#[cfg(test)]
mod tests;
mod year;

pub use chunk::Chunk;
pub use coefficients::{Coefficients, to_npy};
pub use dew_point::USUAL_DEW_POINT_C;
pub use division::{Division, FINEST, Patch};
pub use electric::{Control, Electric, ElectricLight, Sensor};
pub use error::AnnualError;
pub use evaluate::{Settings, evaluate};
pub use glare::{EyeGlare, Eyes, GlareYear, Sight, Surfaces, dgp, dgp_low_light, sights};
pub use group::{Blinds, Group};
pub use metrics::{AreaErrors, En17037, En17037Errors, Grid, GridErrors, Level, Method, Point};
pub use position_index::position_index;
pub use product::Panels;
pub use schedule::Schedule;
pub use series::Series;
pub use sun::{SUN_ANGLE_DEG, Sun};
pub use year::{Step, Year};
