//! Scene bundles: a JSON description and the bytes of its arrays in one file, rendered again without the host it came from.
//!
//! Layout: the line `gonio2`, a line with the lengths of both parts in bytes, the JSON, the arrays (little-endian) one behind the other.
//! Textures stay files by path; those given in memory travel along.

use super::{Scene, TextureSource, Tile, blob};
use crate::{
    atomic::write_atomically,
    digest::Digest,
    regular::read_file,
    {Error, Result},
};
use gonio_image::texture::{find_tiles, is_udim};
use serde_json::Value;
use std::{io::Write, path::Path, path::PathBuf};

const MAGIC: &str = "gonio2\n";

/// Saves a scene.
pub fn save_bundle(scene: &Scene, path: &Path) -> Result<()> {
    let (json, arrays) = parts(scene, path)?;
    write_atomically(path, true, |file| write(&json, &arrays, file))
}

/// A bundle in memory.
pub fn to_bundle(scene: &Scene) -> Result<Vec<u8>> {
    let path = Path::new("bundle");
    let (json, arrays) = parts(scene, path)?;
    let mut bytes = Vec::with_capacity(json.len() + arrays.len() + 64);
    write(&json, &arrays, &mut bytes).map_err(|error| Error::io(path, error))?;
    Ok(bytes)
}

/// Description and arrays.
fn parts(scene: &Scene, path: &Path) -> Result<(Vec<u8>, Vec<u8>)> {
    let (json, arrays) = blob::collect(|| serde_json::to_vec(scene));
    Ok((json.map_err(|error| Error::io(path, std::io::Error::other(error)))?, arrays))
}

fn write(json: &[u8], arrays: &[u8], file: &mut (impl Write + ?Sized)) -> std::io::Result<()> {
    file.write_all(MAGIC.as_bytes())?;
    writeln!(file, "{} {}", json.len(), arrays.len())?;
    file.write_all(json)?;
    file.write_all(arrays)
}

/// The scene with the bytes of its image files in memory; files that cannot be read stay names, as the picture is made without them.
pub fn with_images(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for texture in &mut scene.textures {
        let TextureSource::File(path) = &texture.source else { continue };
        let name = path.to_string_lossy().into_owned();
        if is_udim(&name) {
            let read = |(number, path): (u32, PathBuf)| Some(Tile { number, bytes: read_file(&path).ok()?.into() });
            let tiles = find_tiles(&name).into_iter().filter_map(read).collect();
            texture.source = TextureSource::Tiles { name, tiles };
        } else if let Ok(bytes) = read_file(path) {
            texture.source = TextureSource::Encoded { name, bytes: bytes.into() };
        }
    }
    scene
}

/// Loads a scene.
pub fn load_bundle(path: &Path) -> Result<Scene> {
    of_bundle(&read_file(path).map_err(|error| Error::io(path, error))?, path)
}

/// The scene of a bundle's bytes; `path` stands in messages.
pub fn of_bundle(bytes: &[u8], path: &Path) -> Result<Scene> {
    let broken = |problem: &str| Error::Format { path: path.to_owned(), line: None, problem: problem.to_owned() };
    let body = bytes.strip_prefix(MAGIC.as_bytes()).ok_or_else(|| broken("this is not a gonio bundle: its first line is not 'gonio2'"))?;
    let end = body.iter().position(|byte| *byte == b'\n').ok_or_else(|| broken("the line of lengths is missing"))?;
    let lengths = std::str::from_utf8(&body[..end]).ok().and_then(|line| line.split_once(' '));
    let lengths = lengths.and_then(|(json, arrays)| Some((json.parse::<usize>().ok()?, arrays.parse::<usize>().ok()?)));
    let (json, arrays) = lengths.ok_or_else(|| broken("the second line does not hold two lengths"))?;
    let parts = &body[end + 1..];
    if json.checked_add(arrays) != Some(parts.len()) {
        return Err(broken(&format!("{} bytes were found, expected {json} of description and {arrays} of arrays", parts.len())));
    }
    let (json, arrays) = parts.split_at(json);
    blob::supply(arrays.to_vec(), || serde_json::from_slice(json)).map_err(|error| broken(&error.to_string()))
}

/// A digest of a scene without its settings; of files that it names only the names are in it.
///
/// Where elements come from is left out: USD numbers the prototypes of instances otherwise each time that a stage is opened.
pub fn digest_scene(scene: &Scene) -> Digest {
    let parts = (&scene.meshes, &scene.instances, &scene.materials, &scene.textures, &scene.measured, &scene.lights, &scene.cameras);
    // Scenes without curves, points and fog keep the digests that their checkpoints have.
    let shapes = (!scene.curves.is_empty() || !scene.points.is_empty()).then_some((&scene.curves, &scene.points));
    let fog = (!scene.fields.is_empty() || !scene.atmosphere.is_clear()).then_some((&scene.fields, &scene.atmosphere));
    let (json, mut digest) = blob::digest(|| match (shapes, fog) {
        (None, None) => serde_json::to_value(parts),
        (Some(shapes), None) => serde_json::to_value((parts, shapes)),
        (shapes, Some(fog)) => serde_json::to_value((parts, shapes, fog)),
    });
    // Descriptions that cannot be written differ from all others in their arrays.
    let mut json = json.unwrap_or_default();
    leave_out_origins(&mut json);
    digest.add(json.to_string().as_bytes());
    digest
}

fn leave_out_origins(json: &mut Value) {
    match json {
        Value::Object(fields) => {
            fields.remove("origin");
            fields.values_mut().for_each(leave_out_origins);
        }
        Value::Array(values) => values.iter_mut().for_each(leave_out_origins),
        _ => {}
    }
}
