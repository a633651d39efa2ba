//! Goniograms: luminous intensity by direction, as luminaires' makers hand it out.
//!
//! [`read`] takes IES LM-63 (1986, 1991, 1995, 2002, 2019), EULUMDAT, TM-33, GLDF and GDTF files and gives one [`Goniogram`] in candela and metres;
//! [`ies`], [`ldt`] and [`tm33`] hold the formats' readers and writers, [`measured`] makes goniograms of what was counted,
//! [`polar_diagram`] and [`cone_diagram`] are the two drawings that lighting people look for.
//!
//! The luminaire's frame: the photometric zero direction (γ = 0, nadir) is −Z, C0 is +X, C90 is +Y.

pub mod ies;
pub mod ldt;
pub mod measured;
pub mod tm33;

mod arrange;
mod axis;
mod beside;
pub(crate) mod check;
mod cone;
mod convert;
mod direct_ratio;
mod figures;
mod flux;
mod goniogram;
mod grid;
mod lookup;
mod modify;
mod opening;
mod plausible;
mod polar;
mod sum;
mod symmetry;
pub(crate) mod text;
mod ugr;
mod zones;

pub use beside::{Beside, beside};
pub use cone::cone_diagram;
pub use figures::{Aside, Figures, Spread};
pub use goniogram::{Goniogram, HeaderLine, LampSet, PhotometricType, Stated, Symmetry, Tilt};
pub use grid::Grid;
pub use opening::{Opening, OpeningShape};
pub use polar::{PolarUnit, polar_diagram};
pub use text::is_date;
pub use ugr::{CATALOGUE_SPACING, NoIndex, REFLECTANCES, ROOMS, SPACINGS, UgrTable, position_index};
pub use zones::{Bug, Zones};

use crate::error::{FormatError, Result};
use crate::gdtf::{self, Gdtf};
use crate::gldf::{self, Gldf};
use crate::tame;

/// Reads an IES, EULUMDAT, TM-33, GLDF or GDTF file; its content decides, and where that is not clear the ending of `name`. Of a GLDF file the
/// variant and of a GDTF file the mode is read that stands after the name (`lamp.gldf#wide`), else the first.
///
/// # Errors
/// What the format's own reader says, or that the bytes are neither.
pub fn read(bytes: &[u8], name: &str) -> Result<Goniogram> {
    read_with(bytes, name, &mut beside::nothing_beside)
}

/// The same, with the files beside it that it names (`TILT=` and a name); [`beside`] reads them from a folder.
///
/// # Errors
/// As [`read`].
pub fn read_with(bytes: &[u8], name: &str, beside: &mut Beside<'_>) -> Result<Goniogram> {
    read_variant(bytes, name, gldf::split_variant(name).1, beside)
}

/// The same, for a variant or a mode that is named apart ([`Gldf::variant`] and [`Gdtf::mode`] say how); without one the first.
///
/// # Errors
/// As [`read`], or a variant of what is neither.
pub fn read_variant(bytes: &[u8], name: &str, asked: Option<&str>, beside: &mut Beside<'_>) -> Result<Goniogram> {
    if !gldf::looks_like(bytes) {
        return match asked {
            None => read_single(bytes, name, beside),
            Some(_) => Err(FormatError::whole("a variant was asked for, but the file is no GLDF or GDTF archive")),
        };
    }
    if gdtf::is_fixture(bytes, gldf::split_variant(name).0) {
        return read_fixture(bytes, asked);
    }
    let product = Gldf::read(bytes)?;
    let chosen = product.variant(asked)?;
    let mut found = product.goniogram(&product.variants[chosen])?;
    if asked.is_none() && product.variants.len() > 1 {
        let name = tame(product.variants[chosen].name.shown());
        let told = format!("the first of {} variants is taken, '{name}'", product.variants.len());
        found.warnings.insert(0, FormatError::whole(told));
    }
    Ok(found)
}

/// Reads a stage fixture: the light of a mode.
fn read_fixture(bytes: &[u8], asked: Option<&str>) -> Result<Goniogram> {
    let fixture = Gdtf::read(bytes)?;
    let chosen = fixture.mode(asked)?;
    let mut found = fixture.goniogram(&fixture.modes[chosen])?;
    found.warnings.extend(fixture.warnings);
    Ok(found)
}

/// Reads a file that is no archive.
pub(crate) fn read_single(bytes: &[u8], name: &str, beside: &mut Beside<'_>) -> Result<Goniogram> {
    let ending = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    if tm33::looks_like(bytes) {
        tm33::read(bytes)
    } else if ies::looks_like(bytes) {
        ies::read_with(bytes, beside)
    } else if ending == "ldt" || ldt::looks_like(bytes) {
        ldt::read(bytes)
    } else if ending == "ies" {
        ies::read_with(bytes, beside)
    } else {
        Err(FormatError::line(1, "neither a TILT= line (IES) nor EULUMDAT's leading numbers nor TM-33's XML were found"))
    }
}
