//! Daylight: where the sun stands, how bright sun and sky are in every direction, and the lights that make a scene see them.
//!
//! [`Daylight`] says place, moment and weather; [`Daylight::sky`] turns it into a [`Sky`] of absolute luminances, and [`Daylight::add_to`]
//! into a dome and a distant light. Nothing here draws random numbers: the same daylight gives the same bits.
//!
//! Directions are unit vectors (east, north, up). Azimuths are degrees from true north, clockwise seen from above.

mod atmosphere;
mod clear_sky;
mod colour;
mod daylight;
mod distribution;
mod frame;
mod hosek_wilkie;
mod image;
mod model;
mod moment;
mod preetham;
mod spectra;
mod sun_position;
mod weather;

pub use atmosphere::{Atmosphere, Scattering};
pub use clear_sky::{clear_sky_irradiance, extraterrestrial_irradiance, relative_air_mass};
pub use daylight::{Daylight, SUN_ANGLE_DEG, Sky};
pub use frame::{Frame, UpAxis};
pub use hosek_wilkie::{HosekWilkie, HosekWilkieChannel};
pub use image::{DEFAULT_ROWS, SkyImage, draw_by_angle};
pub use model::SkyModel;
pub use moment::Moment;
pub use preetham::Preetham;
pub use spectra::HosekWilkieBands;
pub use sun_position::{Air, Place, SunPosition, SunTimes, sun_position, sun_times};
pub use weather::in_irradiances;

pub use gonio_sky::{CIE_TYPES, CieSky, Clearness, Irradiance, PerezSky, diffuse_efficacy, direct_efficacy};

#[cfg(test)]
mod tests;

use crate::{Error, Result};

/// The number, if it is within the range.
fn within(name: &str, unit: &str, value: f64, range: std::ops::RangeInclusive<f64>) -> Result<f64> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(Error::setting(name, format!("{value} was found, expected {} to {}{unit}", range.start(), range.end())))
}
