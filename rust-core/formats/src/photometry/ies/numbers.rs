//! The numbers of an IES file: separated by blanks or commas, wrapped wherever their writer liked, some with decimal commas.

use crate::error::{FormatError, Result};
use crate::photometry::axis::Axis;
use crate::photometry::text::{Lines, decimal, parse, quote};

/// What a comma between two digits is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comma {
    /// The end of a number.
    Separator,
    /// The decimal sign.
    Decimal,
}

#[derive(Debug)]
pub(super) struct Numbers<'a> {
    lines: Lines<'a>,
    rest: &'a str,
    comma: Comma,
    /// The first piece of text whose comma may be either, and its line.
    doubtful: Option<(&'a str, u64)>,
}

/// Reads `lines` with commas as separators, and where the numbers then are not as many as counted, with decimal commas. Gives what was read and
/// a warning about what stands behind the `last` number, or about the commas.
///
/// # Errors
/// What `read` says with separators, or that neither reading fits, with the line.
pub(super) fn by_comma<'a, T>(
    lines: &Lines<'a>,
    last: &str,
    mut read: impl FnMut(&mut Numbers<'a>) -> Result<T>,
) -> Result<(T, Option<FormatError>)> {
    let mut numbers = Numbers::new(lines.clone(), Comma::Separator);
    let separated = read(&mut numbers);
    let left = numbers.token().map(|token| (token, numbers.line()));
    let Some((token, line)) = numbers.doubtful.filter(|_| separated.is_err() || left.is_some()) else {
        let warning = |(token, line)| FormatError::line(line, format!("{} was found after the last {last}: not read", quote(token)));
        return separated.map(|found| (found, left.map(warning)));
    };
    let mut numbers = Numbers::new(lines.clone(), Comma::Decimal);
    match read(&mut numbers) {
        Ok(found) if numbers.token().is_none() => {
            Ok((found, Some(FormatError::line(line, format!("{} was found: decimal commas are read as points", quote(token))))))
        }
        _ => {
            separated?;
            let problem = format!("{} was found: its comma fits the counts neither as a separator nor as a decimal sign", quote(token));
            Err(FormatError::line(line, problem))
        }
    }
}

impl<'a> Numbers<'a> {
    fn new(lines: Lines<'a>, comma: Comma) -> Self {
        Self { lines, rest: "", comma, doubtful: None }
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
                let value = if self.comma == Comma::Decimal { decimal(token) } else { parse(token) };
                value.ok_or_else(|| FormatError::line(self.line(), format!("{} was found, expected {what}", quote(token))))
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
        let blank = |c: char| c.is_whitespace() || c == '\u{1a}';
        loop {
            let rest = self.rest.trim_start_matches(|c| blank(c) || c == ',');
            if rest.is_empty() {
                self.rest = self.lines.next()?.1;
                continue;
            }
            let (piece, after) = rest.split_at(rest.find(blank).unwrap_or(rest.len()));
            let piece = piece.trim_end_matches(',');
            let is_doubtful = is_decimal(piece);
            if is_doubtful {
                self.doubtful = self.doubtful.or(Some((piece, self.line())));
            }
            if is_doubtful && self.comma == Comma::Decimal {
                self.rest = after;
                return Some(piece);
            }
            let (token, rest) = rest.split_at(piece.find(',').unwrap_or(piece.len()));
            self.rest = rest;
            return Some(token);
        }
    }
}

/// Whether a piece of text between blanks may be meant as one number with a decimal comma: digits to both sides of a single comma, and no point
/// behind it.
fn is_decimal(piece: &str) -> bool {
    piece.split_once(',').is_some_and(|(whole, fraction)| {
        whole.ends_with(|c: char| c.is_ascii_digit())
            && fraction.starts_with(|c: char| c.is_ascii_digit())
            && !fraction.contains([',', '.'])
    })
}
