//! What `gonio photometry` takes.

use super::number::finite;
use clap::{Args, ValueEnum};
use gonio_formats::photometry::CATALOGUE_SPACING;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct PhotometryOptions {
    /// The luminaire: an IES LM-63, EULUMDAT, TM-33, GLDF or GDTF file. Of a GLDF file without a variant the variants are listed, of a GDTF file the modes.
    pub(crate) file: PathBuf,
    /// The variant of a GLDF file: its name in any language, order number, GTIN or identifier, or its number from 1. FILE.gldf#NAME is the same. Of a GDTF file the mode: its name or number.
    #[arg(long, value_name = "NAME|NUMBER")]
    pub(crate) variant: Option<String>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Print the UGR table (CIE 190) in the place of the figures: 19 rooms, 5 sets of reflectances, crosswise and endwise.
    #[arg(long = "ugr-table")]
    pub(crate) ugr_table: bool,
    /// Distance of the UGR table's luminaires over their height above the eye; catalogues have 0.25.
    #[arg(long, value_name = "RATIO", default_value_t = CATALOGUE_SPACING, requires = "ugr_table", value_parser = finite::<f64>)]
    pub(crate) shr: f64,
    /// The C plane that faces the street, for the BUG rating; without it C90 of EULUMDAT files and C0 of others.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) front: Option<f64>,
    /// Draw the polar diagram, in cd/klm.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) polar: Option<PathBuf>,
    /// Draw the cone diagram: illuminance and the beam's diameter at 1 to 5 m.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) cone: Option<PathBuf>,
    /// Write the luminaire as LM-63-2002, EULUMDAT or TM-33, which alone has its spectrum.
    #[arg(long, value_name = "FILE.ies|FILE.ldt|FILE.xml")]
    pub(crate) convert: Option<PathBuf>,
    /// Take the file's alternative lamps of this number, from 1.
    #[arg(long = "lamp-set", value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) lamp_set: Option<u32>,
    /// Take the lamp's factor at this tilt of the luminaire, in files with tilt factors.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) tilt: f64,
    /// Turn the luminaire about its vertical axis, from C0 towards C90.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) rotate: Option<f64>,
    /// Give it a symmetry, after it was turned: intensities that become equal are averaged.
    #[arg(long, value_enum)]
    pub(crate) symmetry: Option<SymmetryName>,
}

/// The symmetries of EULUMDAT.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SymmetryName {
    /// All planes on their own
    None,
    /// The same all around
    Rotational,
    /// About the plane C0–C180
    C0,
    /// About the plane C90–C270
    C90,
    /// About both
    Quadrants,
}
