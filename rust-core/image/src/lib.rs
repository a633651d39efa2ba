//! Colour spaces, and images: decoding, mip maps and lookups on lanes.

pub mod colour;
pub mod texture;
