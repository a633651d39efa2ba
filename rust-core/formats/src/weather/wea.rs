//! WEA: six lines of header, then month, day, hour and two irradiances a line (Radiance's `epw2wea` and `gendaymtx`).
//!
//! Hours are the middles of their intervals, as Daysim has them. Some programs count whole hours instead: from 0 where they begin, or up to 24 where
//! they end.

use super::{Hour, MOST_IRRADIANCE, Weather, number, whole};
use crate::error::{FormatError, Result};
use crate::photometry::text::{Lines, quote};

/// The rest of the file from its first line on.
pub(super) fn read(lines: Lines<'_>) -> Result<Weather> {
    let mut lines = lines.filter(|(_, line)| !line.trim().is_empty());
    let mut header = |name: &str| -> Result<(u64, &str)> {
        let (line, text) = lines.next().ok_or_else(|| FormatError::whole(format!("the header ends before its line '{name}'")))?;
        let value = text.trim().strip_prefix(name).filter(|rest| rest.is_empty() || rest.starts_with(char::is_whitespace));
        let problem = || FormatError::line(line, format!("{} was found, expected '{name}' and its value", quote(text.trim())));
        value.map(|value| (line, value.trim())).ok_or_else(problem)
    };
    let (_, place) = header("place")?;
    let mut value = |name: &str, range| header(name).and_then(|(line, text)| number(line, name, Some(text), range));
    let mut weather = Weather {
        place: place.to_owned(),
        latitude_deg: value("latitude", -90.0..=90.0)?,
        // West of Greenwich is positive here, and the time zone is a meridian.
        longitude_deg: -value("longitude", -180.0..=180.0)?,
        utc_offset_h: -value("time_zone", -210.0..=210.0)? / 15.0,
        elevation_m: value("site_elevation", -500.0..=12_000.0)?,
        hours: Vec::new(),
    };
    let (line, units) = header("weather_data_file_units")?;
    if units != "1" {
        let problem = format!("weather_data_file_units is {}, expected 1 (direct normal and diffuse horizontal in W/m²)", quote(units));
        return Err(FormatError::line(line, problem));
    }
    for (line, text) in lines {
        weather.push(line, hour(line, text)?)?;
    }
    let shift = to_middle(&weather.hours);
    weather.hours.iter_mut().for_each(|record| record.hour += shift);
    Ok(weather)
}

/// From the hours that a file counts to the middles of their intervals.
fn to_middle(hours: &[Hour]) -> f64 {
    let has = |hour: f64| hours.iter().any(|record| record.hour == hour);
    match (hours.iter().all(|record| record.hour.fract() == 0.0), has(0.0), has(24.0)) {
        (true, true, false) => 0.5,
        (true, false, true) => -0.5,
        _ => 0.0,
    }
}

fn hour(line: u64, text: &str) -> Result<Hour> {
    let mut fields = text.split_whitespace();
    Ok(Hour {
        month: whole(line, "the month", fields.next(), 1..=12)?,
        day: whole(line, "the day", fields.next(), 1..=31)?,
        hour: number(line, "the hour", fields.next(), 0.0..=24.0)?,
        direct_normal: number(line, "the direct normal irradiance", fields.next(), 0.0..=MOST_IRRADIANCE)?,
        diffuse_horizontal: number(line, "the diffuse horizontal irradiance", fields.next(), 0.0..=MOST_IRRADIANCE)?,
        dew_point_c: None,
    })
}
