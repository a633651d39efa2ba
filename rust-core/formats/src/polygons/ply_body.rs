//! The numbers of a PLY file's body, in whatever way they are written.

use super::ply_header::{Encoding, Header, Kind, Property};
use crate::{FormatError, error::Result};

/// Reads on from number to number.
pub(super) enum Body<'a> {
    Text { lines: std::str::Lines<'a>, words: std::str::SplitWhitespace<'a>, line: u64 },
    Binary { bytes: &'a [u8], at: usize, big: bool },
}

impl<'a> Body<'a> {
    /// Behind the header; `text` is the same as a string where it is one.
    pub(super) fn new(header: &Header, bytes: &'a [u8], text: &'a str) -> Self {
        match header.encoding {
            Encoding::Text => Self::Text { lines: text.lines(), words: "".split_whitespace(), line: header.line - 1 },
            encoding => Self::Binary { bytes, at: header.body, big: encoding == Encoding::BigEndian },
        }
    }

    /// Fewest bytes that a number takes.
    pub(super) fn smallest(&self, kind: Kind) -> usize {
        match self {
            Self::Text { .. } => 2,
            Self::Binary { .. } => kind.size(),
        }
    }

    /// Begins a row: in text each has a line of its own.
    pub(super) fn begin_row(&mut self) -> Result<()> {
        let Self::Text { lines, words, line } = self else { return Ok(()) };
        loop {
            *line += 1;
            let text = lines.next().ok_or_else(|| FormatError::line(*line, "the file ends before all rows that its header states"))?;
            *words = text.split_whitespace();
            if !text.trim().is_empty() {
                return Ok(());
            }
        }
    }

    /// What is wrong, and where.
    pub(super) fn wrong(&self, problem: impl Into<String>) -> FormatError {
        match self {
            Self::Text { line, .. } => FormatError::line(*line, problem),
            Self::Binary { at, .. } => FormatError::byte(*at as u64, problem),
        }
    }

    /// The next number.
    pub(super) fn number(&mut self, kind: Kind) -> Result<f64> {
        match self {
            Self::Text { words, .. } => {
                let word = words.next();
                let number = word.and_then(|word| word.parse::<f64>().ok());
                number.ok_or_else(|| self.wrong(format!("'{}' was found, expected a number", word.unwrap_or("the end of the line"))))
            }
            Self::Binary { bytes, at, big } => {
                let found = bytes.get(*at..*at + kind.size()).map(|bytes| decoded(bytes, kind, *big));
                let found = found.ok_or_else(|| self.wrong("the file ends before all rows that its header states"))?;
                let Self::Binary { at, .. } = self else { return Ok(found) };
                *at += kind.size();
                Ok(found)
            }
        }
    }

    /// All numbers of a property.
    pub(super) fn property(&mut self, property: &Property, values: &mut Vec<f64>) -> Result<()> {
        values.clear();
        let Some(count) = property.count else {
            values.push(self.number(property.kind)?);
            return Ok(());
        };
        let count = self.number(count)?;
        if !(0.0..1e9).contains(&count) || count.fract() != 0.0 {
            return Err(self.wrong(format!("{count} was found, expected how many numbers follow")));
        }
        for _ in 0..count as usize {
            values.push(self.number(property.kind)?);
        }
        Ok(())
    }
}

fn decoded(bytes: &[u8], kind: Kind, big: bool) -> f64 {
    let mut word = [0; 8];
    for (place, byte) in word.iter_mut().enumerate().take(bytes.len()) {
        *byte = bytes[if big { bytes.len() - 1 - place } else { place }];
    }
    let [a, b, c, d, ..] = word;
    match kind {
        Kind::I8 => f64::from(a.cast_signed()),
        Kind::U8 => f64::from(a),
        Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
        Kind::U16 => f64::from(u16::from_le_bytes([a, b])),
        Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Kind::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Kind::F64 => f64::from_le_bytes(word),
    }
}
