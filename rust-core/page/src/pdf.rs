//! The page as PDF, by a browser without a window.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    thread::sleep,
    time::{Duration, Instant, SystemTime, UNIX_EPOCH},
};

/// Browsers that are looked for, by their names on PATH.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// What a browser may take.
const LIMIT: Duration = Duration::from_secs(90);
/// How often it is looked after.
const WAIT: Duration = Duration::from_millis(50);

/// Why there is no PDF.
#[derive(Debug, thiserror::Error)]
pub enum PdfError {
    /// The machine has no browser for it.
    #[error(
        "PDF is written by a browser, and none of chromium, chromium-browser and google-chrome is on PATH; write .html and print it from any browser"
    )]
    NoBrowser,
    /// The browser made none.
    #[error("{} wrote no PDF: {problem}; write .html and print it from any browser", browser.display())]
    Browser {
        /// The browser.
        browser: PathBuf,
        /// What happened.
        problem: String,
    },
    /// The files that go to and from the browser could not be kept.
    #[error("{}: {source}", path.display())]
    File {
        /// The folder or file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// It was to stop.
    #[error("interrupted")]
    Stopped,
}

/// Whether there is a browser for it, before anything is computed for a page.
///
/// # Errors
/// There is none.
pub fn check_browser() -> Result<(), PdfError> {
    found().map(drop)
}

fn found() -> Result<PathBuf, PdfError> {
    browser(env::var_os("PATH").unwrap_or_default().as_os_str()).ok_or(PdfError::NoBrowser)
}

/// The bytes of a PDF of a page, by the first browser on PATH. `stopped` is asked meanwhile.
///
/// # Errors
/// There is no browser, it fails or takes more than 90 s, or it is to stop.
pub fn pdf(html: &str, stopped: &dyn Fn() -> bool) -> Result<Vec<u8>, PdfError> {
    let browser = found()?;
    let folder = Folder::new()?;
    let (page, out) = (folder.0.join("page.html"), folder.0.join("page.pdf"));
    let kept = |path: &Path| {
        let path = path.to_owned();
        move |source| PdfError::File { path, source }
    };
    fs::write(&page, html).map_err(kept(&page))?;
    let failed = |problem: String| PdfError::Browser { browser: browser.clone(), problem };
    let mut to = std::ffi::OsString::from("--print-to-pdf=");
    to.push(&out);
    let mut profile = std::ffi::OsString::from("--user-data-dir=");
    profile.push(folder.0.join("profile"));
    let mut command = Command::new(&browser);
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer"]).arg(profile).arg(to).arg(&page);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().map_err(|error| failed(error.to_string()))?;
    wait(&mut child, stopped, &failed)?;
    let bytes = fs::read(&out).map_err(|error| failed(error.to_string()))?;
    if bytes.starts_with(b"%PDF") { Ok(bytes) } else { Err(failed("its file is no PDF".to_owned())) }
}

/// The first browser in a list of folders.
fn browser(path: &std::ffi::OsStr) -> Option<PathBuf> {
    let folders: Vec<PathBuf> = env::split_paths(path).collect();
    BROWSERS.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name))).find(|path| path.is_file())
}

/// Waits for the browser, and ends it where it is to stop or takes too long.
fn wait(child: &mut Child, stopped: &dyn Fn() -> bool, failed: &dyn Fn(String) -> PdfError) -> Result<(), PdfError> {
    let begun = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) if status.success() => return Ok(()),
            Ok(Some(status)) => return Err(failed(status.to_string())),
            Err(error) => return Err(failed(error.to_string())),
            Ok(None) => {}
        }
        let late = begun.elapsed() > LIMIT;
        if late || stopped() {
            // Of a browser that has ended by itself there is nothing left to end.
            let _ = child.kill();
            let _ = child.wait();
            return Err(if late { failed(format!("it took more than {} s", LIMIT.as_secs())) } else { PdfError::Stopped });
        }
        sleep(WAIT);
    }
}

/// A folder of one's own that goes away.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, PdfError> {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos());
        let path = env::temp_dir().join(format!("gonio-page-{}-{now}", std::process::id()));
        // One that is there already is somebody else's.
        fs::create_dir(&path).map_err(|source| PdfError::File { path: path.clone(), source })?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What the browser still writes there stays in the folder for temporary files.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_without_a_browser_says_so() {
        assert_eq!(browser(std::ffi::OsStr::new("/nowhere:/nor/there")), None);
        assert!(PdfError::NoBrowser.to_string().contains("chromium"));
    }
}
