//! Where the sun stands: here by Radiance's formulas (`sun.c`), which `gendaymtx` places its suns by, within about a degree of the true place.

use std::f64::consts::{PI, TAU};

/// Angle under which the sun's disc is seen, degrees.
pub const SUN_ANGLE_DEG: f64 = 0.533;

/// Days of the months of a common year.
pub(crate) const MONTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// Where the sun's centre stands, in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sun {
    /// Above the horizon; Radiance's formulas know no refraction, true places have it.
    pub altitude: f64,
    /// From north, clockwise seen from above.
    pub azimuth: f64,
}

impl Sun {
    /// Whether any of the disc is above the horizon.
    pub fn is_up(&self) -> bool {
        self.altitude > -(0.5 * SUN_ANGLE_DEG).to_radians()
    }

    /// Unit vector towards it: east, north, up.
    pub fn direction(&self) -> [f64; 3] {
        crate::division::direction(self.altitude, self.azimuth)
    }
}

/// The sun on a day of the year (1 to 366) at an hour of clocks `utc_offset_h` ahead of universal time; degrees north and east.
pub(crate) fn sun(day_of_year: u32, hour: f64, latitude_deg: f64, longitude_deg: f64, utc_offset_h: f64) -> Sun {
    let day = f64::from(day_of_year);
    let adjusted = 0.170 * (4.0 * PI / 373.0 * (day - 80.0)).sin() - 0.129 * (TAU / 355.0 * (day - 8.0)).sin();
    let solar_hour = hour + adjusted + longitude_deg / 15.0 - utc_offset_h;
    let declination = 0.4093 * (TAU / 365.0 * (day - 81.0)).sin();
    let (sin_hour, cos_hour) = (solar_hour * PI / 12.0).sin_cos();
    let ((sin_latitude, cos_latitude), (sin_declination, cos_declination)) = (latitude_deg.to_radians().sin_cos(), declination.sin_cos());
    let sine = sin_latitude * sin_declination - cos_latitude * cos_declination * cos_hour;
    let south = -cos_latitude * sin_declination - sin_latitude * cos_declination * cos_hour;
    Sun { altitude: sine.clamp(-1.0, 1.0).asin(), azimuth: PI - (cos_declination * sin_hour).atan2(south) }
}

/// Day of the year of a date as `gendaymtx` counts it; `None` if there is no such date. Days after the 29th of February count one more if it was there.
pub(crate) fn day_of_year(month: u32, day: u32, has_leap_day: bool) -> Option<u32> {
    let before: u32 = MONTHS.iter().take(month.checked_sub(1)? as usize).sum();
    let length = MONTHS.get(month as usize - 1)? + u32::from(month == 2);
    (1..=length).contains(&day).then_some(before + day + u32::from(has_leap_day && month > 2))
}
