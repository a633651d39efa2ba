//! Writing a file whole or not at all; what is no ordinary file is written into.

use crate::{
    Error, Result,
    regular::is_of_open_files,
    temporary::{of_this_process, sweep, temporary},
};
use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Cursor, ErrorKind, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
    sync::mpsc::channel,
    thread::Builder,
    time::Duration,
};

/// Bytes that go to the system at once: pictures are long.
const BUFFER: usize = 1 << 20;
/// How long somebody may take to read a pipe.
const LONGEST_WAIT: Duration = Duration::from_secs(10);
/// Most links from one to the next, as the kernel follows them.
const MOST_LINKS: usize = 40;

/// Where a file's bytes go until all are there.
#[derive(Debug)]
pub enum Output {
    /// A temporary file in the same folder.
    File(BufWriter<File>),
    /// Memory, where the target is written into: a pipe cannot be gone back in.
    Memory(Cursor<Vec<u8>>),
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.write(bytes),
            Self::Memory(memory) => memory.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.flush(),
            Self::Memory(_) => Ok(()),
        }
    }
}

impl Seek for Output {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::File(file) => file.seek(to),
            Self::Memory(memory) => memory.seek(to),
        }
    }
}

/// What a path names, links followed.
enum Target {
    /// A file that is replaced, or made.
    File(PathBuf),
    /// A device or a pipe, which is written into.
    Stream(PathBuf),
    /// A standard stream of the process.
    Standard(u32),
}

/// Writes through a temporary file in the same folder, which takes the name once it is complete, and on disk if it is to be `durable`. Links stay:
/// what they lead to is replaced. Devices and pipes are written into, and so are files in folders that take no others.
pub fn write_atomically(path: &Path, durable: bool, write: impl FnOnce(&mut Output) -> io::Result<()>) -> Result<()> {
    if let Ok(Target::File(file)) = target(path) {
        sweep(&file);
    }
    write_beside(path, &of_this_process(), durable, write)
}

/// The same, the temporary file's name ending with `ending`.
pub fn write_beside(path: &Path, ending: &str, durable: bool, write: impl FnOnce(&mut Output) -> io::Result<()>) -> Result<()> {
    let written = target(path).and_then(|target| match target {
        Target::File(file) => match temporary(&file, ending) {
            Ok((temporary, opened)) => replace(&file, &temporary, opened, durable, write),
            Err(error) => into_existing(&file, write).unwrap_or(Err(error)),
        },
        Target::Stream(stream) => in_memory(write).and_then(|bytes| opened(stream)?.write_all(&bytes)),
        Target::Standard(2) => in_memory(write).and_then(|bytes| io::stderr().write_all(&bytes)),
        Target::Standard(_) => in_memory(write).and_then(|bytes| {
            let mut out = io::stdout();
            out.write_all(&bytes).and_then(|()| out.flush())
        }),
    });
    written.map_err(|error| Error::io(path, error))
}

/// Whether a file is replaced or made when it is written; streams and devices are neither.
pub fn is_ordinary(path: &Path) -> bool {
    matches!(target(path), Ok(Target::File(_)))
}

/// Finds out whether a file can be written, before anything is done for it, and leaves nothing.
pub fn check_writable(path: &Path) -> Result<()> {
    let checked = target(path).and_then(|target| {
        let Target::File(file) = target else { return Ok(()) };
        let is_there = match OpenOptions::new().write(true).open(&file) {
            Ok(_) => true,
            Err(error) if error.kind() == ErrorKind::NotFound => false,
            Err(error) => return Err(error),
        };
        match temporary(&file, &of_this_process()) {
            Ok((temporary, _)) => fs::remove_file(temporary),
            Err(_) if is_there => Ok(()),
            Err(error) => Err(error),
        }
    });
    checked.map_err(|error| Error::io(path, error))
}

fn target(path: &Path) -> io::Result<Target> {
    let mut path = path.to_path_buf();
    match fs::metadata(&path) {
        Ok(found) if found.is_dir() => return Err(io::Error::new(ErrorKind::IsADirectory, "a folder has this name")),
        Ok(_) => {}
        Err(error) if error.kind() == ErrorKind::NotFound => {}
        Err(error) => return Err(error),
    }
    for _ in 0..MOST_LINKS {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let Ok(found) = fs::symlink_metadata(&path) else { break };
        if !found.is_symlink() {
            return Ok(if found.is_file() { Target::File(path) } else { Target::Stream(path) });
        }
        // What a process has open goes by links that lead nowhere for pipes, and to the start of files.
        if fs::canonicalize(folder).is_ok_and(|folder| is_of_open_files(&folder)) {
            let number = path.file_name().and_then(|name| name.to_str()?.parse().ok());
            return Ok(number.filter(|number| (1..=2).contains(number)).map_or(Target::Stream(path), Target::Standard));
        }
        path = folder.join(fs::read_link(&path)?);
    }
    Ok(Target::File(path))
}

fn replace(path: &Path, temporary: &Path, file: File, durable: bool, write: impl FnOnce(&mut Output) -> io::Result<()>) -> io::Result<()> {
    let mut output = Output::File(BufWriter::with_capacity(BUFFER, file));
    let result = write(&mut output).and_then(|()| output.flush()).and_then(|()| match &output {
        Output::File(file) if durable => file.get_ref().sync_all(),
        _ => Ok(()),
    });
    let result = result.and_then(|()| fs::rename(temporary, path));
    if result.is_err() {
        if let Output::File(file) = output {
            // What did not fit must not be tried again.
            drop(file.into_parts());
        }
        // The error worth telling is the first one.
        let _ = fs::remove_file(temporary);
    }
    result
}

/// Opens a device or pipe. A pipe with a name opens when somebody reads it.
fn opened(path: PathBuf) -> io::Result<File> {
    let (send, opened) = channel();
    // The thread stays with a pipe that nobody reads: nothing calls it back.
    Builder::new().spawn(move || send.send(OpenOptions::new().append(true).open(path)))?;
    opened.recv_timeout(LONGEST_WAIT).unwrap_or_else(|_| Err(io::Error::new(ErrorKind::TimedOut, "nobody reads the pipe")))
}

/// Writes into a file that is there already, in a folder that takes no other; nothing where it cannot be opened.
fn into_existing(path: &Path, write: impl FnOnce(&mut Output) -> io::Result<()>) -> Option<io::Result<()>> {
    let mut file = OpenOptions::new().write(true).open(path).ok()?;
    let whole = |bytes: Vec<u8>| file.write_all(&bytes).and_then(|()| file.set_len(bytes.len() as u64));
    Some(in_memory(write).and_then(whole))
}

fn in_memory(write: impl FnOnce(&mut Output) -> io::Result<()>) -> io::Result<Vec<u8>> {
    let mut output = Output::Memory(Cursor::default());
    write(&mut output)?;
    let Output::Memory(memory) = output else { unreachable!("the memory that was made") };
    Ok(memory.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("gonio-atomic-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    fn put(path: &Path, text: &str) -> Result<()> {
        write_atomically(path, false, |file| file.write_all(text.as_bytes()))
    }

    fn names(folder: &Path) -> usize {
        fs::read_dir(folder).expect("the folder").count()
    }

    #[test]
    fn the_longest_names_are_written_and_longer_ones_refused_before() {
        let folder = folder("long");
        for length in [244, 251, 255] {
            let path = folder.join("n".repeat(length));
            check_writable(&path).expect("a name that may be");
            put(&path, "whole").expect("a name that may be");
            assert_eq!(fs::read_to_string(&path).expect("the file"), "whole");
        }
        assert!(check_writable(&folder.join("n".repeat(256))).is_err());
        assert_eq!(names(&folder), 3, "nothing is left over");
        fs::remove_dir_all(folder).expect("ours");
    }

    #[test]
    fn what_killed_processes_left_is_swept_and_what_others_write_stays() {
        let folder = folder("swept");
        let path = folder.join("o.exr");
        let long = folder.join("n".repeat(255));
        fs::write(folder.join("o.exr.4000000.part"), "of one that was killed").expect("a file");
        for other in ["o.exr.part", "o.exr.x.part", "p.exr.4000000.part"] {
            fs::write(folder.join(other), "of somebody else").expect("a file");
        }
        let (_, file) = temporary(&path, ".4000001.part").expect("a writer");
        let (left, _) = temporary(&long, ".4000000.part").expect("a file without a writer");
        put(&path, "whole").expect("a file");
        put(&long, "whole").expect("a file");
        assert!(!left.exists() && !folder.join("o.exr.4000000.part").exists());
        assert!(folder.join("o.exr.4000001.part").exists(), "somebody writes it");
        drop(file);
        put(&path, "whole").expect("a file");
        assert_eq!(names(&folder), 5);
        fs::remove_dir_all(folder).expect("ours");
    }

    #[test]
    fn what_cannot_be_written_is_known_before() {
        let folder = folder("check");
        fs::create_dir(folder.join("taken.exr")).expect("a folder");
        put(&folder.join("file"), "").expect("a file");
        for wrong in ["taken.exr", "file/o.exr", "missing/o.exr"] {
            assert!(check_writable(&folder.join(wrong)).is_err(), "{wrong}");
            assert!(put(&folder.join(wrong), "x").is_err(), "{wrong}");
        }
        check_writable(&folder.join("new.exr")).expect("a new file");
        assert_eq!(names(&folder), 2, "nothing is left over");
        fs::remove_dir_all(folder).expect("ours");
    }

    #[test]
    fn a_write_that_fails_leaves_the_old_file_and_nothing_else() {
        let folder = folder("fails");
        let path = folder.join("o.txt");
        put(&path, "old").expect("a file");
        let failed = write_atomically(&path, true, |file| {
            file.write_all(b"half")?;
            Err(io::Error::other("full"))
        });
        assert!(failed.is_err());
        assert_eq!(fs::read_to_string(&path).expect("the file"), "old");
        assert_eq!(names(&folder), 1);
        fs::remove_dir_all(folder).expect("ours");
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_and_devices_are_written_into() {
        use std::os::unix::fs::symlink;
        let folder = folder("links");
        put(&folder.join("target"), "old").expect("a file");
        symlink("target", folder.join("link")).expect("a link");
        symlink(folder.join("link"), folder.join("second")).expect("a link");
        symlink("nowhere", folder.join("dangling")).expect("a link");
        symlink("/dev/null", folder.join("null")).expect("a link");
        for name in ["link", "second", "dangling", "null"] {
            check_writable(&folder.join(name)).expect(name);
            put(&folder.join(name), name).expect(name);
            assert!(folder.join(name).is_symlink(), "{name}");
        }
        let text = |name: &str| fs::read_to_string(folder.join(name)).expect(name);
        assert_eq!((text("target"), text("nowhere"), text("null")), ("second".into(), "dangling".into(), String::new()));
        assert_eq!([is_ordinary(&folder.join("link")), is_ordinary(&folder.join("null"))], [true, false]);
        fs::remove_dir_all(folder).expect("ours");
    }
}
