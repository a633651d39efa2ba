//! A year of weather, step by step, with the sun's place.

use crate::{
    dew_point::DewPoints,
    error::{AnnualError, Result},
    sun::{Sun, day_of_year, sun},
};
use gonio_formats::{
    FormatError,
    weather::{self, Hour, Quantities, Weather},
};
use std::path::Path;

/// Direct light from below the horizon that is worth a word: W/m².
const BRIGHT: f64 = 20.0;
/// The same in lx.
const BRIGHT_LUX: f64 = 179.0 * BRIGHT;

/// One interval of a year.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// 1 to 12.
    pub month: u32,
    /// 1 to 31.
    pub day: u32,
    /// Middle of the interval on the file's clock, hours since midnight.
    pub hour: f64,
    /// 1 to 366.
    pub day_of_year: u32,
    /// In which it was measured, where the file tells.
    pub calendar_year: Option<i32>,
    /// Of the sun's disc, as [`Year::quantities`] says.
    pub direct: f64,
    /// Of the sky on a level surface, as [`Year::quantities`] says.
    pub diffuse: f64,
    /// Mean dew point of this step and the two before it, °C; [`crate::USUAL_DEW_POINT_C`] where the file tells none.
    pub dew_point_c: f64,
    /// The sun: by Radiance's formulas in the middle of the interval, unless [`Year::under`] has put it elsewhere.
    pub sun: Sun,
    /// When it stands there: the middle of the interval, or of the part of it in which the sun is up.
    pub sun_hour: f64,
}

/// A whole year in equal steps, from the first of January on.
#[derive(Clone, Debug, PartialEq)]
pub struct Year {
    /// The place's name; may be empty.
    pub place: String,
    /// Degrees, north positive.
    pub latitude_deg: f64,
    /// Degrees, east positive.
    pub longitude_deg: f64,
    /// Metres above the sea.
    pub elevation_m: f64,
    /// Hours that the file's clock is ahead of universal time.
    pub utc_offset_h: f64,
    /// What the numbers of the steps are.
    pub quantities: Quantities,
    /// Hours of a step: 1, or a part of it.
    pub step_hours: f64,
    /// The steps: 8760 or 8784 times the number of steps an hour.
    pub steps: Vec<Step>,
    /// What makes one doubt the file, one sentence each.
    pub doubts: Vec<String>,
    /// Of the steps in the file.
    lines: Vec<u64>,
}

impl Year {
    /// Reads the bytes of an EPW or WEA file of a whole year; errors name its path.
    ///
    /// # Errors
    /// What is no weather, and what is missing of the year, with its line.
    pub fn read(path: &Path, bytes: &[u8]) -> Result<Self> {
        let read = weather::read(bytes).map_err(|error| AnnualError::content(path, error))?;
        let lines = record_lines(bytes, read.hours.len());
        Self::new(&read, &lines).map_err(|error| AnnualError::content(path, error))
    }

    /// A year of records; `lines` are their lines in the file.
    ///
    /// # Errors
    /// The first record that is missing, double or of a day that does not exist.
    pub fn new(weather: &Weather, lines: &[u64]) -> std::result::Result<Self, FormatError> {
        let has_leap_day = weather.hours.iter().any(|hour| (hour.month, hour.day) == (2, 29));
        let first = weather.hours.iter().take_while(|hour| (hour.month, hour.day) == (1, 1)).count();
        let a_day = first.div_ceil(24).max(1) * 24;
        let expected = a_day * (365 + usize::from(has_leap_day));
        let mut dew_points = DewPoints::default();
        let mut steps = Vec::with_capacity(weather.hours.len());
        for (index, hour) in weather.hours.iter().enumerate() {
            let line = lines.get(index).copied().unwrap_or(1);
            let day_of_year = check(hour, index, a_day, has_leap_day).map_err(|problem| FormatError::line(line, problem))?;
            steps.push(Step {
                month: hour.month,
                day: hour.day,
                hour: hour.hour,
                day_of_year,
                calendar_year: hour.year,
                direct: hour.direct_normal,
                diffuse: hour.diffuse_horizontal,
                dew_point_c: dew_points.mean(hour.dew_point_c),
                sun: sun(day_of_year, hour.hour, weather.latitude_deg, weather.longitude_deg, weather.utc_offset_h),
                sun_hour: hour.hour,
            });
        }
        if steps.len() != expected {
            let line = lines.last().copied().unwrap_or(1);
            let problem = format!("the file ends after {} records, expected {expected}, a whole year's", steps.len());
            return Err(FormatError::line(line, problem));
        }
        let doubts = doubts(&steps, lines, weather.quantities);
        Ok(Self {
            place: weather.place.clone(),
            latitude_deg: weather.latitude_deg,
            longitude_deg: weather.longitude_deg,
            elevation_m: weather.elevation_m,
            utc_offset_h: weather.utc_offset_h,
            quantities: weather.quantities,
            step_hours: 24.0 / a_day as f64,
            steps,
            doubts,
            lines: lines.to_vec(),
        })
    }

    /// The same year under suns that stand elsewhere, and at other hours, one for each step.
    #[must_use]
    pub fn under(mut self, suns: &[(f64, Sun)]) -> Self {
        self.steps.iter_mut().zip(suns).for_each(|(step, (hour, sun))| (step.sun_hour, step.sun) = (*hour, *sun));
        self.doubts = doubts(&self.steps, &self.lines, self.quantities);
        self
    }

    /// A year without steps.
    pub(crate) fn dark() -> Self {
        Self {
            place: String::new(),
            latitude_deg: 0.0,
            longitude_deg: 0.0,
            elevation_m: 0.0,
            utc_offset_h: 0.0,
            quantities: Quantities::default(),
            step_hours: 1.0,
            steps: Vec::new(),
            doubts: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// Places of the steps in which the sun's disc is above the horizon, in order: the suns that `gendaymtx -D` writes.
    pub fn sunny_steps(&self) -> Vec<usize> {
        (0..self.steps.len()).filter(|step| self.steps[*step].sun.is_up()).collect()
    }
}

/// The day of a record, if it is the one that is expected at its place in the file.
fn check(hour: &Hour, index: usize, a_day: usize, has_leap_day: bool) -> std::result::Result<u32, String> {
    let shown = |month: u32, day: u32, at: f64| format!("{day}.{month}. {at:.2} h");
    let found = shown(hour.month, hour.day, hour.hour);
    let day = day_of_year(hour.month, hour.day, has_leap_day).ok_or_else(|| format!("there is no day {}.{}.", hour.day, hour.month))?;
    let middle = ((index % a_day) as f64 + 0.5) * 24.0 / a_day as f64;
    let wanted = (index / a_day) as u32 + 1;
    if day != wanted || (hour.hour - middle).abs() > 12.5 / a_day as f64 {
        let (month, date) = date(wanted, has_leap_day);
        let expected = shown(month, date, middle);
        return Err(format!(
            "the record is of {found}, expected {expected}: annual daylight needs every hour of a year, from January on, once"
        ));
    }
    Ok(day)
}

/// Month and day of a day of the year; beyond the year the last.
fn date(day_of_year: u32, has_leap_day: bool) -> (u32, u32) {
    let mut left = day_of_year;
    for (month, length) in (1..).zip(crate::sun::MONTHS) {
        let length = length + u32::from(has_leap_day && month == 2);
        if left <= length {
            return (month, left);
        }
        left -= length;
    }
    (12, 31)
}

/// Lines of a file's last `count` lines that hold anything.
fn record_lines(bytes: &[u8], count: usize) -> Vec<u64> {
    let text = String::from_utf8_lossy(bytes);
    let filled: Vec<u64> = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()).map(|(number, _)| number).collect();
    filled[filled.len().saturating_sub(count)..].to_vec()
}

fn doubts(steps: &[Step], lines: &[u64], quantities: Quantities) -> Vec<String> {
    let bright = if quantities == Quantities::Illuminance { BRIGHT_LUX } else { BRIGHT };
    let below: Vec<usize> = (0..steps.len()).filter(|index| !steps[*index].sun.is_up() && steps[*index].direct > bright).collect();
    let mut doubts = Vec::new();
    if let Some(first) = below.first() {
        let line = lines.get(*first).copied().unwrap_or(1);
        doubts.push(format!(
            "line {line}: direct light while the sun is below the horizon, in {} records; is the time zone right?",
            below.len()
        ));
    }
    if steps.iter().all(|step| step.direct + step.diffuse <= 0.0) {
        doubts.push("there is no light in the whole year".into());
    }
    doubts
}
