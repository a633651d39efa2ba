//! Text that may be anything: encodings, lines, numbers.

use crate::error::{FormatError, Result};
use std::borrow::Cow;

/// The greatest magnitude of any number in a file: far beyond light sources, and products of a few stay finite in single precision.
pub(crate) const LARGEST: f64 = 1e12;

/// Characters of a file that a message quotes.
const QUOTED: usize = 24;

/// The text of a file: UTF-8 where it is valid, else ISO 8859-1; a byte order mark and a DOS end-of-file mark go.
pub(crate) fn decode(bytes: &[u8]) -> Result<Cow<'_, str>> {
    let bytes = bytes.strip_prefix(&[0xef, 0xbb, 0xbf]).unwrap_or(bytes);
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(FormatError::line(1, "UTF-16 text was found, expected ASCII, ISO 8859-1 or UTF-8"));
    }
    let end = bytes.iter().rposition(|byte| !matches!(byte, 0 | 0x1a)).map_or(0, |last| last + 1);
    let bytes = &bytes[..end];
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        let line = 1 + bytes[..at].iter().filter(|byte| **byte == b'\n').count() as u64;
        return Err(FormatError::line(line, "a zero byte was found, expected text"));
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    })
}

/// Lines with their numbers from one; they end with LF, CR LF or CR.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'a> {
    rest: &'a str,
    /// Lines given so far.
    pub(crate) count: u64,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { rest: text, count: 0 }
    }

    /// Bytes that are still to come.
    pub(crate) fn remaining(&self) -> usize {
        self.rest.len()
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (u64, &'a str);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.find(['\n', '\r']).unwrap_or(self.rest.len());
        let (line, ending) = self.rest.split_at(end);
        self.rest = ending.strip_prefix("\r\n").or_else(|| ending.strip_prefix(['\n', '\r'])).unwrap_or_default();
        self.count += 1;
        Some((self.count, line))
    }
}

/// A finite number of a sane size.
pub(crate) fn parse(token: &str) -> Option<f64> {
    // Of letters only the exponent's may stand, so that neither "nan" nor "infinity" passes for a number.
    let digits = token.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E'));
    let value = if digits { token.parse::<f64>().ok()? } else { return None };
    // A negative zero would print its sign.
    (value.abs() <= LARGEST).then_some(value + 0.0)
}

/// A number with a decimal point or comma.
pub(crate) fn decimal(token: &str) -> Option<f64> {
    if !token.contains(',') {
        return parse(token);
    }
    // A point beside a comma would leave open which of them groups thousands.
    if token.contains('.') { None } else { parse(&token.replacen(',', ".", 1)) }
}

/// A piece of a file for a message, short and in one line.
pub(crate) fn quote(token: &str) -> String {
    let mut text: String = token.chars().take(QUOTED).map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect();
    if token.chars().nth(QUOTED).is_some() {
        text.push('…');
    }
    format!("'{text}'")
}

/// A number for a file: ten significant digits, no exponent.
pub(crate) fn number(value: f64) -> String {
    let rounded = format!("{value:.9e}").parse().unwrap_or(value);
    format!("{}", rounded + 0.0)
}

/// The bytes of a written file, in ISO 8859-1: what does not fit becomes a question mark.
pub(crate) fn encode(text: &str) -> Vec<u8> {
    text.chars().map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?')).collect()
}

/// A header text for a file: one line.
pub(crate) fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>().trim().to_owned()
}

/// Whether a text is a day of the calendar, such as 2025-03-31.
pub fn is_date(text: &str) -> bool {
    let digits =
        |part: &str, count: usize| part.parse::<u32>().ok().filter(|_| part.len() == count && part.bytes().all(|b| b.is_ascii_digit()));
    let parts: Vec<&str> = text.split('-').collect();
    let [year, month, day] = parts[..] else { return false };
    let (Some(year), Some(month), Some(day)) = (digits(year, 4), digits(month, 2), digits(day, 2)) else { return false };
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days = match month {
        2 => 28 + u32::from(leap),
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => 0,
    };
    (1..=days).contains(&day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        assert!(["2025-03-31", "2024-02-29", "2000-02-29"].iter().all(|day| is_date(day)));
        assert!(
            ["", "2025-3-31", "2025-02-29", "1900-02-29", "2025-13-01", "2025-01-00", "+025-01-01", "2025-01-01-01"]
                .iter()
                .all(|day| !is_date(day))
        );
    }

    #[test]
    fn lines_end_in_three_ways() {
        let lines: Vec<_> = Lines::new("a\r\nb\rc\n\nd").collect();
        assert_eq!(lines, [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, "d")]);
    }

    #[test]
    fn numbers_are_finite_and_sane() {
        assert_eq!(["1.5", "-.5", "1e3", "+2."].map(parse), [Some(1.5), Some(-0.5), Some(1000.0), Some(2.0)]);
        assert_eq!(["nan", "inf", "1e999", "1e13", "", "1,5", "0x10", "--1"].map(parse), [None; 8]);
    }

    #[test]
    fn bytes_become_text() {
        assert_eq!(decode(b"\xef\xbb\xbfab\x1a").unwrap(), "ab");
        assert_eq!(decode(b"f\xfcr").unwrap(), "für");
        assert_eq!(decode("für".as_bytes()).unwrap(), "für");
        assert_eq!(decode(b"a\nb\0c").unwrap_err().to_string(), "line 2: a zero byte was found, expected text");
        assert!(decode(b"\xff\xfea\0").is_err());
    }

    #[test]
    fn written_numbers_are_short_and_keep_nine_digits() {
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(98.765_432_101), "98.7654321");
        assert_eq!(number(-0.0), "0");
    }
}
