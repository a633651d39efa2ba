//! Writing a file whole or not at all.

use crate::{Error, Result};
use std::{
    fs::{self, File},
    io::{BufWriter, Write},
    path::{Path, PathBuf},
};

/// Bytes that go to the system at once: pictures are long.
const BUFFER: usize = 1 << 20;

/// Writes through a temporary file in the same folder, which takes the name once it is complete, and on disk if it is to be `durable`.
pub fn write_atomically(path: &Path, durable: bool, write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>) -> Result<()> {
    write_through(&temporary_name(path), path, durable, write)
}

/// The same through a temporary file of a given name, in the same folder.
pub fn write_through(
    temporary: &Path,
    path: &Path,
    durable: bool,
    write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> Result<()> {
    let result = write_to(temporary, durable, write).and_then(|()| fs::rename(temporary, path));
    result.map_err(|error| {
        // The temporary file may not even exist; the error worth telling is the first one.
        let _ = fs::remove_file(temporary);
        Error::io(path, error)
    })
}

fn temporary_name(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

fn write_to(path: &Path, durable: bool, write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>) -> std::io::Result<()> {
    let mut file = BufWriter::with_capacity(BUFFER, File::create(path)?);
    write(&mut file)?;
    file.flush()?;
    if durable { file.get_ref().sync_all() } else { Ok(()) }
}
