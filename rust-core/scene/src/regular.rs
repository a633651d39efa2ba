//! Opening files that are read: a pipe or a device in the place of one would have the reader wait for ever.

use std::{
    fs::{self, File},
    io::{Error, ErrorKind, Read, Result, Take},
    path::Path,
};

/// Opens a regular file, which ends where its length says: some files of the system that have none never do. What the shell hands over
/// (`/dev/stdin`, `<(command)`) is read to its end.
///
/// # Errors
/// What the system says; folders, pipes with a name, devices.
pub fn open_file(path: &Path) -> Result<Take<File>> {
    let found = fs::metadata(path)?;
    if found.is_file() {
        return Ok(File::open(path)?.take(found.len()));
    }
    if !found.is_dir() && is_open_file(path) {
        return Ok(File::open(path)?.take(u64::MAX));
    }
    let what = if found.is_dir() { "a folder" } else { "a pipe or device" };
    Err(Error::new(ErrorKind::InvalidInput, format!("{what} was found, expected a file")))
}

/// The bytes of such a file.
pub fn read_file(path: &Path) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_file(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether a folder, links followed, is that of what a process has open: Linux' `/proc/PID/fd`.
pub(crate) fn is_of_open_files(folder: &Path) -> bool {
    folder.starts_with("/proc") && folder.ends_with("fd")
}

/// Whether a path names what a process has open already.
fn is_open_file(path: &Path) -> bool {
    let mut path = path.to_path_buf();
    loop {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if fs::canonicalize(folder).is_ok_and(|folder| is_of_open_files(&folder)) {
            return true;
        }
        let Ok(next) = fs::read_link(&path) else { return false };
        path = folder.join(next);
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::{os::unix::fs::symlink, process::Command};

    #[test]
    fn pipes_devices_and_folders_are_refused_at_once() {
        let folder = std::env::temp_dir().join(format!("gonio-regular-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join("file"), "all").expect("a file");
        symlink("file", folder.join("link")).expect("a link");
        symlink("/dev/zero", folder.join("zero")).expect("a link");
        Command::new("mkfifo").arg(folder.join("pipe")).status().expect("a pipe");
        for name in ["file", "link"] {
            assert_eq!(read_file(&folder.join(name)).expect(name), b"all");
        }
        for name in ["pipe", "zero", "missing", "."] {
            assert!(open_file(&folder.join(name)).is_err(), "{name}");
        }
        fs::remove_dir_all(folder).expect("ours");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_without_length_is_empty() {
        // Its content comes for as long as somebody reads.
        assert_eq!(read_file(Path::new("/proc/self/status")).expect("a file"), b"");
    }
}
