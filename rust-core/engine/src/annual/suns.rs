//! Where the suns of a year stand.

use super::told;
use crate::{
    error::{Error, Result},
    sky::{Air, Moment, Place, sun_position},
};
use gonio_annual::{Step, Sun, Year};
use std::path::Path;

/// The year of records that tell none, or one in which there is no such day; of the 29th of February the leap year before it.
const USUAL_YEAR: i32 = 2025;
/// Turns of the search for the time at which the sun rises or sets: an hour over so many halves is a second.
const TURNS: usize = 12;
/// Degrees that the sun climbs in an hour, at most, and that its rays are bent by, at most.
const CLIMBS_DEG: f64 = 15.0;
const BENT_DEG: f64 = 1.0;

/// Whose formulas tell where the suns of a year stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SunPositions {
    /// NREL's, within 0.0003°, as refraction lifts it: in the middle of the interval, or of the part of it in which any of the disc is up.
    #[default]
    True,
    /// Radiance's, in the middle of the interval: as `gendaymtx` has them, within about a degree.
    Radiance,
}

impl SunPositions {
    /// By its name: `true` or `radiance`.
    ///
    /// # Errors
    /// Other names.
    pub fn parse(name: &str) -> Result<Self> {
        match name {
            "true" => Ok(Self::True),
            "radiance" => Ok(Self::Radiance),
            _ => Err(Error::setting("sun_position", format!("'{name}' was found, expected true or radiance"))),
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::True => "true",
            Self::Radiance => "radiance",
        }
    }

    /// Reads the bytes of an EPW or WEA file of a whole year; errors name its path.
    ///
    /// # Errors
    /// As [`Year::read`].
    pub fn read(self, path: &Path, bytes: &[u8]) -> Result<Year> {
        let year = Year::read(path, bytes).map_err(told)?;
        match self {
            Self::True => under_true_suns(year),
            Self::Radiance => Ok(year),
        }
    }
}

fn under_true_suns(year: Year) -> Result<Year> {
    let place = Place { latitude_deg: year.latitude_deg, longitude_deg: year.longitude_deg, elevation_m: year.elevation_m };
    let sky = Sky { place, air: Air::standard(&place), utc_offset_h: year.utc_offset_h, step_hours: year.step_hours };
    let suns = year.steps.iter().map(|step| sky.of_step(step)).collect::<Result<Vec<_>>>()?;
    Ok(year.under(&suns))
}

/// Where and by which clock suns are looked for.
struct Sky {
    place: Place,
    air: Air,
    utc_offset_h: f64,
    step_hours: f64,
}

impl Sky {
    fn at(&self, step: &Step, hour: f64) -> Result<Sun> {
        let year = step.calendar_year.unwrap_or(USUAL_YEAR);
        let moment = Moment { year, month: step.month, day: step.day, hour, utc_offset_h: self.utc_offset_h };
        let moment = moment.checked().unwrap_or(Moment { year: USUAL_YEAR - 1, ..moment });
        let found = sun_position(&self.place, &moment, &self.air)?;
        Ok(Sun { altitude: found.elevation_deg.to_radians(), azimuth: found.azimuth_deg.to_radians() })
    }

    /// The sun in the middle of the part of a step in which it is up, of the whole step where it is up or down at both ends; and when that is.
    fn of_step(&self, step: &Step) -> Result<(f64, Sun)> {
        let middle = self.at(step, step.hour)?;
        let half = 0.5 * self.step_hours;
        if middle.altitude.to_degrees().abs() > CLIMBS_DEG * half + BENT_DEG {
            return Ok((step.hour, middle));
        }
        let [from, to] = [(step.hour - half).max(0.0), (step.hour + half).min(24.0)];
        let hour = match (self.at(step, from)?.is_up(), self.at(step, to)?.is_up()) {
            (false, true) => 0.5 * (self.turn(step, from, to)? + to),
            (true, false) => 0.5 * (from + self.turn(step, to, from)?),
            _ => return Ok((step.hour, middle)),
        };
        Ok((hour, self.at(step, hour)?))
    }

    /// When it comes up or goes down between an hour at which it is down and one at which it is up.
    fn turn(&self, step: &Step, mut down: f64, mut up: f64) -> Result<f64> {
        for _ in 0..TURNS {
            let middle = 0.5 * (down + up);
            let is_up = self.at(step, middle)?.is_up();
            *(if is_up { &mut up } else { &mut down }) = middle;
        }
        Ok(up)
    }
}
