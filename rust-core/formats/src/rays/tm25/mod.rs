//! IES TM-25-13 ray files (`.tm25ray`).
//!
//! A head of 256 bytes, eight flags that say which numbers each ray has, nine texts of 1000 characters, spectra, names of further columns,
//! a text, and then the rays, all little-endian; lengths in mm, wavelengths in nm, fluxes in W or lm. The layout follows the public ray set
//! tools of J. Muschaweck (Unlicense) and files of light sources' makers.

mod read;
mod write;

pub use read::read;
pub use write::write;

/// What a file begins with, and the version behind it.
const MAGIC: (&[u8; 4], i32) = (b"TM25", 2013);

/// Bytes of the head that mean nothing yet.
const RESERVED: usize = 168;

/// Texts and the bytes of each.
const TEXTS: usize = 9;
const TEXT: usize = 4000;

/// Bytes of a column's name.
const COLUMN_NAME: usize = 512;

/// What spectra are padded to.
const PADDING: usize = 32;
