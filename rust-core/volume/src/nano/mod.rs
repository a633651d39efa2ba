//! NanoVDB's files and raw grids, versions 32.x.
//!
//! Source of the format: NanoVDB 32.9 (`NanoVDB.h`, `io/IO.h`). A file is segments of a header, a record for each grid, and the grids, each one block
//! of memory that may be packed as a whole. A raw file is such blocks alone.

mod layout;
mod list;
mod read;

pub(crate) use list::{Listing, list};
pub(crate) use read::read;

/// Whether the first eight bytes are those of a file (`NanoVDB0` of old, `NanoVDB2`) or of a raw grid (`NanoVDB1`, `NanoVDB0` of old).
pub(crate) fn is_magic(magic: [u8; 8]) -> bool {
    magic.starts_with(b"NanoVDB") && (b'0'..=b'2').contains(&magic[7])
}
