//! The folder of tile files: names, writing, and clearing away what nobody used for long.

use super::file::{self, TextureFacts, TileFile};
use super::memory::lock;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime};

/// What names of tile files end in.
const ENDING: &str = "gtiles";
/// And those of files that are being written.
const PART: &str = "part";
/// Files that nobody used for so long are deleted.
const MOST_AGE: Duration = Duration::from_secs(30 * 24 * 3600);
/// And those used least lately, while all take more than this, bytes.
const MOST_BYTES: u64 = 100 << 30;
/// A file that takes longer to write was left behind by a process that ended.
const LONGEST_WRITE: Duration = Duration::from_secs(24 * 3600);

/// Where tile files are kept.
#[derive(Debug)]
pub struct CacheFolder {
    path: PathBuf,
    most_bytes: u64,
    /// A folder for this process alone, once nothing could be written to the other.
    spare: Mutex<Option<PathBuf>>,
    /// What could not be written, for one warning.
    trouble: Mutex<Option<String>>,
}

impl Drop for CacheFolder {
    fn drop(&mut self) {
        if let Some(spare) = lock(&self.spare).take() {
            // It is a temporary folder: what cannot be deleted the system clears away.
            let _ = fs::remove_dir_all(spare);
        }
    }
}

impl CacheFolder {
    /// A folder, by default `gonio/textures` in the user's folder for caches; it is made once something is written.
    pub fn new(path: Option<&Path>) -> Self {
        let path = path.map_or_else(default_path, Path::to_owned);
        Self { path, most_bytes: MOST_BYTES, spare: Mutex::default(), trouble: Mutex::default() }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What could not be written since the last call, in one sentence.
    pub fn take_trouble(&self) -> Option<String> {
        lock(&self.trouble).take()
    }

    /// The file of a key, if there is a sound one. That it is used counts for its age.
    pub(super) fn find(&self, key: u64) -> Option<(TileFile, TextureFacts)> {
        let path = self.path.join(name(key));
        let found = TileFile::open(&path, key).ok().flatten()?;
        // Another's folder may be read though not written.
        let _ = File::options().append(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        Some(found)
    }

    /// Writes the file of a key and opens it; `None` where that cannot be, here or in a temporary folder, which is noted.
    pub(super) fn write(&self, key: u64, facts: &TextureFacts, pyramid: &[f32]) -> Option<TileFile> {
        match write_in(&self.path, key, facts, pyramid) {
            Ok(file) => return file,
            Err(error) => self.complain(&error),
        }
        let spare = lock(&self.spare).get_or_insert_with(temporary_folder).clone();
        write_in(&spare, key, facts, pyramid).ok().flatten()
    }

    fn complain(&self, error: &io::Error) {
        let path = self.path.display();
        lock(&self.trouble).get_or_insert_with(|| {
            format!(
                "{path}: tiles of textures cannot be written there ({error}); they are kept in a temporary folder, or in memory beyond the \
                 limit; choose another folder for the texture cache"
            )
        });
    }

    /// Deletes what nobody used for a month, and the oldest files while all take more than 100 GiB. Other processes may do the same at once.
    pub fn prune(&self) {
        let Ok(entries) = fs::read_dir(&self.path) else { return };
        let now = SystemTime::now();
        let mut files: Vec<(Duration, u64, PathBuf)> = Vec::new();
        for entry in entries.flatten() {
            let path = entry.path();
            let Ok(about) = entry.metadata() else { continue };
            let age = about.modified().ok().and_then(|time| now.duration_since(time).ok()).unwrap_or_default();
            let longest = match path.extension().and_then(|ending| ending.to_str()) {
                Some(ENDING) => MOST_AGE,
                Some(PART) => LONGEST_WRITE,
                _ => continue,
            };
            if age > longest {
                let _ = fs::remove_file(path);
            } else {
                files.push((age, about.len(), path));
            }
        }
        files.sort();
        let mut total = 0;
        for (_, bytes, path) in files {
            total += bytes;
            if total > self.most_bytes {
                let _ = fs::remove_file(path);
            }
        }
    }
}

fn name(key: u64) -> String {
    format!("{key:016x}.{ENDING}")
}

/// Writes through a file of this process, which takes its name once it is complete. Whoever comes last wins; all write the same.
fn write_in(folder: &Path, key: u64, facts: &TextureFacts, pyramid: &[f32]) -> io::Result<Option<TileFile>> {
    static NUMBERS: AtomicU64 = AtomicU64::new(0);
    fs::create_dir_all(folder)?;
    let number = NUMBERS.fetch_add(1, Ordering::Relaxed);
    let (path, part) = (folder.join(name(key)), folder.join(format!("{key:016x}-{}-{number}.{PART}", std::process::id())));
    let written = file::write(&part, facts, key, pyramid).and_then(|()| fs::rename(&part, &path));
    if let Err(error) = written {
        // It may not even exist; the first error is worth telling.
        let _ = fs::remove_file(&part);
        return Err(error);
    }
    Ok(TileFile::open(&path, key)?.map(|(file, _)| file))
}

fn temporary_folder() -> PathBuf {
    static NUMBERS: AtomicU64 = AtomicU64::new(0);
    let number = NUMBERS.fetch_add(1, Ordering::Relaxed);
    std::env::temp_dir().join(format!("gonio-textures-{}-{number}", std::process::id()))
}

/// The user's folder for caches: XDG_CACHE_HOME, else the system's own.
fn default_path() -> PathBuf {
    let variable = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let own = if cfg!(windows) {
        variable("LOCALAPPDATA")
    } else {
        let folder = if cfg!(target_os = "macos") { "Library/Caches" } else { ".cache" };
        variable("HOME").map(|home| home.join(folder))
    };
    variable("XDG_CACHE_HOME").or(own).unwrap_or_else(std::env::temp_dir).join("gonio").join("textures")
}
