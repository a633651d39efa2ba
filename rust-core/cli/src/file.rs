//! Files that commands are given.

use gonio::{Error, Result};
use std::{fs::File, io::Read, path::Path};

/// The bytes of a file of at most `longest`; a longer one is no such thing as `what` says.
pub(super) fn read(path: &Path, longest: u64, what: &str) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| Error::io(path, error))?;
    file.take(longest + 1).read_to_end(&mut bytes).map_err(|error| Error::io(path, error))?;
    if bytes.len() as u64 > longest {
        let problem = format!("more than {longest} bytes: no {what}");
        return Err(Error::Format { path: path.into(), line: None, problem });
    }
    Ok(bytes)
}

/// The first bytes of a file, fewer where it has fewer.
pub(super) fn start(path: &Path, count: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| Error::io(path, error))?;
    file.take(count).read_to_end(&mut bytes).map_err(|error| Error::io(path, error))?;
    Ok(bytes)
}

/// What a file's name ends with after the last dot, in small letters.
pub(super) fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// Refuses an option's file whose name ends otherwise.
pub(super) fn check_ending(option: &str, path: &Path, endings: &[&str]) -> Result<()> {
    let found = ending(path);
    if endings.contains(&found.as_str()) {
        return Ok(());
    }
    Err(Error::setting(option, format!("{}: the ending is '{found}', expected {}", path.display(), endings.join(" or "))))
}

/// Makes the folder that a file is to be written to.
pub(super) fn make_folder(path: &Path) -> Result<()> {
    match path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        Some(folder) => std::fs::create_dir_all(folder).map_err(|error| Error::io(folder, error)),
        None => Ok(()),
    }
}
