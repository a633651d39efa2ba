//! Images.

use super::Origin;
use serde::{Deserialize, Serialize};
use std::{path::PathBuf, sync::Arc};

/// Where the pixels come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum TextureSource {
    /// A file; `<UDIM>` in the name stands for the tile number.
    File(PathBuf),
    /// An encoded file in memory; its first bytes tell its format.
    Encoded {
        /// Name for messages.
        name: String,
        /// The file's bytes.
        #[serde(with = "super::blob")]
        bytes: Arc<[u8]>,
    },
    /// A set of UDIM tiles as encoded files in memory.
    Tiles {
        /// Name for messages.
        name: String,
        /// The tiles.
        tiles: Vec<Tile>,
    },
    /// Linear float RGBA, rows from the top.
    Pixels {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// RGBA.
        #[serde(with = "super::blob")]
        rgba: Arc<[f32]>,
    },
}

/// One image of a set of UDIM tiles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tile {
    /// 1001 for the unit square, one more to its right, ten more above it.
    pub number: u32,
    /// The file's bytes.
    #[serde(with = "super::blob")]
    pub bytes: Arc<[u8]>,
}

/// An image and how its numbers are meant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Texture {
    /// Where it came from.
    pub origin: Origin,
    /// The pixels.
    pub source: TextureSource,
    /// Colour space by any of the names that USD, MaterialX and OpenColorIO use; `auto` decides by the file.
    pub colour_space: String,
}
