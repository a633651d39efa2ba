//! GDTF: stage fixtures (General Device Type Format, DIN SPEC 15800, <https://github.com/mvrdevelopment/spec>): an archive whose
//! `description.xml` says which beams a fixture has in each of its modes, by flux and two angles, and what its emitters' spectra are.
//!
//! It holds no measured light distribution. [`Gdtf::goniogram`] makes one of the two angles.

mod geometry;
mod light;
mod numbers;
mod read;
mod shape;

use crate::archive::{Archive, some_of};
use crate::error::{FormatError, Result};
use crate::photometry::text::quote;

/// The name of the file of an archive that holds the fixture.
const DESCRIPTION: &str = "description.xml";

/// A fixture.
#[derive(Clone, Debug, PartialEq)]
pub struct Gdtf {
    /// Who makes it.
    pub manufacturer: String,
    /// Its name.
    pub name: String,
    /// The format's version, such as `1.2`; empty where the file does not say.
    pub version: String,
    /// Its identifier.
    pub id: String,
    /// How it may be driven; each mode has the beams of its geometry.
    pub modes: Vec<Mode>,
    /// Light sources that are mixed or filtered.
    pub emitters: Vec<GdtfEmitter>,
    /// What is doubtful, with the file inside the archive and its line.
    pub warnings: Vec<FormatError>,
}

/// A mode of a fixture.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Its name.
    pub name: String,
    /// Its beams.
    pub beams: Vec<Beam>,
}

/// A beam of a fixture.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Its name.
    pub name: String,
    /// How it is drawn.
    pub kind: BeamKind,
    /// Luminous flux in lm.
    pub flux: f64,
    /// Full angle in degrees at half the greatest intensity.
    pub beam_deg: f64,
    /// Full angle in degrees at a tenth of it.
    pub field_deg: f64,
    /// Radius in metres where it starts.
    pub radius: f64,
    /// Colour temperature in K.
    pub temperature: f64,
    /// Colour rendering index, where the file states one.
    pub rendering: Option<f64>,
    /// Power in W, where the file states one.
    pub watts: Option<f64>,
    /// The place in [`Gdtf::emitters`] of its white light source, where one is named.
    pub emitter: Option<usize>,
    /// Where it looks in the fixture's axes, hanging.
    pub direction: [f64; 3],
    /// What the file does not state, so that the format's own values stand.
    pub unstated: Vec<&'static str>,
}

/// How a beam is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BeamKind {
    /// A cone with soft edges.
    Wash,
    /// The same, of a Fresnel lens.
    Fresnel,
    /// The same, of a plano-convex lens.
    PlanoConvex,
    /// A cone with hard edges.
    Spot,
    /// A pyramid with hard edges, of this ratio of width to height.
    Rectangle(f64),
    /// No beam: the geometry itself shines.
    None,
    /// The same.
    Glow,
}

impl BeamKind {
    /// The format's word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Wash => "Wash",
            Self::Fresnel => "Fresnel",
            Self::PlanoConvex => "PC",
            Self::Spot => "Spot",
            Self::Rectangle(_) => "Rectangle",
            Self::None => "None",
            Self::Glow => "Glow",
        }
    }
}

/// A light source of a fixture.
#[derive(Clone, Debug, PartialEq)]
pub struct GdtfEmitter {
    /// Its name.
    pub name: String,
    /// CIE 1931 x and y, where the file states them.
    pub chromaticity: Option<[f64; 2]>,
    /// Wavelengths in nm with energies of any unit, increasing, at the greatest drive that was measured; often none.
    pub spectrum: Vec<(f64, f64)>,
}

/// Whether an archive is a fixture: by what it holds, else by the ending of `name`.
pub fn is_fixture(bytes: &[u8], name: &str) -> bool {
    let by_name = || std::path::Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gdtf"));
    match Archive::open(bytes) {
        Ok(archive) => archive.size(DESCRIPTION).is_some() || archive.size(crate::gldf::PRODUCT).is_none() && by_name(),
        Err(_) => by_name(),
    }
}

impl Gdtf {
    /// The place of the mode that is meant: by its name, capitals aside, else its number from 1; without a word the first.
    ///
    /// # Errors
    /// None of that name, or a fixture without modes.
    pub fn mode(&self, asked: Option<&str>) -> Result<usize> {
        let Some(asked) = asked.map(str::trim).filter(|asked| !asked.is_empty()) else {
            let none = || FormatError::whole("the fixture has no mode, and so no beam that can be chosen");
            return if self.modes.is_empty() { Err(none()) } else { Ok(0) };
        };
        let named = self.modes.iter().position(|mode| mode.name.to_lowercase() == asked.to_lowercase());
        let number = || asked.parse::<usize>().ok().and_then(|number| number.checked_sub(1)).filter(|index| *index < self.modes.len());
        named.or_else(number).ok_or_else(|| {
            let names = some_of(self.modes.iter().map(|mode| mode.name.as_str()));
            FormatError::whole(format!("no mode {} was found among {}: {names}, or a number from 1", quote(asked), self.modes.len()))
        })
    }
}
