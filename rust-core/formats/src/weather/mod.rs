//! Weather files: EnergyPlus weather (EPW) and Daysim weather (WEA), of which the irradiances are read.

mod epw;
mod wea;

use crate::error::{FormatError, Result};
use crate::photometry::text::{Lines, decode, parse, quote};

/// Most hours of a file: a leap year in steps of a minute.
const MOST_HOURS: usize = 366 * 24 * 60;
/// Beyond what the sun brings to the top of the atmosphere, W/m².
const MOST_IRRADIANCE: f64 = 1500.0;
/// The same in lx, by the highest efficacies of daylight.
const MOST_ILLUMINANCE: f64 = 250_000.0;

/// What a weather file says of its place, and its hours in the file's order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weather {
    /// The place's name; may be empty.
    pub place: String,
    /// Degrees, north positive.
    pub latitude_deg: f64,
    /// Degrees, east positive.
    pub longitude_deg: f64,
    /// Hours that the file's clock is ahead of universal time.
    pub utc_offset_h: f64,
    /// Metres above the sea.
    pub elevation_m: f64,
    /// What the two numbers of a record are.
    pub quantities: Quantities,
    /// The records.
    pub hours: Vec<Hour>,
}

/// What the numbers of records are: the first is of the sun's disc, the second of the sky on a level surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantities {
    /// W/m², the sun's on a surface that faces it.
    #[default]
    NormalIrradiance,
    /// W/m², the sun's on a level surface.
    HorizontalIrradiance,
    /// lx, the sun's on a surface that faces it.
    Illuminance,
}

/// One record: means over an interval of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hour {
    /// In which it was measured: years made up of months have several. WEA files tell none, nor do files with numbers that cannot be one.
    pub year: Option<i32>,
    /// 1 to 12.
    pub month: u32,
    /// 1 to 31.
    pub day: u32,
    /// Middle of the interval, hours since midnight, 0 to 24.
    pub hour: f64,
    /// Irradiance by the sun's disc of a surface that faces it, W/m²; or as [`Weather::quantities`] says.
    pub direct_normal: f64,
    /// Irradiance by the sky of a level surface, W/m²; or as [`Weather::quantities`] says.
    pub diffuse_horizontal: f64,
    /// Dew point, °C; WEA files have none.
    pub dew_point_c: Option<f64>,
}

impl Weather {
    /// The record of a day that is nearest to an hour; `None` if the file has none within an hour of it.
    pub fn at(&self, month: u32, day: u32, hour: f64) -> Option<&Hour> {
        let is_near = |record: &&Hour| (record.month, record.day) == (month, day) && (record.hour - hour).abs() <= 1.0;
        self.hours.iter().filter(is_near).min_by(|a, b| (a.hour - hour).abs().total_cmp(&(b.hour - hour).abs()))
    }
}

/// Reads a weather file of either format, told apart by its first line.
///
/// # Errors
/// What cannot be used, with its line.
pub fn read(bytes: &[u8]) -> Result<Weather> {
    let text = decode(bytes)?;
    let lines = Lines::new(&text);
    let first = lines.clone().map(|(_, line)| line).find(|line| !line.trim().is_empty()).unwrap_or_default().trim_start();
    let weather = if first.get(..9).is_some_and(|word| word.eq_ignore_ascii_case("LOCATION,")) {
        epw::read(lines)?
    } else if first.split_whitespace().next() == Some("place") {
        wea::read(lines)?
    } else {
        return Err(FormatError::line(
            1,
            format!("{} was found, expected 'LOCATION,' of an EPW file or 'place' of a WEA file", quote(first)),
        ));
    };
    if weather.hours.is_empty() { Err(FormatError::whole("there are no hours in the file")) } else { Ok(weather) }
}

/// A number of a line within a range.
fn number(line: u64, name: &str, token: Option<&str>, range: std::ops::RangeInclusive<f64>) -> Result<f64> {
    let token = token.map(str::trim).ok_or_else(|| FormatError::line(line, format!("{name} is missing")))?;
    parse(token).filter(|value| range.contains(value)).ok_or_else(|| {
        let expected = format!("expected a number from {} to {}", range.start(), range.end());
        FormatError::line(line, format!("{name} is {}, {expected}", quote(token)))
    })
}

/// A whole number of a line within a range.
fn whole(line: u64, name: &str, token: Option<&str>, range: std::ops::RangeInclusive<u32>) -> Result<u32> {
    let value = number(line, name, token, f64::from(*range.start())..=f64::from(*range.end()))?;
    if value.fract() == 0.0 {
        Ok(value as u32)
    } else {
        Err(FormatError::line(line, format!("{name} is {value}, expected a whole number")))
    }
}

impl Weather {
    /// Adds a record, as long as there is room.
    fn push(&mut self, line: u64, hour: Hour) -> Result<()> {
        if self.hours.len() == MOST_HOURS {
            return Err(FormatError::line(line, format!("more than {MOST_HOURS} records were found, expected a year's at most")));
        }
        self.hours.push(hour);
        Ok(())
    }
}
