//! Bytes of a file or of memory, little endian, within bounds that are known before anything is allocated.

use crate::{Result, VolumeError};
use std::fs::File;
use std::io::{BufReader, Cursor, ErrorKind, Read, Seek, SeekFrom};
use std::path::PathBuf;
use std::sync::Arc;

/// Bytes of the longest name of a grid, a type or an entry.
const LONGEST_NAME: u32 = 4096;

/// Where the bytes of a volume file are.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    Path(PathBuf),
    Memory(Arc<[u8]>),
}

trait Bytes: Read + Seek {}
impl<T: Read + Seek> Bytes for T {}

/// A place in the bytes. Nothing is read at or beyond `end`.
pub(crate) struct Stream {
    inner: BufReader<Box<dyn Bytes>>,
    position: u64,
    end: u64,
    size: u64,
    name: Arc<str>,
}

impl Stream {
    pub(crate) fn open(source: &Source, name: &Arc<str>) -> Result<Self> {
        let told = |error: std::io::Error| VolumeError::whole(name, format!("cannot be read: {error}"));
        let (inner, size): (Box<dyn Bytes>, u64) = match source {
            Source::Path(path) => {
                let file = File::open(path).map_err(told)?;
                let size = file.metadata().map_err(told)?.len();
                (Box::new(file), size)
            }
            Source::Memory(bytes) => (Box::new(Cursor::new(bytes.clone())), bytes.len() as u64),
        };
        // Most reads are of a few dozen bytes.
        let inner = BufReader::with_capacity(1 << 16, inner);
        Ok(Self { inner, position: 0, end: size, size, name: name.clone() })
    }

    pub(crate) fn position(&self) -> u64 {
        self.position
    }

    pub(crate) fn size(&self) -> u64 {
        self.size
    }

    pub(crate) fn remaining(&self) -> u64 {
        self.end - self.position
    }

    /// Forbids to read at or beyond `end`, which lies within the file.
    pub(crate) fn limit(&mut self, end: u64) {
        self.end = end.clamp(self.position, self.size);
    }

    /// An error here.
    pub(crate) fn error(&self, problem: impl Into<String>) -> VolumeError {
        self.error_at(self.position, problem)
    }

    pub(crate) fn error_at(&self, byte: u64, problem: impl Into<String>) -> VolumeError {
        VolumeError { file: self.name.to_string(), byte: Some(byte), problem: problem.into() }
    }

    /// Fails unless so many bytes follow.
    pub(crate) fn expect(&self, count: u64, what: &str) -> Result<()> {
        if count <= self.remaining() {
            return Ok(());
        }
        Err(self.error(format!("{what} takes {count} bytes, but {} are left: the file is truncated or damaged", self.remaining())))
    }

    pub(crate) fn seek(&mut self, position: u64) -> Result<()> {
        if position > self.size {
            return Err(self.error(format!("the file refers to byte {position}, but has {}: it is truncated or damaged", self.size)));
        }
        let told = |error: std::io::Error| VolumeError::whole(&self.name, format!("cannot be read: {error}"));
        self.inner.seek(SeekFrom::Start(position)).map_err(told)?;
        (self.position, self.end) = (position, self.size);
        Ok(())
    }

    pub(crate) fn skip(&mut self, count: u64) -> Result<()> {
        self.expect(count, "what follows")?;
        let offset = i64::try_from(count).map_err(|_| self.error("the file is too large"))?;
        self.inner.seek_relative(offset).map_err(|error| self.error(format!("cannot be read: {error}")))?;
        self.position += count;
        Ok(())
    }

    pub(crate) fn read_into(&mut self, bytes: &mut [u8]) -> Result<()> {
        self.expect(bytes.len() as u64, "what follows")?;
        self.inner.read_exact(bytes).map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => self.error("the file has become shorter while it was read"),
            _ => self.error(format!("cannot be read: {error}")),
        })?;
        self.position += bytes.len() as u64;
        Ok(())
    }

    /// As many bytes, in place of what the buffer held.
    pub(crate) fn fill(&mut self, bytes: &mut Vec<u8>, count: u64, what: &str) -> Result<()> {
        self.expect(count, what)?;
        bytes.clear();
        bytes.resize(count as usize, 0);
        self.read_into(bytes)
    }

    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N]> {
        let mut bytes = [0; N];
        self.read_into(&mut bytes)?;
        Ok(bytes)
    }

    pub(crate) fn u8(&mut self) -> Result<u8> {
        Ok(self.array::<1>()?[0])
    }

    pub(crate) fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(crate) fn i32(&mut self) -> Result<i32> {
        Ok(i32::from_le_bytes(self.array()?))
    }

    pub(crate) fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    pub(crate) fn i64(&mut self) -> Result<i64> {
        Ok(i64::from_le_bytes(self.array()?))
    }

    pub(crate) fn f64(&mut self) -> Result<f64> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    pub(crate) fn coordinate(&mut self) -> Result<[i32; 3]> {
        Ok([self.i32()?, self.i32()?, self.i32()?])
    }

    /// A bit mask of `N` words.
    pub(crate) fn mask<const N: usize>(&mut self) -> Result<[u64; N]> {
        let mut words = [0; N];
        for word in &mut words {
            *word = self.u64()?;
        }
        Ok(words)
    }

    /// A name after its length.
    pub(crate) fn text(&mut self) -> Result<String> {
        let length = self.u32()?;
        if length > LONGEST_NAME {
            return Err(self.error(format!("a name of {length} bytes, expected at most {LONGEST_NAME}")));
        }
        let mut bytes = Vec::new();
        self.fill(&mut bytes, length.into(), "a name")?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}
