//! What `gonio measure` takes; it shares most with `gonio dim`, and grids with `gonio report`.

use super::daylight::DaylightArguments;
use super::eyes::EyeArguments;
use super::falsecolor::ScaleArguments;
use super::integrator::IntegratorArgument;
use super::number::{count, finite};
use super::stage::StageArguments;
use super::texture::TextureArguments;
use super::work::WorkArguments;
use clap::{ArgGroup, Args};
use std::path::PathBuf;

/// The end of `gonio measure --help`.
pub(super) const MEASURE_EXAMPLES: &str = "Examples:
  gonio measure office.usda --grid /Office/Floor --height 0.75 --margin 0.5 -o plane.png --csv plane.csv
  gonio measure office.usda --at 2,3,1.2 --quantity cylindrical
  gonio measure office.usda --at 2,3,1.2 --quantity ugr --facing 1,0,0
  gonio measure office.usda --at 2,3,0.75 --quantity ra --json
  gonio measure office.usda --grid /Office/Floor --eyes sitting --quantity melanopic-edi --target 250
  gonio measure office.usda --grid /Office/Floor --quantity daylight-factor --sun 48.21,16.37,2025-03-21T12:00+01:00 --sky overcast";

/// Calculation grids beside the stage's own.
#[derive(Args, Clone, Debug)]
pub(crate) struct GridArguments {
    /// Lay a grid over this prim's surface; may be given several times.
    #[arg(long, value_name = "PRIMPATH")]
    pub(crate) grid: Vec<String>,
    /// Metres from point to point of these grids; without it as the prim says, else as EN 12464-1 has it.
    #[arg(long, value_name = "METRES", requires = "grid", value_parser = finite::<f64>)]
    pub(crate) spacing: Option<f64>,
    /// Metres along the edges that these grids leave out; without it as the prim says, else 0.
    #[arg(long, value_name = "METRES", requires = "grid", value_parser = finite::<f64>)]
    pub(crate) margin: Option<f64>,
    /// Metres from the surface to these grids; without it as the prim says, else 0.
    #[arg(long, value_name = "METRES", allow_hyphen_values = true, requires = "grid", value_parser = finite::<f64>)]
    pub(crate) height: Option<f64>,
}

/// What is measured, where and how: what `gonio measure` and `gonio dim` share.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("looking").args(["at", "eyes"]).multiple(true))]
pub(crate) struct MeasuringArguments {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The frame to measure.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    #[command(flatten)]
    pub(crate) grids: GridArguments,
    #[command(flatten)]
    pub(crate) eyes: EyeArguments,
    /// Measure at this point of the world, in metres, and nothing that the stage asks for besides; may be given several times.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) at: Vec<String>,
    /// The normal of the plane that these points measure, or the axis of their cylinders; without it up.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "at")]
    pub(crate) normal: Option<String>,
    /// Where half cylinders, luminance meters and eyes at these points face; without it +Y where Z is up, -Z where Y is up. Where the eyes of --eyes look; several times for several directions.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "looking")]
    pub(crate) facing: Vec<String>,
    /// What these grids and points measure: illuminance, cylindrical, semicylindrical (lx), daylight-factor (%), luminance (cd/m²), melanopic-edi (lx at an eye that looks along --facing; lamps want spectra), cct (K), duv, ra, rf, rg (colour of the light on the plane; the last three want lamps' spectra), ugr (the luminaires' glare at an eye there); without it as the grid's prim says, else illuminance.
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) quantity: Option<String>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Samples a point.
    #[arg(long, short = 'p', value_name = "COUNT", default_value_t = 4096, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: u32,
    /// Limit of the bounces; without one all count that matter.
    #[arg(long = "max-bounces", value_name = "COUNT", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) max_bounces: Option<u32>,
    /// The light transport: full global illumination, direct light alone, or direct light without noise, for which --spp 1 is enough.
    #[arg(long, value_enum, default_value_t = IntegratorArgument::Path)]
    pub(crate) integrator: IntegratorArgument,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) daylight: DaylightArguments,
}

#[derive(Args, Debug)]
pub(crate) struct MeasureOptions {
    #[command(flatten)]
    pub(crate) measuring: MeasuringArguments,
    /// Draw the grid in false colour with its values; with several grids the prim's name is put before the ending.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(crate) output: Option<PathBuf>,
    /// Write every point with its value and standard error.
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) csv: Option<PathBuf>,
    /// Tell which shares of the grids' points, and of their eyes, reach this value in the quantity's unit, and which the errors leave open.
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) target: Option<f64>,
    #[command(flatten)]
    pub(crate) scale: ScaleArguments,
}
