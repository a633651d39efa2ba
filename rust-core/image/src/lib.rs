//! Colour spaces, and images: decoding, mip maps and lookups on lanes; deep pictures; how much memory there is for them.

pub mod colour;
pub mod deep;
pub mod memory;
pub mod texture;
