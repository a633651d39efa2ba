//! ZIP archives that nobody vouches for, read from memory: stored and deflated files, each within what is said of its size; and those that are
//! written.

mod write;

use crate::error::{FormatError, Result};
use crate::photometry::text::quote;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use rawzip::{CompressionMethod, ZipArchive, ZipArchiveEntryWayfinder, ZipSliceArchive};
use std::collections::HashMap;

pub(crate) use write::packed;

/// Bytes of the longest file of an archive: tens of times the longest mesh of a luminaire.
pub(crate) const LONGEST: u64 = 64 << 20;

/// A deflated byte becomes 1032 at most.
const RATIO: u64 = 1032;

/// Files of the fullest archive.
const MOST: usize = 1 << 16;

/// An archive's list of files, and its bytes.
#[derive(Debug)]
pub(crate) struct Archive<'a> {
    zip: ZipSliceArchive<&'a [u8]>,
    entries: Vec<Entry>,
    /// Entries by their names in small letters.
    by_name: HashMap<String, usize>,
}

#[derive(Debug)]
struct Entry {
    name: String,
    /// The name's bytes were no UTF-8, so that its letters beyond ASCII are not known.
    is_guess: bool,
    place: ZipArchiveEntryWayfinder,
    method: CompressionMethod,
    is_encrypted: bool,
    packed: u64,
    size: u64,
    crc: u32,
}

/// Whether bytes begin as a ZIP archive does.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

impl<'a> Archive<'a> {
    /// The files of an archive.
    ///
    /// # Errors
    /// What is no archive, or whose list of files is broken.
    pub(crate) fn open(bytes: &'a [u8]) -> Result<Self> {
        let broken = |error: rawzip::Error| FormatError::whole(format!("no ZIP archive that can be read: {error}"));
        let zip = ZipArchive::from_slice(bytes).map_err(broken)?;
        let mut entries = Vec::new();
        let mut found = zip.entries();
        while let Some(entry) = found.next_entry().map_err(broken)? {
            if entries.len() == MOST {
                return Err(FormatError::whole(format!("the archive holds more than {MOST} files")));
            }
            let path = entry.file_path();
            let (name, is_guess) = name(path.as_ref());
            if !name.ends_with('/') {
                entries.push(Entry {
                    name,
                    is_guess,
                    place: entry.wayfinder(),
                    method: entry.compression_method(),
                    is_encrypted: entry.flags().is_encrypted(),
                    packed: entry.compressed_size_hint(),
                    size: entry.uncompressed_size_hint(),
                    crc: entry.crc32(),
                });
            }
        }
        let by_name = entries.iter().enumerate().rev().map(|(index, entry)| (entry.name.to_lowercase(), index)).collect();
        Ok(Self { zip, entries, by_name })
    }

    /// Names of all files, with their folders.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.name.as_str())
    }

    /// The size that is stated of a file.
    pub(crate) fn size(&self, name: &str) -> Option<u64> {
        self.find(name).map(|entry| entry.size)
    }

    /// A file by its name, capitals aside, else by a name that differs in letters that no one knows.
    fn find(&self, name: &str) -> Option<&Entry> {
        let known = self.by_name.get(&name.to_lowercase()).map(|index| &self.entries[*index]);
        let guessed = || self.entries.iter().find(|entry| entry.is_guess && may_be(&entry.name, name));
        known.or_else(|| if name.is_ascii() { None } else { guessed() })
    }

    /// A file's bytes.
    ///
    /// # Errors
    /// A file that is not there, is too long, is packed in another way, or is not what the archive says of it. All begin with its name.
    pub(crate) fn read(&self, name: &str) -> Result<Vec<u8>> {
        let problem = |problem: String| inside(name, &FormatError::whole(problem));
        let entry = self.find(name).ok_or_else(|| problem("is not in the archive".into()))?;
        let Entry { packed, size, .. } = *entry;
        if size > LONGEST {
            return Err(problem(format!("{size} bytes are stated, at most {LONGEST} are read")));
        }
        if entry.is_encrypted {
            return Err(problem("is encrypted".into()));
        }
        if size > packed.saturating_mul(RATIO) {
            return Err(problem(format!("{packed} bytes cannot unpack to {size}")));
        }
        let found = self.zip.get_entry(entry.place).map_err(|error| problem(error.to_string()))?;
        let bytes = match entry.method {
            CompressionMethod::STORE => found.data().to_vec(),
            CompressionMethod::DEFLATE => decompress_to_vec_with_limit(found.data(), size as usize)
                .map_err(|error| problem(format!("cannot be unpacked to the {size} bytes that are stated: {error}")))?,
            other => return Err(problem(format!("is packed by {other:?}, expected stored or deflated"))),
        };
        if bytes.len() as u64 != size || crc32fast::hash(&bytes) != entry.crc {
            return Err(problem("is not what the archive says: its size or checksum differs".into()));
        }
        Ok(bytes)
    }
}

/// A problem of a file inside an archive.
pub(crate) fn inside(name: &str, error: &FormatError) -> FormatError {
    FormatError::whole(format!("{}: {error}", crate::tame(name)))
}

/// A name with slashes, and whether its letters beyond ASCII are a guess.
fn name(bytes: &[u8]) -> (String, bool) {
    let (name, is_guess) = match std::str::from_utf8(bytes) {
        Ok(name) => (name.to_owned(), false),
        Err(_) => (bytes.iter().map(|byte| char::from(*byte)).collect(), true),
    };
    (name.replace('\\', "/"), is_guess)
}

/// Whether two names differ in letters beyond ASCII alone.
fn may_be(guess: &str, name: &str) -> bool {
    let same = |(a, b): (char, char)| a == b || (!a.is_ascii() && !b.is_ascii());
    guess.chars().count() == name.chars().count() && guess.chars().zip(name.chars()).all(same)
}

/// A few of the names, for a message.
pub(crate) fn some_of<'n>(names: impl Iterator<Item = &'n str>) -> String {
    const SHOWN: usize = 8;
    let mut shown: Vec<String> = names.take(SHOWN + 1).map(quote).collect();
    if shown.len() > SHOWN {
        shown[SHOWN] = "…".into();
    }
    shown.join(", ")
}
