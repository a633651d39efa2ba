//! IFC building models: made USD stages by the Python package, in a folder that goes with them.

use gonio::{Diagnostic, Error, Result, scene::Origin};
use gonio_usd::{Loaded, StageOptions};
use pyo3::prelude::*;
use std::{
    fs,
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, AtomicU32, Ordering},
};

/// A model as a stage, and what was told of it on the way.
pub(super) struct IfcStage {
    pub(super) stage: gonio_usd::Stage,
    path: PathBuf,
    notes: Vec<Diagnostic>,
    _folder: Folder,
}

/// A folder that is removed with what it holds.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        // What cannot be removed is left to the system, as all in its folder for such files.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Whether a file is such a model, by its ending.
pub(super) fn is_ifc(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ifc"))
}

impl IfcStage {
    /// Reads a model.
    ///
    /// # Errors
    /// What `gonio.ifc.write_stage` refuses, and what opening the stage finds.
    pub(super) fn open(py: Python<'_>, path: &Path, options: &StageOptions) -> Result<Self> {
        let folder = folder()?;
        let stage = folder.0.join("model.usdc");
        let written =
            py.import("gonio.ifc").and_then(|module| module.call_method1("write_stage", (path, &stage))?.extract::<Vec<String>>());
        let notes = written.map_err(|error| Error::Format { path: path.into(), line: None, problem: told(py, path, &error) })?;
        let origin = Origin::new(path.to_string_lossy());
        let notes = notes.into_iter().map(|note| Diagnostic::warning(&origin, note)).collect();
        Ok(Self { stage: gonio_usd::Stage::open(py, &stage, options)?, path: path.into(), notes, _folder: folder })
    }

    /// The model's file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// As [`gonio_usd::Stage::load`], with what was told of the model.
    pub(super) fn load(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
        let mut loaded = self.stage.load(py, options, cancel)?;
        loaded.diagnostics.splice(0..0, self.notes.iter().cloned());
        Ok(loaded)
    }
}

/// A new folder among the system's temporary files.
fn folder() -> Result<Folder> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let name = format!("gonio-ifc-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let path = std::env::temp_dir().join(name);
    fs::create_dir_all(&path).map_err(|source| Error::io(&path, source))?;
    Ok(Folder(path))
}

/// What the package says, without the file's name, which messages begin with.
fn told(py: Python<'_>, path: &Path, error: &PyErr) -> String {
    let message = error.value(py).to_string();
    let name = path.to_string_lossy();
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.into());
    let absolute = absolute.to_string_lossy();
    let bare = message.strip_prefix(&*absolute).or_else(|| message.strip_prefix(&*name)).and_then(|rest| rest.strip_prefix(": "));
    bare.map_or(message.clone(), str::to_owned)
}
