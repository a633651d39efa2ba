//! The lines of an EULUMDAT file.

use crate::error::{FormatError, Result};
use crate::photometry::axis::Axis;
use crate::photometry::text::{Lines, decimal, number, quote};

/// Warnings that are told one by one.
const MOST_WARNINGS: usize = 50;

#[derive(Debug)]
pub(super) struct Fields<'a> {
    lines: Lines<'a>,
    /// What is left of a line that holds several values of a list.
    rest: &'a str,
    /// What was repaired.
    pub(super) warnings: Vec<FormatError>,
}

impl<'a> Fields<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { lines: Lines::new(text), rest: "", warnings: Vec::new() }
    }

    /// The line read last.
    pub(super) fn line(&self) -> u64 {
        self.lines.count.max(1)
    }

    /// An error in the line read last.
    pub(super) fn error(&self, problem: impl Into<String>) -> FormatError {
        FormatError::line(self.line(), problem)
    }

    /// A warning about the line read last; after many it is enough to know that there are more.
    pub(super) fn warn(&mut self, problem: impl Into<String>) {
        match self.warnings.len() {
            ..MOST_WARNINGS => self.warnings.push(FormatError::line(self.line(), problem)),
            MOST_WARNINGS => self.warnings.push(FormatError::line(self.line(), "further problems are not listed")),
            _ => {}
        }
    }

    /// A line of text.
    pub(super) fn text(&mut self, what: &str) -> Result<&'a str> {
        match self.lines.next() {
            Some((_, line)) => Ok(line.trim()),
            None => Err(self.error(format!("the file ends, expected {what}"))),
        }
    }

    /// A line with a number; an empty one counts as 0.
    pub(super) fn number(&mut self, what: &str) -> Result<f64> {
        let line = self.text(what)?;
        let Some(token) = line.split_whitespace().next() else {
            self.warn(format!("{what} is empty: 0 is taken"));
            return Ok(0.0);
        };
        let value = decimal(token).ok_or_else(|| self.error(format!("{} was found, expected {what}", quote(token))))?;
        if token.len() < line.len() {
            self.warn(format!("{} was found, expected {what}: {} is taken", quote(line), number(value)));
        }
        Ok(value)
    }

    /// A line with a whole number in a range.
    pub(super) fn whole(&mut self, what: &str, [low, high]: [usize; 2]) -> Result<usize> {
        let value = self.number(what)?;
        if value.fract() == 0.0 && (low as f64..=high as f64).contains(&value) {
            return Ok(value as usize);
        }
        Err(self.error(format!("{what} is {}, expected a whole number from {low} to {high}", number(value))))
    }

    /// How many list items the rest of the file may hold: each takes a digit and a line's end.
    pub(super) fn room(&self) -> usize {
        (self.lines.remaining() + self.rest.len()) / 2 + 1
    }

    /// An item of a list; lists may have several items in a line.
    pub(super) fn item(&mut self, what: &str) -> Result<f64> {
        match self.token() {
            Some(token) => decimal(token).ok_or_else(|| self.error(format!("{} was found, expected {what}", quote(token)))),
            None => Err(self.error(format!("the file ends, expected {what}"))),
        }
    }

    /// A list of angles.
    pub(super) fn axis(&mut self, name: &'static str, count: usize) -> Result<Axis> {
        let mut axis = Axis { name, angles: Vec::with_capacity(count), lines: Vec::with_capacity(count) };
        for index in 0..count {
            axis.angles.push(self.item(&format!("{name} {} of {count}", index + 1))?);
            axis.lines.push(self.line());
        }
        Ok(axis)
    }

    /// The next piece of a list, whatever it is.
    pub(super) fn token(&mut self) -> Option<&'a str> {
        loop {
            let rest = self.rest.trim_start();
            if !rest.is_empty() {
                let (token, rest) = rest.split_at(rest.find(char::is_whitespace).unwrap_or(rest.len()));
                self.rest = rest;
                return Some(token);
            }
            self.rest = self.lines.next()?.1;
        }
    }
}
