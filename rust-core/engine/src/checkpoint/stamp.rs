//! What bits on disk are of: program, SIMD level, scene and settings. Others would give other bits.

use crate::{
    error::{Error, Result},
    scene::{Digest, Scene, Settings, TextureSource, digest_scene, open_file},
    texture::{find_tiles, is_udim},
};
use gonio_simd::Execution;
use serde::{Deserialize, Serialize};
use std::{
    io::{BufReader, Read},
    path::{Path, PathBuf},
};

/// This program.
const PROGRAM: &str = concat!("gonio ", env!("CARGO_PKG_VERSION"));

/// Settings that do not change a sample.
const HARMLESS: [&str; 4] = ["threads", "time_limit_s", "texture_memory", "texture_cache"];

/// What bits on disk are of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stamp {
    /// Name and version of the program.
    program: String,
    /// The SIMD level.
    level: String,
    /// Digest of the scene and its images.
    scene: u64,
    /// The settings.
    pub settings: Settings,
}

impl Stamp {
    /// That of a scene at a SIMD level, all files of which are read again.
    pub fn new(scene: &Scene, execution: Execution) -> Self {
        let settings = scene.settings.clone();
        Self { program: PROGRAM.to_owned(), level: execution.name().to_owned(), scene: digest(scene), settings }
    }

    /// Refuses the checkpoint in `path`, which is of `other`, for bits of this.
    pub(crate) fn check(&self, other: &Self, path: &Path, harmless: &[&str]) -> Result<()> {
        let problem = if other.program != self.program {
            format!("it was written by {}, this is {}", other.program, self.program)
        } else if other.level != self.level {
            format!("it was rendered at the SIMD level {0}, this is {1}; GONIO_SIMD={0} renders its bits", other.level, self.level)
        } else if let Some(difference) = self.different_setting(&other.settings, harmless) {
            difference
        } else if other.scene != self.scene {
            "it is of another scene".to_owned()
        } else {
            return Ok(());
        };
        Err(Error::Format { path: path.to_owned(), line: None, problem: format!("this checkpoint cannot be used: {problem}") })
    }

    /// The first setting that another render has otherwise.
    fn different_setting(&self, other: &Settings, harmless: &[&str]) -> Option<String> {
        let object =
            |settings: &Settings| serde_json::to_value(settings).ok().and_then(|value| value.as_object().cloned()).unwrap_or_default();
        let (wanted, found) = (object(&self.settings), object(other));
        let different = |(name, _): &(&String, &serde_json::Value)| {
            found.get(*name) != wanted.get(*name) && ![&HARMLESS, harmless].concat().contains(&name.as_str())
        };
        let (name, value) = wanted.iter().find(different)?;
        let other = found.get(name).map_or_else(|| "absent".to_owned(), ToString::to_string);
        Some(format!("its {} is {other}, {value} was asked for", name.replace('_', " ")))
    }
}

/// A number that tells scenes apart, with the bytes of their image files.
fn digest(scene: &Scene) -> u64 {
    let mut digest = digest_scene(scene);
    for texture in &scene.textures {
        if let TextureSource::File(path) = &texture.source {
            files(path).iter().for_each(|path| add_file(&mut digest, path));
        }
    }
    digest.value()
}

/// The files of an image: one, or the tiles of a set.
fn files(path: &Path) -> Vec<PathBuf> {
    let text = path.to_string_lossy();
    if is_udim(&text) { find_tiles(&text).into_iter().map(|(_, path)| path).collect() } else { vec![path.to_owned()] }
}

/// Adds a file's bytes; one that cannot be read adds what could be, as the picture is made without it.
fn add_file(digest: &mut Digest, path: &Path) {
    let Ok(mut file) = open_file(path).map(BufReader::new) else { return };
    let mut bytes = vec![0; 1 << 16];
    while let Ok(count) = file.read(&mut bytes)
        && count > 0
    {
        digest.add(&bytes[..count]);
    }
}
