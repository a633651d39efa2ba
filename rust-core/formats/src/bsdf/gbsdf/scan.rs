//! Words, lines and raw numbers of a `.gbsdf` file.

use super::super::text::shown;
use crate::error::{FormatError, Place, Result};

/// Walks over a file.
pub(super) struct Scan<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    /// Whether raw numbers have gone by, so that lines tell nothing any more.
    is_binary: bool,
}

impl<'a> Scan<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1, is_binary: false }
    }

    /// A problem where the scan is.
    pub(super) fn error(&self, problem: impl Into<String>) -> FormatError {
        let place = if self.is_binary { Place::Byte(self.at as u64) } else { Place::Line(self.line) };
        FormatError { place: Some(place), problem: problem.into() }
    }

    pub(super) fn bytes_left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Over white space and comments: from a `#` where a word could begin to the line's end.
    fn skip(&mut self) {
        let mut in_comment = false;
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' => {
                    self.line += 1;
                    in_comment = false;
                }
                b'#' => in_comment = true,
                b if b.is_ascii_whitespace() || in_comment => {}
                _ => break,
            }
            self.at += 1;
        }
    }

    /// The next word; none at the end.
    pub(super) fn word(&mut self) -> Option<&'a str> {
        self.skip();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        // What is not UTF-8 is no word that we know.
        (length > 0).then(|| core::str::from_utf8(&rest[..length]).unwrap_or("?"))
    }

    /// The next word, which has to be there.
    pub(super) fn expect_word(&mut self, what: &str) -> Result<&'a str> {
        self.word().ok_or_else(|| self.error(format!("the file ends, expected {what}")))
    }

    /// The rest of the line.
    pub(super) fn rest_of_line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at += length;
        rest[..length].trim_ascii()
    }

    pub(super) fn number(&mut self, what: &str) -> Result<f64> {
        let word = self.expect_word(what)?;
        word.parse().map_err(|_| self.error(format!("\"{}\", expected {what}", shown(word))))
    }

    /// How many there are of something of which each takes at least `size` bytes.
    pub(super) fn count(&mut self, what: &str, size: usize) -> Result<usize> {
        let word = self.expect_word(what)?;
        let count: usize = word.parse().map_err(|_| self.error(format!("\"{}\", expected {what}", shown(word))))?;
        if count == 0 || count > self.bytes_left() / size + 1 {
            return Err(self.error(format!("{count}, expected {what} that fits into the {} bytes left", self.bytes_left())));
        }
        Ok(count)
    }

    pub(super) fn numbers(&mut self, count: usize, what: &str) -> Result<Vec<f64>> {
        (0..count).map(|_| self.number(what)).collect()
    }

    /// `count` raw numbers of `size` bytes from the next line on.
    pub(super) fn raw(&mut self, count: usize, size: usize) -> Result<&'a [u8]> {
        if !self.rest_of_line().is_empty() {
            return Err(self.error("the line goes on, expected its end before raw numbers"));
        }
        self.is_binary = true;
        self.at = (self.at + 1).min(self.bytes.len());
        let end = count.checked_mul(size).and_then(|length| length.checked_add(self.at));
        let Some(raw) = end.and_then(|end| self.bytes.get(self.at..end)) else {
            return Err(self.error(format!("{} bytes left, expected {count} numbers of {size} bytes", self.bytes_left())));
        };
        self.at += raw.len();
        Ok(raw)
    }
}
