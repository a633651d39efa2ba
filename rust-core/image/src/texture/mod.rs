//! Image textures: decoding, mip pyramids, and filtered lookups on lanes.
//!
//! [`load_set`] turns [`TextureRequest`]s into [`MipMap`]s; a [`TextureTable`] holds them and is sampled with one texture for a whole batch of
//! hits. Files are not trusted: a bad one gives a [`TextureError`] and never more memory than its own size makes plausible.

mod encoder;
mod error;
mod format;
mod image;
mod lat_long;
mod limits;
mod load;
mod mip_map;
mod paged;
mod product;
mod pyramid;
mod resolve;
mod sample;
mod table;
mod texel;
mod texels;
mod udim;
mod wrap;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests;

pub use error::{TextureError, TextureErrorKind};
pub use format::{RadianceHeader, decode};
pub use image::{Image, Texels};
pub use lat_long::{DomeFormat, LatLong};
pub use load::{Source, TextureRequest, load, load_image, load_set};
pub use mip_map::MipMap;
pub use paged::{CacheFolder, TextureMemory, TextureStatistics, TileReader, load_paged};
pub use table::{TextureId, TextureTable};
pub use texel::TexelFormat;
pub use udim::{find_tiles, is_udim, tile_path};
pub use wrap::{Filter, Wrap};
