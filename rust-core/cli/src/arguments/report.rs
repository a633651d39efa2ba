//! What `gonio report` takes.

use super::daylight::DaylightArguments;
use super::eyes::eye_height;
use super::measure::GridArguments;
use super::number::{count, finite};
use super::stage::StageArguments;
use super::texture::TextureArguments;
use super::work::WorkArguments;
use clap::{Args, builder::PossibleValuesParser};
use gonio_page::Language;
use std::path::PathBuf;

/// The end of `gonio report --help`.
pub(super) const REPORT_EXAMPLES: &str = "Examples:
  gonio report office.usda -o office.html
  gonio report office.usda -o office.html --project 'Town hall' --place Vienna
  gonio report office.usda -o office.html --grid /Office/Floor --height 0.75 --margin 0.5 --max-illuminance 1000
  gonio report office.usda -o office.html --grid /Office/Floor --height 0.75 --eyes sitting
  gonio report office.usda -o buero.pdf --language de
  gonio annual office.usda --weather mannheim.epw --grid /Office/Floor -o year && gonio report office.usda -o office.html --annual year
  gonio report office.usda -o schedule.html --no-pictures          luminaires and the stage's own grids alone

What stands in it:
  head            title, project, place, date, and the sun and the sky of --sun
  luminaires      count, flux as lit (dimming included), power by the file, efficacy, file and maker of each type, and totals
  power density   W/m² and W/m² per 100 lx of the room about the largest grid that measures illuminance, its luminaires counted;
                  over the grid itself where there is no closed room
  pictures        what each camera sees, denoised, and its luminance in false colour; the glare of fisheye cameras of 180° or more
  grids, meters   average, least and greatest value, U0 and Ud with standard errors, and pictures with the values at their points
  colour          where lamps have spectra or a grid or meter measures a colour: CCT, Duv, Ra, R9, Rf, Rg, melanopic DER and EDI with
                  standard errors, the spectral irradiance beside TM-30's colour vector graphic, plans of melanopic EDI
  year            of --annual: sDA, ASE, UDI, DA, cDA, daylight factor and EN 17037 with standard errors, on the plan, over days and hours, by point
  files           the polar diagram, the figures and the UGR table of each IES or EULUMDAT file
  notes           what the stage asks for and was not done";

#[derive(Args, Debug)]
pub(crate) struct ReportOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The page to write, or a PDF by Chromium or Chrome where the machine has one; it takes its name when it is complete.
    #[arg(long, short = 'o', value_name = "FILE.html|FILE.pdf")]
    pub(crate) output: PathBuf,
    /// The page's language; what the stage asks for and was not done is told in English.
    #[arg(long, default_value = "en", value_parser = PossibleValuesParser::new(Language::CODES.map(|(code, _)| code)))]
    pub(crate) language: String,
    /// The page's title; without it the stage's file name without its ending.
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
    /// The project that stands at the top.
    #[arg(long, value_name = "TEXT")]
    pub(crate) project: Option<String>,
    /// The place that stands at the top; without it that of --sun.
    #[arg(long, value_name = "TEXT")]
    pub(crate) place: Option<String>,
    /// The date that stands at the top; without it today.
    #[arg(long, value_name = "TEXT")]
    pub(crate) date: Option<String>,
    /// The frame to report on.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    /// Show what this camera sees, by name or path; may be given several times. Without it all cameras of the stage.
    #[arg(long, short = 'c', alias = "cam", value_name = "CAMERA")]
    pub(crate) camera: Vec<String>,
    /// No pictures of cameras.
    #[arg(long = "no-pictures", conflicts_with = "camera")]
    pub(crate) no_pictures: bool,
    /// Leave the pictures' noise in them; glare and figures are those of the noisy picture anyway.
    #[arg(long = "no-denoise")]
    pub(crate) no_denoise: bool,
    /// Width of the pictures in pixels; the height follows the camera's shape.
    #[arg(long = "image-width", short = 'w', alias = "imageWidth", value_name = "WIDTH", default_value_t = 640, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub(crate) image_width: u32,
    /// Samples a pixel of the pictures.
    #[arg(long, short = 'p', alias = "pixel-samples", value_name = "COUNT", default_value_t = 64, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: u32,
    /// Stops by which the pictures are brightened.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f32>)]
    pub(crate) exposure: f32,
    /// Samples a point of grids and meters.
    #[arg(long = "point-spp", value_name = "COUNT", default_value_t = 1024, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) point_spp: u32,
    /// The upper end of the false colours of grids, in their unit; without it a round number for each.
    #[arg(long = "max-illuminance", value_name = "LUX", value_parser = finite::<f32>)]
    pub(crate) max_illuminance: Option<f32>,
    /// The upper end of the pictures' false colours, three decades in even steps of the logarithm; without it a round number for each.
    #[arg(long = "max-luminance", value_name = "CD/M2", value_parser = finite::<f32>)]
    pub(crate) max_luminance: Option<f32>,
    /// Steps of the false colours.
    #[arg(long, value_name = "COUNT", default_value_t = 10, value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) steps: u32,
    /// Power density over the largest grid's area too, all luminaires counted.
    #[arg(long = "grid-density")]
    pub(crate) grid_density: bool,
    /// Limit of the bounces of pictures, grids and meters; without one that of the stage for pictures, and none for the others.
    #[arg(long = "max-bounces", value_name = "COUNT", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) max_bounces: Option<u32>,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Write nothing but errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) grids: GridArguments,
    /// Melanopic light at eyes over the surfaces that --grid names, beside the grids there: sitting (1.2 m above the surface), standing (1.6 m) or so many metres above it.
    #[arg(long, value_name = "sitting|standing|METRES", allow_hyphen_values = true, requires = "grid", value_parser = eye_height)]
    pub(crate) eyes: Option<f64>,
    /// So many level directions around that these eyes look, the first one as the grid faces (+Y, -Z where Y is up); 4 where nothing is said.
    #[arg(long, value_name = "COUNT", requires = "eyes", conflicts_with = "facing", value_parser = count::<u32>(1..=64))]
    pub(crate) directions: Option<u32>,
    /// Where these eyes look, in place of all around; may be given several times.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "eyes")]
    pub(crate) facing: Vec<String>,
    /// Add a year of daylight: the folder that 'gonio annual -o' wrote. May be given several times, such as without and with blinds.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) annual: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) daylight: DaylightArguments,
}
