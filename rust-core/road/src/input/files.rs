//! The files of a road.

use super::keys::Keys;
use crate::error::{Result, RoadError};
use std::{
    fs::{File, metadata},
    io::{Error, Read},
    path::{Path, PathBuf},
};

/// Bytes of the longest file: hundreds of times a luminaire's.
const LONGEST: u64 = 64 << 20;

/// The bytes of an ordinary file: a pipe would be waited for.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = metadata(path).and_then(|found| match found.is_file() {
        true if found.len() > LONGEST => Err(Error::other(format!("more than {LONGEST} bytes"))),
        true => Ok(File::open(path)?.take(LONGEST)),
        false => Err(Error::other("not a file")),
    });
    let done = file.and_then(|mut file| file.read_to_end(&mut bytes));
    done.map_err(|source| RoadError::File { path: path.into(), source })?;
    Ok(bytes)
}

/// The path and the bytes of a file that a key names, relative to the file that the key stands in.
pub(super) fn named(keys: &Keys<'_>, key: &str, name: &str, expected: &str) -> Result<(PathBuf, Vec<u8>)> {
    let path = keys.path().with_file_name(name);
    let bytes = bytes(&path).map_err(|error| match error {
        RoadError::File { path, source } => {
            keys.problem_of(key, &format!("names {}, which cannot be read: {source}; {expected}", path.display()))
        }
        other => other,
    })?;
    Ok((path, bytes))
}
