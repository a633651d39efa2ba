//! A measured luminaire as a product: a GLDF file with its photometry.

use super::Reduced;
use crate::error::Result;
use crate::gldf::{NewProduct, ProductColour, ProductFigures};
use crate::l3d::NewModel;
use crate::photometry::text::is_date;
use crate::photometry::{Goniogram, ldt};

/// When files are made that state no day: the first that archives know.
const DAY: &str = "1980-01-01";

/// The program that writes files.
const PROGRAM: &str = concat!("gonio ", env!("CARGO_PKG_VERSION"));

/// What a product has beside its photometry.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProductParts {
    /// What is told of the light source's colour.
    pub colour: ProductColour,
    /// Power of the light source in any unit at wavelengths in nm; empty where it is not known.
    pub spectrum: Vec<(f64, f64)>,
    /// The model; its name, program and time are the product's.
    pub model: Option<NewModel>,
}

impl Reduced {
    /// The bytes of a GLDF file: EULUMDAT of absolute photometry with the sources' light output ratio beside it, and the parts. The same measurement makes
    /// the same bytes: the time is midnight of the head's day, or of 1980-01-01 without one.
    ///
    /// # Errors
    /// A model that cannot be written.
    pub fn to_gldf(&self, parts: &ProductParts) -> Result<Vec<u8>> {
        let text = |keyword: &str| self.goniogram.text(keyword).unwrap_or_default().to_owned();
        let (name, day) = (text("LUMINAIRE"), text("ISSUEDATE"));
        let time = format!("{}T00:00:00Z", if is_date(&day) { &day } else { DAY });
        let model = parts.model.clone().map(|model| NewModel { name: name.clone(), program: PROGRAM.into(), time: time.clone(), ..model });
        let figures = self.figures();
        let angles = |spreads: [super::MeasuredSpread; 2]| spreads.map(|measured| measured.spread.angle());
        let product = NewProduct {
            manufacturer: text("MANUFAC"),
            number: text("LUMCAT"),
            program: PROGRAM.into(),
            photometry: ldt::write(&self.absolute_in(parts.colour)),
            figures: ProductFigures {
                flux: self.flux,
                light_output_ratio: figures.light_output_ratio.map(|ratio| ratio.value.min(1.0)),
                downward_fraction: figures.downward_fraction.value,
                beam: angles(figures.beam),
                field: angles(figures.field),
            },
            watts: self.goniogram.lamps().map(|lamps| lamps.watts),
            colour: parts.colour,
            spectrum: parts.spectrum.clone(),
            model,
            name,
            time,
        };
        product.write()
    }

    /// Absolute photometry whose lamps have a colour.
    fn absolute_in(&self, colour: ProductColour) -> Goniogram {
        let mut goniogram = self.absolute();
        for lamps in &mut goniogram.lamp_sets {
            let whole = |value: Option<f64>, unit: &str| value.map(|value| format!("{}{unit}", value.round()));
            lamps.colour = whole(colour.temperature, " K").unwrap_or_default();
            lamps.colour_rendering = whole(colour.rendering, "").unwrap_or_default();
        }
        goniogram
    }
}
