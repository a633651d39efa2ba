//! What one compilation leaves for the next: images by where they came from.

use crate::{
    light::LightTexture,
    scene::{Texture, TextureSource},
    texture::{DomeFormat, MipMap},
};
use std::{fs, sync::Arc, time::SystemTime};

/// Tiles of a texture by their UDIM numbers; 0 for an image that is none.
pub(super) type Tiles = Vec<(u32, Arc<MipMap>)>;

/// Images as they were loaded.
#[derive(Clone, Debug, Default)]
pub(super) struct KeptImages {
    /// The limit of texture memory that the images of materials were loaded within.
    limit: u64,
    materials: Vec<(Stamp, Tiles)>,
    lights: Vec<(Stamp, DomeFormat, Arc<LightTexture>)>,
}

/// What an image was read from, and when that was last changed.
#[derive(Clone, Debug)]
pub(super) struct Stamp {
    source: TextureSource,
    colour_space: String,
    modified: Option<SystemTime>,
}

impl Stamp {
    pub(super) fn of(texture: &Texture) -> Self {
        let modified = match &texture.source {
            TextureSource::File(path) => fs::metadata(path).and_then(|file| file.modified()).ok(),
            TextureSource::Encoded { .. } | TextureSource::Tiles { .. } | TextureSource::Pixels { .. } => None,
        };
        Self { source: texture.source.clone(), colour_space: texture.colour_space.clone(), modified }
    }
    /// Whether both are of the same bytes.
    pub(super) fn is(&self, other: &Self) -> bool {
        let same_source = match (&self.source, &other.source) {
            (TextureSource::File(a), TextureSource::File(b)) => a == b,
            (TextureSource::Encoded { bytes: a, .. }, TextureSource::Encoded { bytes: b, .. }) => Arc::ptr_eq(a, b),
            (TextureSource::Tiles { tiles: a, .. }, TextureSource::Tiles { tiles: b, .. }) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.number == b.number && Arc::ptr_eq(&a.bytes, &b.bytes))
            }
            (TextureSource::Pixels { rgba: a, .. }, TextureSource::Pixels { rgba: b, .. }) => Arc::ptr_eq(a, b),
            _ => false,
        };
        same_source && self.colour_space == other.colour_space && self.modified == other.modified
    }
}

impl KeptImages {
    /// Nothing yet of images loaded within a limit.
    pub(super) fn within(limit: u64) -> Self {
        Self { limit, ..Self::default() }
    }
    /// Whether images of materials can be taken over one by one. Within a limit all images share its memory, so that it is all or none.
    pub(super) fn lends<'a>(&self, limit: u64, mut stamps: impl Iterator<Item = &'a Stamp>) -> bool {
        self.limit == limit && (limit == 0 || stamps.all(|stamp| self.tiles(stamp).is_some()))
    }
    /// The tiles of an image that has not changed.
    pub(super) fn tiles(&self, stamp: &Stamp) -> Option<&Tiles> {
        self.materials.iter().find(|(known, _)| known.is(stamp)).map(|(_, tiles)| tiles)
    }
    pub(super) fn keep_tiles(&mut self, stamp: Stamp, tiles: Tiles) {
        self.materials.push((stamp, tiles));
    }
    /// A light's image that has not changed.
    pub(super) fn light(&self, stamp: &Stamp, format: DomeFormat) -> Option<Arc<LightTexture>> {
        let same = |(known, known_format, _): &&(Stamp, DomeFormat, Arc<LightTexture>)| *known_format == format && known.is(stamp);
        self.lights.iter().find(same).map(|(_, _, image)| image.clone())
    }
    pub(super) fn keep_light(&mut self, stamp: Stamp, format: DomeFormat, image: Arc<LightTexture>) {
        self.lights.push((stamp, format, image));
    }
}
