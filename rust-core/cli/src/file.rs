//! Files that commands are given, and those they write.

use super::messages::print;
use gonio::{
    Error, Result,
    output::{check_writable, is_ordinary, write_atomically},
    scene::open_file,
};
use std::{
    io::{ErrorKind, Read, Write},
    path::{Path, PathBuf},
    process,
};

/// Letters of a file's name that the name of what is kept in another folder has.
const KEPT_LETTERS: usize = 64;

/// The bytes of a file of at most `longest`; a longer one is no such thing as `what` says.
pub(super) fn read(path: &Path, longest: u64, what: &str) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = open_file(path).map_err(|error| Error::io(path, error))?;
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
    let file = open_file(path).map_err(|error| Error::io(path, error))?;
    file.take(count).read_to_end(&mut bytes).map_err(|error| Error::io(path, error))?;
    Ok(bytes)
}

/// What a file's name ends with after the last dot, in small letters.
pub(super) fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// Refuses an option's file whose name ends otherwise. What goes to a pipe or a device needs no ending where there is but one.
pub(super) fn check_ending(option: &str, path: &Path, endings: &[&str]) -> Result<()> {
    let found = ending(path);
    if endings.contains(&found.as_str()) || (found.is_empty() && endings.len() == 1 && !is_ordinary(path)) {
        return Ok(());
    }
    Err(Error::setting(option, format!("{}: the ending is '{found}', expected {}", path.display(), endings.join(" or "))))
}

/// Makes sure, before anything is computed for them, that files can be written; folders that are missing are made.
pub(super) fn check_targets<'a>(paths: impl IntoIterator<Item = &'a PathBuf>) -> Result<()> {
    paths.into_iter().try_for_each(|path| {
        make_folder(path)?;
        check_writable(path)
    })
}

/// Makes the folder that a file is to be written to.
pub(super) fn make_folder(path: &Path) -> Result<()> {
    match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists()) {
        Some(folder) => std::fs::create_dir_all(folder).map_err(|error| Error::io(folder, error)),
        None => Ok(()),
    }
}

/// Writes a file of these bytes, or keeps them elsewhere as [`write_or_keep`] does.
pub(super) fn put(path: &Path, bytes: &[u8]) -> Result<()> {
    write_or_keep(path, |path| write_atomically(path, true, |file| file.write_all(bytes)))
}

/// Has `write` write a file. Where the system refuses it, as on a full disk, what was computed is written to another folder, and the error says where.
pub(super) fn write_or_keep(path: &Path, write: impl Fn(&Path) -> Result<()>) -> Result<()> {
    let source = match write(path) {
        Err(Error::Io { source, .. }) if source.kind() != ErrorKind::BrokenPipe => source,
        done => return done,
    };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let from = name.char_indices().rev().nth(KEPT_LETTERS).map_or(0, |(at, _)| at);
    let name = format!("gonio-{}-{}", process::id(), &name[from..]);
    let folders = std::env::current_dir().into_iter().chain([std::env::temp_dir()]).chain(std::env::home_dir());
    let kept = folders.map(|folder| folder.join(&name)).find(|kept| write(kept).is_ok());
    let told = kept.map_or(String::new(), |kept| format!("; what was computed is kept as {}", kept.display()));
    Err(Error::io(path, std::io::Error::new(source.kind(), format!("{source}{told}"))))
}

/// Names a file that was written, on standard output, unless that is where it went.
pub(super) fn print_path(path: &Path) {
    if is_ordinary(path) {
        print(&path.display().to_string());
    }
}
