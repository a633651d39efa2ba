//! Words and numbers of a text with the lines that they are in.

use crate::error::{FormatError, Result};

/// Words between white space or commas, each with its line.
#[derive(Clone, Debug)]
pub(crate) struct Words<'a> {
    rest: &'a str,
    line: u64,
}

impl<'a> Words<'a> {
    /// Words of `text`, which begins in `line`.
    pub(crate) fn new(text: &'a str, line: u64) -> Self {
        Self { rest: text, line }
    }

    /// The line that the last word was in.
    pub(crate) fn line(&self) -> u64 {
        self.line
    }

    /// Moves to the next word's first byte.
    fn skip(&mut self) {
        let word = self.rest.find(|c: char| !c.is_whitespace() && c != ',').unwrap_or(self.rest.len());
        self.line += self.rest.as_bytes()[..word].iter().filter(|&&b| b == b'\n').count() as u64;
        self.rest = &self.rest[word..];
    }

    /// The next word; a brace is one of its own.
    pub(crate) fn word(&mut self) -> Option<&'a str> {
        self.skip();
        let is_brace = |c: char| c == '{' || c == '}';
        let length = match self.rest.find(|c: char| c.is_whitespace() || c == ',' || is_brace(c)) {
            Some(0) => 1,
            Some(length) => length,
            None => self.rest.len(),
        };
        let (word, rest) = self.rest.split_at(length);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// Whether the next word begins with that character.
    pub(crate) fn is_next(&mut self, c: char) -> bool {
        self.skip();
        self.rest.starts_with(c)
    }

    /// How many bytes are left: no more numbers than that can follow.
    pub(crate) fn bytes_left(&self) -> usize {
        self.rest.len()
    }

    /// The next number; `what` it is stands in the message.
    pub(crate) fn number(&mut self, what: &str) -> Result<f64> {
        match self.word() {
            Some(word) => {
                word.parse().map_err(|_| FormatError::line(self.line, format!("\"{}\" is not a number, expected {what}", shown(word))))
            }
            None => Err(FormatError::line(self.line, format!("the text ends, expected {what}"))),
        }
    }

    /// That many numbers. Nothing is allocated for more of them than the text has bytes for.
    pub(crate) fn numbers(&mut self, count: usize, what: &str) -> Result<Vec<f64>> {
        // Every number but the last takes a character and a separator.
        if count > self.bytes_left() / 2 + 1 {
            let bytes = self.bytes_left();
            return Err(FormatError::line(self.line, format!("{bytes} bytes left, expected {count} numbers ({what})")));
        }
        (0..count).map(|_| self.number(what)).collect()
    }
}

/// A word of a file as it may stand in a message: the beginning of it, without control characters.
pub(crate) fn shown(word: &str) -> String {
    word.chars().take(40).map(|c| if c.is_control() { '?' } else { c }).collect()
}
