//! Ray files: where light starts at a source, where it goes to, and how much of it.
//!
//! [`read`] takes IES TM-25-13, Zemax OpticStudio's source files (binary and text) and LightTools' ray data files (binary and text), and gives
//! one [`RayFile`] in metres; [`tm25`] and [`zemax`] write, too. Layouts that their makers keep to themselves, or that leave out what a length
//! means (ASAP, SPEOS, LucidShape, TracePro, FRED), are named in the message that refuses them.

pub mod light_tools;
pub mod tm25;
pub mod zemax;

mod collect;
mod format;
mod ray_file;

pub use format::RayFormat;
pub use ray_file::{FluxUnit, LengthUnit, RayColour, RayFile, Spectrum};

use crate::error::{FormatError, Result};

/// Reads a ray file; its bytes decide which kind it is, `name` only stands behind the message when they are none.
///
/// With `lenient` a file with fewer rays than its head says gives those that are there, with a warning and the whole flux; without, it is
/// refused. Rays that cannot be used are left out and counted in either case.
///
/// # Errors
/// When the bytes are none of the formats, or not a sound file of theirs.
pub fn read(bytes: &[u8], name: &str, lenient: bool) -> Result<RayFile> {
    match RayFormat::of(bytes) {
        Some(RayFormat::Tm25) => tm25::read(bytes, lenient),
        Some(RayFormat::Zemax) => zemax::read(bytes, lenient),
        Some(RayFormat::ZemaxText) => zemax::read_text(bytes, lenient),
        Some(RayFormat::LightTools) => light_tools::read(bytes, lenient),
        Some(RayFormat::LightToolsText) => light_tools::read_text(bytes, lenient),
        None => Err(FormatError::whole(format::unknown(name))),
    }
}
