//! EPW: a header of eight lines, then a line of 35 fields for each interval (EnergyPlus Auxiliary Programs, "EnergyPlus Weather File").

use super::{Hour, MOST_IRRADIANCE, Quantities, Weather, number, whole};
use crate::error::{FormatError, Result};
use crate::photometry::text::{Lines, parse, quote};

/// What is written where nothing was measured, W/m² and °C.
const MISSING: [f64; 2] = [9999.0, 99.9];
/// Intervals an hour, at most.
const MOST_INTERVALS: u32 = 60;
/// Years that radiation may have been measured in, or be foretold for.
const YEARS: std::ops::RangeInclusive<f64> = 1800.0..=2200.0;

/// The rest of the file from its first line on.
pub(super) fn read(lines: Lines<'_>) -> Result<Weather> {
    let mut lines = lines.filter(|(_, line)| !line.trim().is_empty());
    let mut weather = location(lines.next().unwrap_or((1, "")))?;
    let (line, periods) = lines
        .find(|(_, text)| text.trim_start().get(..12).is_some_and(|word| word.eq_ignore_ascii_case("DATA PERIODS")))
        .ok_or_else(|| FormatError::whole("the header has no line DATA PERIODS"))?;
    let intervals = whole(line, "the number of intervals an hour", periods.split(',').nth(2), 1..=MOST_INTERVALS)?;
    for (line, text) in lines {
        weather.push(line, hour(line, text, intervals)?)?;
    }
    Ok(weather)
}

fn location((line, text): (u64, &str)) -> Result<Weather> {
    let fields: Vec<&str> = text.splitn(11, ',').collect();
    let field = |index: usize| fields.get(index).copied();
    Ok(Weather {
        place: field(1).unwrap_or_default().trim().to_owned(),
        latitude_deg: number(line, "the latitude", field(6), -90.0..=90.0)?,
        longitude_deg: number(line, "the longitude", field(7), -180.0..=180.0)?,
        utc_offset_h: number(line, "the time zone", field(8), -14.0..=14.0)?,
        elevation_m: number(line, "the elevation", field(9), -500.0..=12_000.0)?,
        quantities: Quantities::NormalIrradiance,
        hours: Vec::new(),
    })
}

fn hour(line: u64, text: &str, intervals: u32) -> Result<Hour> {
    let mut fields = text.split(',');
    let mut next = |skipped: usize| fields.nth(skipped);
    let year = next(0).and_then(|token| parse(token.trim())).filter(|year| YEARS.contains(year));
    let month = whole(line, "the month", next(0), 1..=12)?;
    let day = whole(line, "the day", next(0), 1..=31)?;
    let hour = whole(line, "the hour", next(0), 1..=24)?;
    let minute = whole(line, "the minute", next(0), 0..=60)?;
    let dew_point = next(2);
    let direct_normal = irradiance(line, "the direct normal irradiance", next(6))?;
    let diffuse_horizontal = irradiance(line, "the diffuse horizontal irradiance", next(0))?;
    // Records end at their minute; hourly ones say 0 or 60 for the full hour.
    let end = if intervals == 1 || minute == 0 { 1.0 } else { f64::from(minute) / 60.0 };
    Ok(Hour {
        year: year.map(|year| year as i32),
        month,
        day,
        hour: (f64::from(hour) - 1.0 + end - 0.5 / f64::from(intervals)).max(0.0),
        direct_normal,
        diffuse_horizontal,
        dew_point_c: dew_point.and_then(|token| parse(token.trim())).filter(|value| *value < MISSING[1]),
    })
}

fn irradiance(line: u64, name: &str, token: Option<&str>) -> Result<f64> {
    let value = number(line, name, token, 0.0..=MISSING[0])?;
    match value {
        value if value <= MOST_IRRADIANCE => Ok(value),
        value if value == MISSING[0] => Err(FormatError::line(line, format!("{name} was not measured (9999)"))),
        value => Err(FormatError::line(line, format!("{name} is {}, expected at most {MOST_IRRADIANCE}", quote(&value.to_string())))),
    }
}
