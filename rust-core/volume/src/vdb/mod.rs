//! OpenVDB's files, versions 220 to 225.
//!
//! Source of the format: OpenVDB 13 (`io/Archive.cc`, `io/GridDescriptor.cc`, `io/Compression.h`, `tree/*Node.h`, `math/Maps.h`).

mod list;
mod nodes;
mod packing;
mod read;
#[cfg(test)]
mod tests;
mod tree;
pub(crate) mod write;

pub(crate) use list::{Listing, list};
pub(crate) use read::read;

/// The first eight bytes.
pub(crate) const MAGIC: [u8; 8] = *b" BDV\0\0\0\0";

/// Between a grid's name and a number that tells it from others of the same name.
const SEPARATOR: char = '\u{1e}';

/// At the end of the type of grids whose real numbers are saved as halves.
const HALF_SUFFIX: &str = "_HalfFloat";
