//! What `gonio annual-metrics` takes.

use super::number::{count, finite, mebibytes};
use clap::Args;
use std::path::PathBuf;

/// The end of `gonio annual-metrics --help`.
pub(super) const ANNUAL_EXAMPLES: &str = "Examples:
  gonio annual-metrics --weather mannheim.epw --coefficients office.mtx
  gonio annual-metrics --weather mannheim.epw --coefficients office.mtx --sun-coefficients suns.mtx --json
  gonio annual-metrics --weather mannheim.wea --coefficients office.npy --schedule 9-17 -o out
  gonio annual-metrics --weather mannheim.epw --groups --coefficients south.mtx west.mtx --sun-coefficients south_sun.mtx west_sun.mtx --blinds 0.02

A matrix has a row for each point and a column for each patch of the sky, the ground first, as rfluxmtx and rcontrib write it, or is a NumPy array.
docs/annual.md tells how such matrices are made and what is calculated of them.";

#[derive(Args, Debug)]
pub(crate) struct AnnualOptions {
    /// The year: an EPW or WEA file with every hour of it.
    #[arg(long, value_name = "FILE.epw|FILE.wea")]
    pub(crate) weather: PathBuf,
    /// Daylight coefficients, points × patches, a file for each grid: a Radiance matrix (text, float, double) or .npy; blocks × points × patches give standard errors.
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    pub(crate) coefficients: Vec<PathBuf>,
    /// Coefficients of direct light alone, in the same order: points × patches, or points × suns as 'gendaymtx -D' writes them. ASE and blinds need them.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub(crate) sun_coefficients: Vec<PathBuf>,
    /// Coefficients of the suns with all their bounces, in the same order: points × suns. With them the sun stands at its place, not in patches.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub(crate) sun_total: Vec<PathBuf>,
    /// The files are groups of windows with blinds of their own, and their light adds up to one grid.
    #[arg(long)]
    pub(crate) groups: bool,
    /// Share of light that closed blinds let through; they close while more than 2 % of the points have 1000 lx of direct sun (LM-83-12).
    #[arg(long, value_name = "SHARE", requires = "sun_coefficients", conflicts_with = "closed", value_parser = finite::<f64>)]
    pub(crate) blinds: Option<f64>,
    /// Coefficients with closed blinds, in the same order: points × patches.
    #[arg(long, value_name = "FILE", num_args = 1.., requires = "sun_coefficients")]
    pub(crate) closed: Vec<PathBuf>,
    /// Reinhart's division that the coefficients are to have, 1 (Tregenza's 145 patches) to 6; without it their columns tell.
    #[arg(long, short = 'm', value_name = "FACTOR", value_parser = count::<u32>(1..=6))]
    pub(crate) factor: Option<u32>,
    /// Hours of use of every day, on the weather file's clock, or a file of a 0 or 1 for each hour of the year.
    #[arg(long, value_name = "FROM-TO|FILE", default_value = "8-18")]
    pub(crate) schedule: String,
    /// How luminance is spread over the sky: perez (by the weather), or cie1 to cie16 with the weather's light.
    #[arg(long, value_name = "MODEL", default_value = "perez")]
    pub(crate) sky: String,
    /// Albedo of the ground, 0 to 1.
    #[arg(long, value_name = "ALBEDO", default_value_t = 0.2, value_parser = finite::<f64>)]
    pub(crate) ground: f64,
    /// Where true north lies: degrees clockwise of +Y, seen from above.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) north: f64,
    /// Dew point of the whole year in °C; without it the weather file's, 11 in WEA files, which have none.
    #[arg(long, value_name = "CELSIUS", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) dew_point: Option<f64>,
    /// Memory of the hours that are calculated together, beside the matrices: 256M, 1G, or MiB.
    #[arg(long, value_name = "SIZE", default_value = "256M", value_parser = mebibytes)]
    pub(crate) memory: u64,
    /// Worker threads; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 0, value_parser = count::<u32>(0..=1024))]
    pub(crate) threads: u32,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Write each grid's series to a folder: points × hours in lx as .npy, all light and direct, and a CSV table of the points.
    #[arg(long, short = 'o', value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}
