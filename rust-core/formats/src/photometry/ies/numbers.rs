//! The numbers of an IES file: separated by blanks or commas, wrapped wherever their writer liked.

use crate::error::{FormatError, Result};
use crate::photometry::axis::Axis;
use crate::photometry::text::{Lines, parse, quote};

#[derive(Debug)]
pub(super) struct Numbers<'a> {
    lines: Lines<'a>,
    rest: &'a str,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(lines: Lines<'a>) -> Self {
        Self { lines, rest: "" }
    }

    /// The line of the number given last.
    pub(super) fn line(&self) -> u64 {
        self.lines.count.max(1)
    }

    /// The next number.
    pub(super) fn next(&mut self, what: &str) -> Result<f64> {
        match self.token() {
            None => Err(FormatError::line(self.line(), format!("the file ends, expected {what}"))),
            Some(token) => {
                parse(token).ok_or_else(|| FormatError::line(self.line(), format!("{} was found, expected {what}", quote(token))))
            }
        }
    }

    /// The next number, which counts things that the file goes on to list.
    pub(super) fn count(&mut self, what: &str) -> Result<usize> {
        let value = self.next(&format!("the number of {what}"))?;
        // Each takes a digit and a blank at least, so that no count makes a reader reserve more than the file's size.
        let most = self.remaining() / 2 + 1;
        if value >= 1.0 && value.fract() == 0.0 && value <= most as f64 {
            return Ok(value as usize);
        }
        let room = if value > most as f64 { format!(": the rest of the file has room for {most}") } else { String::new() };
        Err(FormatError::line(self.line(), format!("the number of {what} is {value}, expected a whole number from 1{room}")))
    }

    /// A list of angles.
    pub(super) fn axis(&mut self, name: &'static str, count: usize) -> Result<Axis> {
        let mut axis = Axis { name, angles: Vec::with_capacity(count), lines: Vec::with_capacity(count) };
        for index in 0..count {
            axis.angles.push(self.next(&format!("{name} {} of {count}", index + 1))?);
            axis.lines.push(self.line());
        }
        Ok(axis)
    }

    /// Bytes that are still to come.
    pub(super) fn remaining(&self) -> usize {
        self.lines.remaining() + self.rest.len()
    }

    /// The next piece of text, whatever it is.
    pub(super) fn token(&mut self) -> Option<&'a str> {
        let separator = |c: char| c.is_whitespace() || c == ',' || c == '\u{1a}';
        loop {
            let rest = self.rest.trim_start_matches(separator);
            if !rest.is_empty() {
                let (token, rest) = rest.split_at(rest.find(separator).unwrap_or(rest.len()));
                self.rest = rest;
                return Some(token);
            }
            self.rest = self.lines.next()?.1;
        }
    }
}
