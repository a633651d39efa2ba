//! Against published values and the standards' formulas.

mod atmosphere;
mod bad_input;
mod models;
mod moments;
mod picture;
mod spectra;
mod sun;

use super::{Daylight, Moment, Place};

/// A place and a moment that matter to nothing but the sun's distance.
fn somewhere() -> Daylight {
    let place = Place { latitude_deg: 45.0, longitude_deg: 0.0, elevation_m: 0.0 };
    Daylight::new(place, Moment { year: 2024, month: 4, day: 3, hour: 12.0, utc_offset_h: 0.0 })
}
