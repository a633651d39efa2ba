//! What `gonio sunlight` takes.

use super::measure::GridArguments;
use super::number::finite;
use super::stage::StageArguments;
use super::texture::TextureArguments;
use super::work::WorkArguments;
use clap::Args;
use std::path::PathBuf;

/// The end of `gonio sunlight --help`.
pub(super) const SUNLIGHT_EXAMPLES: &str = "Examples:
  gonio sunlight flat.usda --sun 48.21,16.37,2026-03-21T12:00+01:00 --at 2.0,0.1,1.4 --normal 0,-1,0 --least-elevation 13
  gonio sunlight court.usda --sun 59.91,10.75,2026-04-30T12:00+02:00 --grid /Court/Lawn -o lawn.png
  gonio sunlight flat.usda --sun 48.21,16.37,2026-02-01T12:00+01:00 --at 2,0.1,1.4 --normal 0,-1,0 --json";

#[derive(Args, Debug)]
pub(crate) struct SunlightOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    #[command(flatten)]
    pub(crate) grids: GridArguments,
    /// Ask at this point of the world, in metres, and nothing that the stage asks for besides; may be given several times. EN 17037 has it in the middle of a window on its inner face, 1.2 m above the floor and 0.3 m above the sill at least.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) at: Vec<String>,
    /// Where these points look: sun from behind does not count. Of a window it is outwards; without it up.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "at")]
    pub(crate) normal: Option<String>,
    /// The place and the day: degrees north, degrees east, ISO 8601 with the offset from UTC, as in 48.21,16.37,2026-03-21T12:00+01:00; the time of day does not matter.
    #[arg(long, value_name = "LAT,LON,TIME", allow_hyphen_values = true)]
    pub(crate) sun: String,
    /// Where true north lies: degrees clockwise of +Y (of -Z where Y is up), seen from above.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) north: f64,
    /// Metres above the sea.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) elevation: f64,
    /// Degrees above the horizon from which on the sun counts, as the norm has it for the place; 0 is the horizon itself.
    #[arg(long = "least-elevation", value_name = "DEGREES", default_value_t = 0.0, value_parser = finite::<f64>)]
    pub(crate) least_elevation: f64,
    /// Minutes from one place of the sun to the next.
    #[arg(long, value_name = "MINUTES", default_value_t = 1.0, value_parser = finite::<f64>)]
    pub(crate) step: f64,
    /// Draw the grid in false colour with its hours; with several grids the prim's name is put before the ending.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(crate) output: Option<PathBuf>,
    /// For machines: hours, spans and the sun's way.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}
