//! A year of daylight without ray tracing: the sky's matrix of a weather file, its product with daylight coefficients, and what practice asks of it.
//!
//! [`Year::read`] takes an EPW or WEA file, [`sky::SkyMatrix`] gives every patch's radiance as Radiance's `gendaymtx` does, [`Coefficients::read`]
//! takes what a ray tracer found, [`evaluate`] puts them together and gives a [`Grid`] of metrics.
//!
//! Directions are (east, north, up), angles in radians where their names do not say degrees, hours those of the weather file's clock.

#![forbid(unsafe_code)]

mod coefficients;
mod daylight_factor;
mod division;
mod error;
mod evaluate;
mod metrics;
mod product;
mod schedule;
pub mod sky;
mod sun;
#[cfg(test)]
mod tests;
mod year;

pub use coefficients::{Coefficients, to_npy};
pub use division::{Division, FINEST, Patch};
pub use error::AnnualError;
pub use evaluate::{Blinds, Chunk, Group, Settings, evaluate};
pub use metrics::{En17037, Grid, GridErrors, Level, Method, Point};
pub use product::Panels;
pub use schedule::Schedule;
pub use sun::{SUN_ANGLE_DEG, Sun};
pub use year::{Step, USUAL_DEW_POINT_C, Year};

use gonio_formats::FormatError;
use std::{fs::File, io::Read, path::Path};

/// The bytes of a file of at most `longest`.
fn read_file(path: &Path, longest: u64, what: &str) -> Result<Vec<u8>, AnnualError> {
    let refused = |source| AnnualError::File { path: path.into(), source };
    let file = File::open(path).map_err(refused)?;
    let mut bytes = Vec::new();
    file.take(longest + 1).read_to_end(&mut bytes).map_err(refused)?;
    if bytes.len() as u64 > longest {
        return Err(AnnualError::content(path, FormatError::whole(format!("more than {longest} bytes: no {what}"))));
    }
    Ok(bytes)
}
