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
        loop {
            // Behind a comma that a number follows at once, a further comma separates: `0,15,30`.
            let in_list = self.rest.starts_with(',') && !self.rest.trim_start_matches(',').starts_with(is_blank);
            let rest = self.rest.trim_start_matches(|c| is_blank(c) || c == ',');
            if rest.is_empty() {
                self.rest = self.lines.next()?.1;
                continue;
            }
            let mut length = end_of(rest);
            if let Some(pair) = decimal_at(rest, length).filter(|_| !in_list) {
                self.doubtful = self.doubtful.or(Some((pair, self.line())));
                length = if self.comma == Comma::Decimal { pair.len() } else { length };
            }
            let (token, rest) = rest.split_at(length);
            self.rest = rest;
            return Some(token);
        }
    }
}

fn is_blank(c: char) -> bool {
    c.is_whitespace() || c == '\u{1a}'
}

/// Bytes up to the first blank or comma.
fn end_of(text: &str) -> usize {
    text.find(|c| is_blank(c) || c == ',').unwrap_or(text.len())
}

/// What a text begins with, if it may be meant as one number with a decimal comma, which stands behind `whole` bytes: digits to both sides of a single
/// comma, and no point behind it.
fn decimal_at(text: &str, whole: usize) -> Option<&str> {
    let fraction = text[whole..].strip_prefix(',')?;
    let fraction = &fraction[..end_of(fraction)];
    let (pair, behind) = text.split_at(whole + 1 + fraction.len());
    let is_last = behind.trim_start_matches(',').chars().next().is_none_or(is_blank);
    let ends_in_digit = text[..whole].ends_with(|c: char| c.is_ascii_digit());
    (is_last && ends_in_digit && fraction.starts_with(|c: char| c.is_ascii_digit()) && !fraction.contains('.')).then_some(pair)
}
