//! WEA: six lines of header, then month, day, hour and two numbers a line, whose quantities the header's last line tells (Radiance's `epw2wea` and `gendaymtx`).
//!
//! Hours are the middles of their intervals, as Daysim has them. Some programs count whole hours instead: from 0 where they begin, or up to 24 where
//! they end. Daysim's files of parts of an hour may go on from there: an hour's parts are 24.000 to 24.917 in steps of five minutes.

use super::{Hour, MOST_ILLUMINANCE, MOST_IRRADIANCE, Quantities, Weather, number, whole};
use crate::error::{FormatError, Result};
use crate::photometry::text::{Lines, quote};

/// What hours are below: parts of a 24th hour are counted from 24.
const LAST_HOUR: f64 = 25.0 - 1e-3;

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
        quantities: Quantities::default(),
        hours: Vec::new(),
    };
    let (line, units) = header("weather_data_file_units")?;
    weather.quantities = quantities(line, units)?;
    for (line, text) in lines {
        let record = hour(line, text, weather.quantities)?;
        weather.push(line, record)?;
    }
    let shift = to_middle(&weather.hours);
    weather.hours.iter_mut().for_each(|record| record.hour += shift);
    Ok(weather)
}

/// From the hours that a file counts to the middles of their intervals.
fn to_middle(hours: &[Hour]) -> f64 {
    let last = hours.iter().map(|record| record.hour).fold(0.0, f64::max);
    if last > 24.0 {
        // The day's last interval ends at midnight.
        return 24.0 - 0.5 * step(hours) - last;
    }
    let has = |hour: f64| hours.iter().any(|record| record.hour == hour);
    match (hours.iter().all(|record| record.hour.fract() == 0.0), has(0.0), has(24.0)) {
        (true, true, false) => 0.5,
        (true, false, true) => -0.5,
        _ => 0.0,
    }
}

/// The shortest time between two records of a day, hours.
fn step(hours: &[Hour]) -> f64 {
    let pairs = hours.windows(2).map(|pair| pair[1].hour - pair[0].hour);
    pairs.filter(|step| *step > 0.0).fold(1.0, f64::min)
}

/// Radiance's and Daysim's numbers of quantities.
fn quantities(line: u64, units: &str) -> Result<Quantities> {
    match units {
        "1" => Ok(Quantities::NormalIrradiance),
        "2" => Ok(Quantities::HorizontalIrradiance),
        "3" => Ok(Quantities::Illuminance),
        _ => {
            let expected = "expected 1 (W/m², the sun's on a surface that faces it), 2 (W/m², on a level one) or 3 (lx)";
            Err(FormatError::line(line, format!("weather_data_file_units is {}, {expected}", quote(units))))
        }
    }
}

fn hour(line: u64, text: &str, quantities: Quantities) -> Result<Hour> {
    let (names, most) = match quantities {
        Quantities::NormalIrradiance => (["the direct normal irradiance", "the diffuse horizontal irradiance"], MOST_IRRADIANCE),
        Quantities::HorizontalIrradiance => (["the direct horizontal irradiance", "the diffuse horizontal irradiance"], MOST_IRRADIANCE),
        Quantities::Illuminance => (["the direct normal illuminance", "the diffuse horizontal illuminance"], MOST_ILLUMINANCE),
    };
    let mut fields = text.split_whitespace();
    Ok(Hour {
        year: None,
        month: whole(line, "the month", fields.next(), 1..=12)?,
        day: whole(line, "the day", fields.next(), 1..=31)?,
        hour: number(line, "the hour", fields.next(), 0.0..=LAST_HOUR)?,
        direct_normal: number(line, names[0], fields.next(), 0.0..=most)?,
        diffuse_horizontal: number(line, names[1], fields.next(), 0.0..=most)?,
        dew_point_c: None,
    })
}
