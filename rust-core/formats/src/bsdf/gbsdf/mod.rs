//! Our own table files, `.gbsdf`: what a gonioreflectometer gives, on any grid. The format is described in `docs/bsdf-formats.md`.

mod read;
mod scan;
mod write;

pub use read::read;
pub use write::{Encoding, write};

/// The first words of every such file.
pub(crate) const MAGIC: &str = "gbsdf 1";
