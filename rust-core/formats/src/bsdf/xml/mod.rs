//! BSDF XML of Radiance and LBNL WINDOW: matrices over patches, and tensor trees.
//!
//! WINDOW's "Front" is the outside of a window. Radiance has a surface's normal point to the inside, and so have we: what the file calls
//! "Transmission Front" comes from our back, and "Reflection Back" is our front's reflection. Values are 1/sr without the cosine; what
//! `ScatteringDataType` says is ignored, because files carry "BTDF" on reflection, too.

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

/// What the directions of a tensor tree are called.
const SHIRLEY_CHIU: &str = "LBNL/Shirley-Chiu";
