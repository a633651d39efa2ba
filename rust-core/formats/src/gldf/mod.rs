//! GLDF: the archive that a maker sells a luminaire with, its data (`product.xml`), photometry, models, spectra and pictures
//! (Global Lighting Data Format 1.0, <https://github.com/globallightingdata/gldf>).
//!
//! A product has variants; a variant has emitters, each of one or more lights; a light names its photometry and its light source.

mod choose;
mod emitters;
mod geometry;
mod light;
mod read;
mod total;
mod write;

use crate::archive::Archive;
use crate::error::FormatError;
use crate::spectrum::SpectralPoint;

pub use light::{Emergency, Light, RatedFlux};
pub use write::{NewProduct, ProductColour, ProductFigures};

/// The name of the file of an archive that holds the product.
pub(crate) const PRODUCT: &str = "product.xml";

/// A product, with its archive.
#[derive(Debug)]
pub struct Gldf<'a> {
    archive: Archive<'a>,
    /// Who makes it.
    pub manufacturer: String,
    /// The file's own identifier.
    pub id: String,
    /// The format's version, such as `1.0-rc.3`; empty where the file does not say.
    pub version: String,
    /// The program that wrote the file.
    pub created_with: String,
    /// The product's name.
    pub name: Texts,
    /// The product's number.
    pub number: Texts,
    /// All files that the product names.
    pub files: Vec<GldfFile>,
    /// Spectra of light sources.
    pub spectra: Vec<GldfSpectrum>,
    /// Emitters, which variants use.
    pub emitters: Vec<Emitter>,
    /// What can be ordered.
    pub variants: Vec<Variant>,
    /// What is doubtful, with the file inside the archive and its line.
    pub warnings: Vec<FormatError>,
}

/// A text in several languages: code of the language and text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Texts(pub Vec<(String, String)>);

/// A file that a product names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GldfFile {
    /// Its identifier.
    pub id: String,
    /// What it is, such as `ldc/eulumdat`.
    pub content_type: String,
    /// Where it is.
    pub place: FilePlace,
    /// Bytes, as the archive states them; `None` where the archive has no such file.
    pub size: Option<u64>,
}

/// Where a product's file is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FilePlace {
    /// In the archive, by its path there.
    Inside(String),
    /// At an address, which is told and never fetched.
    Address(String),
}

/// A spectrum of a light source.
#[derive(Clone, Debug, PartialEq)]
pub struct GldfSpectrum {
    /// Its identifier.
    pub id: String,
    /// The file of wavelengths and values, by its place in [`Gldf::files`].
    pub file: Option<usize>,
    /// Wavelengths with power of any unit, where the product lists them itself.
    pub values: Vec<SpectralPoint>,
}

/// What shines, or senses, as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Emitter {
    /// Its identifier.
    pub id: String,
    /// Lights that shine together. A sensor has none.
    pub lights: Vec<Light>,
    /// Whether it is a sensor.
    pub is_sensor: bool,
}

/// What can be ordered of a product.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: Texts,
    /// Its order number.
    pub number: Texts,
    /// Global trade item number.
    pub gtin: String,
    /// How it may be mounted, such as `Ceiling, pendant 0.5 m`.
    pub mountings: Vec<String>,
    /// Its emitters; one may come several times, at different places of the model.
    pub emitters: Vec<EmitterUse>,
    /// Simple body, where it has one.
    pub simple: Option<SimpleGeometry>,
    /// Files of its model by their places in [`Gldf::files`], one for each format and level of detail.
    pub models: Vec<usize>,
}

/// An emitter in a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct EmitterUse {
    /// Its place in [`Gldf::emitters`], or why it has none.
    pub emitter: Result<usize, FormatError>,
    /// The name of the model's light emitting object; empty without a model.
    pub object: String,
}

/// A body of simple shape with its luminous face, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SimpleGeometry {
    /// Length, width and height; width 0 means round.
    pub body: [f64; 3],
    /// Length and width of the luminous face; width 0 means round.
    pub emitter: [f64; 2],
    /// Luminous heights towards C0, C90, C180 and C270.
    pub heights: [f64; 4],
}

impl Texts {
    /// The English text, else the first.
    pub fn shown(&self) -> &str {
        let english = self.0.iter().find(|(language, _)| language.to_ascii_lowercase().starts_with("en"));
        english.or(self.0.first()).map_or("", |(_, text)| text)
    }

    /// Whether it says this in any language, capitals aside.
    pub fn says(&self, asked: &str) -> bool {
        self.0.iter().any(|(_, text)| text.to_lowercase() == asked.to_lowercase())
    }
}

impl FilePlace {
    /// The path in the archive, or the address.
    pub fn as_str(&self) -> &str {
        match self {
            Self::Inside(place) | Self::Address(place) => place,
        }
    }
}

/// Whether bytes begin as an archive does.
pub fn looks_like(bytes: &[u8]) -> bool {
    crate::archive::looks_like(bytes)
}

/// A file's path and the variant, or of a GDTF file the mode, that is asked for after it: `lamp.gldf#wide` is `lamp.gldf` and `wide`.
pub fn split_variant(path: &str) -> (&str, Option<&str>) {
    const ENDINGS: [&[u8]; 2] = [b".gldf#", b".gdtf#"];
    let length = ENDINGS[0].len();
    let at = path.as_bytes().windows(length).position(|part| ENDINGS.iter().any(|ending| part.eq_ignore_ascii_case(ending)));
    match at.map(|at| at + length) {
        Some(after) => (&path[..after - 1], Some(&path[after..]).filter(|variant| !variant.is_empty())),
        None => (path, None),
    }
}
