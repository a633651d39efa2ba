//! The writer of GLDF 1.0-rc.3: a product of one variant with one light.

mod product;

use super::PRODUCT;
use crate::archive::packed;
use crate::error::Result;
use crate::l3d::NewModel;
use crate::photometry::text::number;
use sha2::{Digest, Sha256};

/// Where the files of a product are in its archive.
const PHOTOMETRY: &str = "ldc/luminaire.ldt";
const MODEL: &str = "geo/luminaire.l3d";
const SPECTRUM: &str = "spectrum/lamp.txt";

/// A product that is to be written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NewProduct {
    /// Who makes it.
    pub manufacturer: String,
    /// Its name.
    pub name: String,
    /// Its number; its name stands for none.
    pub number: String,
    /// The program that writes it.
    pub program: String,
    /// When it was made, as XML has dates and times.
    pub time: String,
    /// The bytes of an EULUMDAT file of absolute photometry.
    pub photometry: Vec<u8>,
    /// What is told of the photometry.
    pub figures: ProductFigures,
    /// Connected power in W, if known.
    pub watts: Option<f64>,
    /// What is told of the light source's colour.
    pub colour: ProductColour,
    /// Power of the light source in any unit at wavelengths in nm; empty where it is not known.
    pub spectrum: Vec<(f64, f64)>,
    /// The model, if there is one.
    pub model: Option<NewModel>,
}

/// Figures of a product's photometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProductFigures {
    /// Luminous flux in lm of what leaves the luminaire.
    pub flux: f64,
    /// It over the sources' flux.
    pub light_output_ratio: Option<f64>,
    /// Share of it below the horizontal plane.
    pub downward_fraction: f64,
    /// Full angles in degrees at half the greatest intensity, in C0–C180 and C90–C270.
    pub beam: [f64; 2],
    /// The same at a tenth.
    pub field: [f64; 2],
}

/// Figures of a light source's colour; none of them need be known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProductColour {
    /// Correlated colour temperature in K.
    pub temperature: Option<f64>,
    /// General colour rendering index (CIE 13.3).
    pub rendering: Option<f64>,
    /// CIE 1931 chromaticity.
    pub chromaticity: Option<[f64; 2]>,
    /// Rf and Rg of TM-30.
    pub rendition: Option<[f64; 2]>,
    /// Melanopic daylight efficacy ratio (CIE S 026).
    pub melanopic: Option<f64>,
}

impl NewProduct {
    /// The bytes of the file: the same for the same product. Its identifier is a UUID of its content (RFC 9562, version 8).
    ///
    /// # Errors
    /// A model that cannot be written.
    pub fn write(&self) -> Result<Vec<u8>> {
        let model = self.model.as_ref().map(NewModel::write).transpose()?;
        let spectrum = self.spectrum_file();
        let mut files = vec![(PHOTOMETRY, self.photometry.as_slice())];
        files.extend(model.as_deref().map(|model| (MODEL, model)));
        files.extend(spectrum.as_deref().map(|spectrum| (SPECTRUM, spectrum)));
        let id = identifier(&self.product(""), &files);
        let product = self.product(&id);
        files.insert(0, (PRODUCT, product.as_bytes()));
        packed(&files)
    }

    /// Lines of nanometres and power.
    fn spectrum_file(&self) -> Option<Vec<u8>> {
        let line = |(nm, power): &(f64, f64)| format!("{}\t{}\r\n", number(*nm), number(*power));
        let text: String = self.spectrum.iter().map(line).collect();
        (!text.is_empty()).then(|| text.into_bytes())
    }
}

fn identifier(product: &str, files: &[(&str, &[u8])]) -> String {
    let mut hash = Sha256::new_with_prefix(product);
    files.iter().for_each(|(_, content)| hash.update(content));
    let mut bytes = [0; 16];
    bytes.copy_from_slice(&hash.finalize()[..16]);
    bytes[6] = bytes[6] & 0x0f | 0x80;
    bytes[8] = bytes[8] & 0x3f | 0x80;
    let digits: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    [&digits[..8], &digits[8..12], &digits[12..16], &digits[16..20], &digits[20..]].join("-")
}
