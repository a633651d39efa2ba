//! Files of bits that are expensive: a first line, the length of a description, the description in JSON, the bits, a digest of all that.

use crate::{
    error::{Error, Result},
    output::write_beside,
    scene::{Digesting, open_file},
};
use serde::{Serialize, de::DeserializeOwned};
use std::{
    fs::File,
    io::{self, BufReader, Read, Take, Write},
    path::Path,
};

/// Longest description.
const MOST_DESCRIPTION: u32 = 1 << 28;

/// Writes a file, whole or not at all; what an earlier kill left of one is overwritten.
pub(crate) fn write_described(
    path: &Path,
    first_line: &str,
    description: &impl Serialize,
    bits: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    let description = serde_json::to_vec(description).map_err(|error| Error::io(path, io::Error::other(error)))?;
    write_beside(path, ".part", true, |file| {
        let mut out = Digesting::new(file);
        out.write_all(first_line.as_bytes())?;
        out.write_all(&(description.len() as u32).to_le_bytes())?;
        out.write_all(&description)?;
        bits(&mut out)?;
        let digest = out.digest.value();
        out.write_all(&digest.to_le_bytes())
    })
}

/// A file that is read.
pub(crate) struct Described<'a> {
    path: &'a Path,
    /// Where its bits are read from.
    pub(crate) input: Digesting<BufReader<Take<File>>>,
    /// Bytes of all of it.
    pub(crate) length: u64,
}

impl<'a> Described<'a> {
    /// Opens a file with this first line, and reads its description.
    pub(crate) fn open<T: DeserializeOwned>(path: &'a Path, first_line: &str) -> Result<(Self, T)> {
        let file = open_file(path).map_err(|error| Error::io(path, error))?;
        let length = file.limit();
        let mut opened = Self { path, input: Digesting::new(BufReader::with_capacity(1 << 20, file)), length };
        let description = description(&mut opened.input, first_line).map_err(|error| opened.damaged(&error))?;
        Ok((opened, description))
    }

    /// Reads the digest behind the bits.
    pub(crate) fn end(mut self) -> Result<()> {
        let expected = self.input.digest.value();
        let mut found = [0; 8];
        self.input.read_exact(&mut found).map_err(|error| self.damaged(&error))?;
        let is_right = u64::from_le_bytes(found) == expected;
        if is_right { Ok(()) } else { Err(self.broken("the checkpoint is damaged: its digest differs")) }
    }

    pub(crate) fn broken(&self, problem: impl Into<String>) -> Error {
        Error::Format { path: self.path.to_owned(), line: None, problem: problem.into() }
    }

    /// What reading came upon.
    pub(crate) fn damaged(&self, error: &io::Error) -> Error {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => self.broken("the checkpoint ends before its time"),
            io::ErrorKind::InvalidData => self.broken(format!("the checkpoint is damaged: {error}")),
            kind => Error::io(self.path, io::Error::new(kind, error.to_string())),
        }
    }
}

fn description<T: DeserializeOwned>(input: &mut impl Read, first_line: &str) -> io::Result<T> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidData, problem);
    let mut found = vec![0; first_line.len()];
    input.read_exact(&mut found)?;
    if found != first_line.as_bytes() {
        return Err(invalid(format!("its first line is not '{}'", first_line.trim_end())));
    }
    let mut length = [0; 4];
    input.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if length > MOST_DESCRIPTION {
        return Err(invalid(format!("a description of {length} bytes")));
    }
    let mut json = vec![0; length as usize];
    input.read_exact(&mut json)?;
    serde_json::from_slice(&json).map_err(|error| invalid(error.to_string()))
}
