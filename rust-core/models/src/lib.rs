//! Honeybee models (HBJSON) and Radiance scene files as gonio scenes.
//!
//! [`read`] takes either by its ending. What one object has wrong is told with the file and its line, or its place in the JSON, and leaves that
//! object out; the rest is read. Facts of the formats: honeybee-schema 2.x, Radiance's reference manual; `docs/models.md` says what becomes of what.

mod builder;
mod default_sky;
mod hbjson;
mod measured;
mod modifier;
mod outline;
mod rad;
#[cfg(test)]
mod tests;
mod vector;
mod view;

use gonio_formats::photometry;
use gonio_scene::{Diagnostic, Error, Goniogram, Result, Scene, open_file};
use std::{collections::BTreeMap, io::Read, path::Path, sync::Arc};

pub use default_sky::{DEFAULT_SKY_LUX, add_default_sky};

/// The longest file in bytes.
const LONGEST: u64 = 1 << 30;

/// A luminaire of a model, with all that its file says.
#[derive(Clone, Debug)]
pub struct Luminaire {
    /// What the model calls it.
    pub name: String,
    /// What the file holds.
    pub photometry: photometry::Goniogram,
    /// What its lights have of it.
    pub goniogram: Arc<Goniogram>,
}

/// A model as a scene.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// What is to be rendered: metres, z up.
    pub scene: Scene,
    /// What is not as the model asks for.
    pub diagnostics: Vec<Diagnostic>,
    /// Metres in the model's unit.
    pub metres_per_unit: f64,
    /// Objects read, by type.
    pub counts: BTreeMap<String, usize>,
    /// The luminaires whose files the model holds.
    pub luminaires: Vec<Luminaire>,
}

/// How a model is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The state of dynamic groups by name, where that is not the first, 0.
    pub states: Vec<(String, usize)>,
}

/// Whether a file is a model by its name.
pub fn is_model(path: &Path) -> bool {
    matches!(ending(path).as_str(), "hbjson" | "rad")
}

/// Reads a model.
///
/// # Errors
/// The file is missing, is no JSON or no model, or an option names what it does not have.
pub fn read(path: &Path, options: &Options) -> Result<Model> {
    let text = read_text(path)?;
    if ending(path) == "rad" { rad::read(path, &text, options) } else { hbjson::read(path, &text, options) }
}

fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// A file's text; bytes that are no UTF-8, as in old comments, are replaced.
fn read_text(path: &Path) -> Result<String> {
    let mut bytes = Vec::new();
    let file = open_file(path).map_err(|error| Error::io(path, error))?;
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| Error::io(path, error))?;
    if bytes.len() as u64 > LONGEST {
        return Err(Error::Format { path: path.into(), line: None, problem: format!("more than {LONGEST} bytes: no model") });
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
