//! Readers and writers of files that nobody vouches for: goniograms of luminaires and the archives that these are sold with, rays of light
//! sources, spectra of lamps, measured scattering of materials, polygon meshes, and the weather.
//!
//! A reader takes the bytes of a whole file and gives plain data or one [`FormatError`]. Counts that a file states are checked against its
//! size before anything is allocated; nothing panics and nothing loops without end, whatever the bytes.

#![forbid(unsafe_code)]

pub mod bsdf;
pub mod gdtf;
pub mod gldf;
pub mod l3d;
pub mod photometry;
pub mod polygons;
pub mod rays;
pub mod spectrum;
pub mod weather;

mod archive;
mod error;
mod short;
mod svg;
mod xml;

pub use error::{FormatError, Place};
pub use short::{rounded, short_number, tame};
pub use svg::{Anchor, Canvas, escape};
