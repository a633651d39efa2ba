//! Temporary files, which take the name of a file once they are complete; those of processes that were killed are swept.

use std::{
    ffi::{OsStr, OsString},
    fs::{self, File},
    hash::{DefaultHasher, Hash, Hasher},
    io::{self, ErrorKind},
    path::{Path, PathBuf},
};

/// How temporary files end.
const PART: &str = ".part";

/// The ending of this process' temporary files.
pub(crate) fn of_this_process() -> String {
    format!(".{}{PART}", std::process::id())
}

/// Makes the temporary file of a file: its name with an ending, or a short one where that is longer than names may be. It is locked as long as it is
/// open, by which others see that it is in use.
pub(crate) fn temporary(path: &Path, ending: &str) -> io::Result<(PathBuf, File)> {
    loop {
        let (temporary, file) = create(path, ending)?;
        // Not all file systems have locks.
        let _ = file.try_lock();
        // Somebody may have swept it before it was locked.
        if is_still(&temporary, &file) {
            return Ok((temporary, file));
        }
    }
}

/// Removes what processes that are no more left of writing a file.
pub(crate) fn sweep(path: &Path) {
    let (Some(name), Some(folder)) = (path.file_name(), path.parent()) else { return };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let starts = [name.to_os_string(), short(name)];
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if starts.iter().any(|start| is_part_of(&entry.file_name(), start)) {
            remove_unused(&entry.path());
        }
    }
}

/// Whether a name is that of a temporary file: the start, a dot, a process' number, `.part`.
fn is_part_of(name: &OsStr, start: &OsStr) -> bool {
    let rest = name.as_encoded_bytes().strip_prefix(start.as_encoded_bytes());
    let number = rest.and_then(|rest| rest.strip_prefix(b".")?.strip_suffix(PART.as_bytes()));
    number.is_some_and(|number| !number.is_empty() && number.iter().all(u8::is_ascii_digit))
}

fn remove_unused(path: &Path) {
    // A pipe of such a name would be waited for.
    if !fs::symlink_metadata(path).is_ok_and(|found| found.is_file()) {
        return;
    }
    // Removed under the lock: a writer that comes meanwhile waits for none, and sees that its file is gone.
    if let Ok(file) = File::open(path)
        && file.try_lock().is_ok()
    {
        let _ = fs::remove_file(path);
    }
}

fn create(path: &Path, ending: &str) -> io::Result<(PathBuf, File)> {
    let name = path.file_name().unwrap_or_default();
    let with_ending = |mut name: OsString| {
        name.push(ending);
        path.with_file_name(name)
    };
    let long = with_ending(name.to_os_string());
    let made = match File::create(&long) {
        Err(error) if error.kind() == ErrorKind::InvalidFilename => {
            let short = with_ending(short(name));
            File::create(&short).map(|file| (short, file))
        }
        made => made.map(|file| (long, file)),
    };
    made.map_err(|error| in_folder(path, error))
}

/// What stands for a name that leaves no room for an ending.
fn short(name: &OsStr) -> OsString {
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    format!("gonio-{:016x}", hasher.finish()).into()
}

/// Says that it is the folder that is not there.
fn in_folder(path: &Path, error: io::Error) -> io::Error {
    match path.parent() {
        Some(folder) if error.kind() == ErrorKind::NotFound && !folder.exists() => {
            io::Error::new(ErrorKind::NotFound, format!("there is no folder {}", folder.display()))
        }
        _ => error,
    }
}

/// Whether a path still names a file that is open.
#[cfg(unix)]
fn is_still(path: &Path, file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    let Ok(open) = file.metadata() else { return true };
    match fs::symlink_metadata(path) {
        Ok(named) => (named.dev(), named.ino()) == (open.dev(), open.ino()),
        Err(error) => error.kind() != ErrorKind::NotFound,
    }
}

/// Open files are not removed on other systems.
#[cfg(not(unix))]
fn is_still(_: &Path, _: &File) -> bool {
    true
}
