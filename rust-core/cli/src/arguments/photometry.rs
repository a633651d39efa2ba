//! What `gonio photometry` takes.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct PhotometryOptions {
    /// The luminaire: an IES LM-63 or EULUMDAT file.
    pub(crate) file: PathBuf,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the polar diagram, in cd/klm.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) polar: Option<PathBuf>,
    /// Draw the cone diagram: illuminance and the beam's diameter at 1 to 5 m.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) cone: Option<PathBuf>,
    /// Write the luminaire as LM-63-2002 or EULUMDAT.
    #[arg(long, value_name = "FILE.ies|FILE.ldt")]
    pub(crate) convert: Option<PathBuf>,
    /// Take the file's alternative lamps of this number, from 1.
    #[arg(long = "lamp-set", value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) lamp_set: Option<u32>,
    /// Take the lamp's factor at this tilt of the luminaire, in files with tilt factors.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) tilt: f64,
    /// Turn the luminaire about its vertical axis, from C0 towards C90.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
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
