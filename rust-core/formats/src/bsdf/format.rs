//! Which of the formats a file has.

use super::tensor_file::{self, TensorFile};
use super::{gbsdf, merl, utia, xml, zemax};

/// The formats of measured materials that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// MERL `.binary`.
    Merl,
    /// RGL `.bsdf`.
    Rgl,
    /// Polarised `.pbsdf`.
    Pbrdf,
    /// UTIA `.bin`.
    Utia,
    /// BSDF XML of Radiance and WINDOW.
    Xml,
    /// Zemax tabular BSDF.
    Zemax,
    /// Our own `.gbsdf`.
    Gbsdf,
}

impl Format {
    /// The format of a file's bytes, told by their content; `name`, the file's name, decides only for broken MERL files.
    pub fn of(bytes: &[u8], name: &str) -> Option<Self> {
        if bytes.starts_with(tensor_file::MAGIC) {
            // A file that cannot be read is named by its reader.
            let is_polarised = TensorFile::read(bytes).is_ok_and(|file| file.find("M").is_some());
            return Some(if is_polarised { Self::Pbrdf } else { Self::Rgl });
        }
        if bytes.starts_with(gbsdf::MAGIC.as_bytes()) {
            return Some(Self::Gbsdf);
        }
        if merl::shape(bytes).is_some() {
            return Some(Self::Merl);
        }
        if bytes.len() == utia::SIZE {
            return Some(Self::Utia);
        }
        if xml::starts_in(bytes).is_some() {
            return Some(Self::Xml);
        }
        match core::str::from_utf8(bytes) {
            Ok(text) if zemax::is_zemax(text) => Some(Self::Zemax),
            _ if name.to_ascii_lowercase().ends_with(".binary") => Some(Self::Merl),
            _ => None,
        }
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Merl => "MERL",
            Self::Rgl => "RGL",
            Self::Pbrdf => "pBRDF",
            Self::Utia => "UTIA",
            Self::Xml => "BSDF XML",
            Self::Zemax => "Zemax BSDF",
            Self::Gbsdf => "gbsdf",
        }
    }
}
