//! The file: the line `gonio checkpoint 2`, the length of the description, the description in JSON, the film tile by tile and what light paths brought, a digest of all that.

use super::{Checkpoint, Identity};
use crate::scene::{Digesting, open_file};
use crate::{
    compile::{check_tiles, window},
    error::{Error, Result},
    film::{Film, LEAST_TILE},
    output::write_beside,
};
use std::{
    fs::File,
    io::{self, BufReader, Read, Take, Write},
    path::Path,
};

const MAGIC: &[u8] = b"gonio checkpoint 2\n";
/// Longest description.
const MOST_DESCRIPTION: u32 = 1 << 28;

/// Writes a film as it is at the moment, whole or not at all; what an earlier kill left of one is overwritten.
pub fn write_checkpoint(path: &Path, identity: &Identity, film: &Film) -> Result<()> {
    let description = serde_json::to_vec(identity).map_err(|error| Error::io(path, io::Error::other(error)))?;
    write_beside(path, ".part", true, |file| {
        let mut out = Digesting::new(file);
        out.write_all(MAGIC)?;
        out.write_all(&(description.len() as u32).to_le_bytes())?;
        out.write_all(&description)?;
        film.write(&mut out)?;
        let digest = out.digest.value();
        out.write_all(&digest.to_le_bytes())
    })
}

impl Checkpoint {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self> {
        let broken = |problem: String| Error::Format { path: path.to_owned(), line: None, problem };
        let damaged = |error| damaged(path, error);
        let (mut input, length) = open(path)?;
        let identity = description(&mut input).map_err(damaged)?;
        let window = window(&identity.settings)?;
        check_tiles(&identity.settings, window)?;
        let tiles = Film::tiles_of(window);
        if tiles.saturating_mul(LEAST_TILE) > length {
            return Err(broken("the checkpoint is shorter than its picture".into()));
        }
        let mut film =
            Film::new(&identity.settings, window, identity.exposure, identity.besides).with_manifests(identity.manifests.clone());
        film = film.with_view(identity.view);
        film.fill(&mut input).map_err(damaged)?;
        let expected = input.digest.value();
        let mut found = [0; 8];
        input.read_exact(&mut found).map_err(damaged)?;
        if u64::from_le_bytes(found) != expected {
            return Err(broken("the checkpoint is damaged: its digest differs".into()));
        }
        Ok(Self { identity, film })
    }

    /// Reads what a file is of, without its film.
    pub(super) fn read_identity(path: &Path) -> Result<Identity> {
        description(&mut open(path)?.0).map_err(|error| damaged(path, error))
    }
}

/// A file to read from, and its length in bytes.
fn open(path: &Path) -> Result<(Digesting<BufReader<Take<File>>>, u64)> {
    let file = open_file(path).map_err(|error| Error::io(path, error))?;
    let length = file.limit();
    Ok((Digesting::new(BufReader::with_capacity(1 << 20, file)), length))
}

fn damaged(path: &Path, error: io::Error) -> Error {
    let problem = match error.kind() {
        io::ErrorKind::UnexpectedEof => "the checkpoint ends before its time".to_owned(),
        io::ErrorKind::InvalidData => format!("the checkpoint is damaged: {error}"),
        _ => return Error::io(path, error),
    };
    Error::Format { path: path.to_owned(), line: None, problem }
}

fn description(input: &mut impl Read) -> io::Result<Identity> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidData, problem);
    let mut magic = [0; MAGIC.len()];
    input.read_exact(&mut magic)?;
    if magic != MAGIC {
        return Err(invalid("its first line is not 'gonio checkpoint 2'".into()));
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
