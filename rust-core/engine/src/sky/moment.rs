//! Dates and times of day with their offset from universal time.

use super::within;
use crate::{Error, Result};
use std::fmt;

/// A date and a time of day on clocks that are `utc_offset_h` ahead of universal time (proleptic Gregorian calendar).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// −2000 to 6000, the years that the sun's position is known for.
    pub year: i32,
    /// 1 to 12.
    pub month: u32,
    /// 1 to the month's length.
    pub day: u32,
    /// Hours since midnight, with fractions: 0 to 24.
    pub hour: f64,
    /// Hours that the clock is ahead of universal time, −24 to 24; east of Greenwich positive.
    pub utc_offset_h: f64,
}

impl Moment {
    /// Reads ISO 8601: `2003-10-17T12:30:30-07:00`. Seconds and their fraction may be left out, a space may stand for the T, the offset is
    /// `Z`, `+HH`, `+HHMM` or `+HH:MM` and must be there.
    ///
    /// # Errors
    /// What is wrong with the text, or a date that does not exist.
    pub fn parse(text: &str) -> Result<Self> {
        let wrong = |what: &str| {
            Error::setting("time", format!("'{text}': {what}, expected ISO 8601 with an offset, such as 2003-10-17T12:30-07:00"))
        };
        let (date, rest) = text.trim().split_once(['T', 't', ' ']).ok_or_else(|| wrong("there is no time of day"))?;
        let (clock, offset) = split_offset(rest.trim()).ok_or_else(|| wrong("there is no offset from UTC"))?;
        let (sign, date) = date.strip_prefix('-').map_or((1, date), |date| (-1, date));
        let [year, month, day] = whole_numbers(date, '-').ok_or_else(|| wrong("the date is not year-month-day"))?;
        let hour = hours(clock).ok_or_else(|| wrong("the time of day is not hours:minutes:seconds"))?;
        let utc_offset_h = offset_hours(offset).ok_or_else(|| wrong("the offset is not Z or ±HH:MM"))?;
        Self { year: sign * i32::try_from(year).unwrap_or(i32::MAX), month, day, hour, utc_offset_h }.checked()
    }

    /// Itself, if there is such a moment.
    ///
    /// # Errors
    /// The first number that is out of its range.
    pub fn checked(self) -> Result<Self> {
        within("year", "", f64::from(self.year), -1999.0..=5999.0)?;
        within("month", "", f64::from(self.month), 1.0..=12.0)?;
        within("day", "", f64::from(self.day), 1.0..=f64::from(self.month_length()))?;
        within("hour", " h", self.hour, 0.0..=24.0)?;
        within("utc_offset", " h", self.utc_offset_h, -24.0..=24.0)?;
        Ok(self)
    }

    /// Whether the year has a 29th of February.
    fn is_leap_year(&self) -> bool {
        self.year % 4 == 0 && (self.year % 100 != 0 || self.year % 400 == 0)
    }

    /// Days of the month.
    fn month_length(&self) -> u32 {
        match self.month {
            2 if self.is_leap_year() => 29,
            2 => 28,
            4 | 6 | 9 | 11 => 30,
            _ => 31,
        }
    }

    /// Day of the year, 1 to 366.
    pub fn day_of_year(&self) -> u32 {
        (1..self.month).map(|month| Self { month, ..*self }.month_length()).sum::<u32>() + self.day
    }

    /// The same moment on clocks with another offset.
    pub fn with_offset(&self, utc_offset_h: f64) -> Self {
        let mut moved = Self { hour: self.hour - self.utc_offset_h + utc_offset_h, utc_offset_h, ..*self };
        while moved.hour < 0.0 {
            moved = Self { hour: moved.hour + 24.0, ..moved.day_before() };
        }
        while moved.hour >= 24.0 {
            moved = Self { hour: moved.hour - 24.0, ..moved.day_after() };
        }
        moved
    }

    fn day_before(&self) -> Self {
        if self.day > 1 {
            return Self { day: self.day - 1, ..*self };
        }
        let (year, month) = if self.month > 1 { (self.year, self.month - 1) } else { (self.year - 1, 12) };
        let first = Self { year, month, ..*self };
        Self { day: first.month_length(), ..first }
    }

    fn day_after(&self) -> Self {
        if self.day < self.month_length() {
            return Self { day: self.day + 1, ..*self };
        }
        let (year, month) = if self.month < 12 { (self.year, self.month + 1) } else { (self.year + 1, 1) };
        Self { year, month, day: 1, ..*self }
    }

    /// Julian date of universal time.
    pub fn julian_date(&self) -> f64 {
        self.julian_midnight() + (self.hour - self.utc_offset_h) / 24.0
    }

    /// Julian date of midnight of this date in Greenwich.
    pub(super) fn julian_midnight(&self) -> f64 {
        // Fliegel and van Flandern, with a year that begins in March.
        let (year, month) = (i64::from(self.year) - i64::from(self.month < 3), i64::from(self.month));
        let months = if month < 3 { month + 9 } else { month - 3 };
        let days =
            365 * year + year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400) + (153 * months + 2) / 5 + i64::from(self.day);
        days as f64 + 1_721_118.5
    }
}

impl fmt::Display for Moment {
    /// ISO 8601 to the second.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seconds = (self.hour * 3600.0).round() as i64;
        let offset = (self.utc_offset_h * 60.0).round() as i64;
        let sign = if offset < 0 { '-' } else { '+' };
        write!(f, "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", self.year, self.month, self.day, seconds / 3600, seconds / 60 % 60, seconds % 60)?;
        write!(f, "{sign}{:02}:{:02}", offset.abs() / 60, offset.abs() % 60)
    }
}

/// Three whole numbers without signs.
fn whole_numbers(text: &str, separator: char) -> Option<[u32; 3]> {
    let mut parts = text.split(separator).map(digits);
    let numbers = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(numbers)
}

fn digits(text: &str) -> Option<u32> {
    if text.is_empty() || !text.bytes().all(|byte| byte.is_ascii_digit()) { None } else { text.parse().ok() }
}

/// Hours since midnight of `HH:MM` or `HH:MM:SS.fraction`.
fn hours(text: &str) -> Option<f64> {
    let mut parts = text.split(':');
    let (hour, minute) = (digits(parts.next()?)?, digits(parts.next()?)?);
    let second = match parts.next() {
        None => 0.0,
        Some(text) if text.starts_with(|c: char| c.is_ascii_digit()) => text.parse::<f64>().ok()?,
        Some(_) => return None,
    };
    let is_clock = parts.next().is_none() && hour <= 24 && minute < 60 && (0.0..61.0).contains(&second);
    is_clock.then(|| f64::from(hour) + f64::from(minute) / 60.0 + second / 3600.0)
}

/// The time of day and what follows it.
fn split_offset(text: &str) -> Option<(&str, &str)> {
    let at = text.find(['Z', 'z', '+', '-'])?;
    Some((text[..at].trim_end(), &text[at..]))
}

fn offset_hours(text: &str) -> Option<f64> {
    if text.eq_ignore_ascii_case("z") {
        return Some(0.0);
    }
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    let number = text.get(1..)?.replace(':', "");
    let value = digits(&number)?;
    let (hours, minutes) = match number.len() {
        2 => (value, 0),
        4 => (value / 100, value % 100),
        _ => return None,
    };
    (minutes < 60).then(|| sign * (f64::from(hours) + f64::from(minutes) / 60.0))
}
