//! What `gonio bsdf` takes.

use clap::Args;
use std::path::PathBuf;

/// The end of `gonio bsdf --help`.
pub(super) const BSDF_EXAMPLES: &str = "Examples:
  gonio bsdf gold.binary                        what the file holds, and what is wrong with it
  gonio bsdf gold.binary --lobes gold.svg       lobes in the plane of incidence
  gonio bsdf blind.xml -o blind.gbsdf --text    as a table to read and edit
  gonio bsdf gold.binary --fit --material gold.usda
                                                the measurement, and the nearest OpenPBR surface for renderers that take none";

#[derive(Args, Debug)]
pub(crate) struct BsdfOptions {
    /// The measured material.
    pub(crate) file: PathBuf,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the lobes of light at 0°, 30°, 60° and 75° in the plane of incidence, four decades of 1/sr.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) lobes: Option<PathBuf>,
    /// Draw the same lobes over whole hemispheres, as colours.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) map: Option<PathBuf>,
    /// Write it as .gbsdf: tables as they are, everything else evaluated on a grid of angles; how far that is from the file is told.
    #[arg(long, short = 'o', value_name = "FILE.gbsdf")]
    pub(crate) output: Option<PathBuf>,
    /// The grid to write: polar angles from 0° to 90°, and azimuths of a turn; for tables, too, if given.
    #[arg(long, num_args = 2, value_names = ["THETA", "PHI"], value_parser = clap::value_parser!(u32).range(2..=720), requires = "output")]
    pub(crate) grid: Option<Vec<u32>>,
    /// Write numbers as text instead of binary.
    #[arg(long, requires = "output")]
    pub(crate) text: bool,
    /// Fit an OpenPBR surface to the front's reflection: colour, metalness, roughness, anisotropy, index, and the residual.
    #[arg(long)]
    pub(crate) fit: bool,
    /// Write a USD material: the measurement itself for gonio, by a path to this file, and the fitted surface for all other renderers.
    #[arg(long, value_name = "FILE.usda")]
    pub(crate) material: Option<PathBuf>,
}
