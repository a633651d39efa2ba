//! Scene bundles: a JSON description and its arrays in one file, rendered again without the host it came from.
//!
//! Layout: the magic `gonio1\n`, the JSON's length as a decimal line, the JSON. Textures stay files by path; those given in memory travel along.

use super::Scene;
use crate::{
    error::{Error, Result},
    output::write_atomically,
};
use std::{fs, path::Path};

const MAGIC: &str = "gonio1\n";

/// Saves a scene.
pub fn save_bundle(scene: &Scene, path: &Path) -> Result<()> {
    let json = serde_json::to_vec(scene).map_err(|error| Error::io(path, std::io::Error::other(error)))?;
    write_atomically(path, |file| {
        file.write_all(MAGIC.as_bytes())?;
        writeln!(file, "{}", json.len())?;
        file.write_all(&json)
    })
}

/// Loads a scene.
pub fn load_bundle(path: &Path) -> Result<Scene> {
    let bytes = fs::read(path).map_err(|error| Error::io(path, error))?;
    let broken = |problem: &str| Error::Format { path: path.to_owned(), line: None, problem: problem.to_owned() };
    let body = bytes.strip_prefix(MAGIC.as_bytes()).ok_or_else(|| broken("this is not a gonio bundle: its first line is not 'gonio1'"))?;
    let end = body.iter().position(|byte| *byte == b'\n').ok_or_else(|| broken("the length line is missing"))?;
    let length = std::str::from_utf8(&body[..end]).ok().and_then(|text| text.parse::<usize>().ok());
    let json = &body[end + 1..];
    match length {
        Some(length) if length == json.len() => serde_json::from_slice(json).map_err(|error| broken(&error.to_string())),
        Some(length) => Err(broken(&format!("{} bytes of description were found, expected {length}", json.len()))),
        None => Err(broken("the length line holds no number")),
    }
}
