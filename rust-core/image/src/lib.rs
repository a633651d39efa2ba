//! Colour spaces, and images: decoding, mip maps and lookups on lanes; deep pictures.

pub mod colour;
pub mod deep;
pub mod texture;
