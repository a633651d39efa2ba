//! BSDF XML of Radiance and LBNL WINDOW: matrices over patches, and tensor trees.
//!
//! WINDOW's "Front" is the outside of a window. Radiance has a surface's normal point to the inside, and so have we: what the file calls
//! "Transmission Front" comes from our back, and "Reflection Back" is our front's reflection. Values are 1/sr without the cosine; what
//! `ScatteringDataType` says is ignored, because files carry "BTDF" on reflection, too. Text before the document, as programs log it into their
//! output, is left out.

mod read;
mod tree;
mod write;

pub use read::read;
pub use write::{write_patches, write_tree};

use super::hemispheres::Hemispheres;
use super::patches::Band;

/// The words of a file for the pairs of hemispheres, seen with our normal.
const DIRECTIONS: [(&str, Hemispheres); 4] = [
    ("Reflection Back", Hemispheres::ReflectionFront),
    ("Reflection Front", Hemispheres::ReflectionBack),
    ("Transmission Back", Hemispheres::TransmissionFront),
    ("Transmission Front", Hemispheres::TransmissionBack),
];

/// The words of a file for parts of the spectrum.
const BANDS: [(&str, Band); 7] = [
    ("Visible", Band::Visible),
    ("CIE-X", Band::CieX),
    ("CIE-Z", Band::CieZ),
    ("CIE-u", Band::CieU),
    ("CIE-v", Band::CieV),
    ("Solar", Band::Solar),
    ("NIR", Band::Nir),
];

/// Bytes in which a document has to begin.
const LONGEST_PREAMBLE: usize = 1 << 16;

/// Where in a file's bytes its document begins: at the first element or declaration, or behind text at one that only such documents have. `None`
/// where there is none.
pub(super) fn starts_in(bytes: &[u8]) -> Option<usize> {
    let blank = |byte: &u8| byte.is_ascii_whitespace() || [0xef, 0xbb, 0xbf].contains(byte);
    let first = bytes.iter().position(|byte| !blank(byte)).filter(|at| bytes[*at] == b'<');
    let head = &bytes[..bytes.len().min(LONGEST_PREAMBLE)];
    let find = |mark: &str| head.windows(mark.len()).position(|word| word == mark.as_bytes());
    first.or_else(|| find("<?xml")).or_else(|| find("<WindowElement"))
}

/// What the directions of a tensor tree are called.
const SHIRLEY_CHIU: &str = "LBNL/Shirley-Chiu";
