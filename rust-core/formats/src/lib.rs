//! Readers and writers of files that nobody vouches for: goniograms of luminaires, rays of light sources, measured
//! scattering of materials, polygon meshes, and the weather.
//!
//! A reader takes the bytes of a whole file and gives plain data or one [`FormatError`]. Counts that a file states are checked against its
//! size before anything is allocated; nothing panics and nothing loops without end, whatever the bytes.

#![forbid(unsafe_code)]

pub mod bsdf;
pub mod photometry;
pub mod polygons;
pub mod rays;
pub mod weather;

mod error;
mod short;
mod svg;

pub use error::{FormatError, Place};
pub use short::{short_number, tame};
pub use svg::{Anchor, Canvas, escape};
