//! What `gonio road` takes.

use clap::Args;
use std::path::PathBuf;

/// The end of `gonio road --help`.
pub(super) const ROAD_EXAMPLES: &str = "Examples:
  gonio road examples/road/street.toml
  gonio road street.toml --json
  gonio road street.toml -o street.html --title 'Mill Road'

docs/roads.md tells what the file holds and what is calculated.";

#[derive(Args, Debug)]
pub(crate) struct RoadOptions {
    /// The road: a TOML file that names luminaires' files relative to itself.
    pub(crate) file: PathBuf,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a sheet with plan, lines of equal illuminance and luminance, and all results.
    #[arg(long, short = 'o', value_name = "FILE.svg|FILE.png|FILE.html|FILE.pdf")]
    pub(crate) output: Option<PathBuf>,
    /// The sheet's title; without it the road's file name without its ending.
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
}
