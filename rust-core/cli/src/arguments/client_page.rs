//! What `gonio share` takes.

use super::number::{count, finite, positive};
use clap::{Args, builder::PossibleValuesParser};
use gonio_page::Language;
use std::path::PathBuf;

/// The end of `gonio share --help`.
pub(super) const SHARE_EXAMPLES: &str = "Examples:
  gonio render hall.usda -o hall.exr --light-groups --spp 256
  gonio share hall.exr -o hall.html
  gonio share hall.exr -o hall.html --title 'Town hall' --watts Ceiling=72 --watts Pendant=18 \\
      --scene 'Lecture:Ceiling=20%,Pendant=0.6' --scene 'Evening:Ceiling=0,Pendant=40%@2200'
  gonio share hall.usda -o hall.html --spp 256        renders hall.exr beside the page first

What can be done on the page:
  groups       dim each from 0 to 150 %, switch it, tint it by a colour temperature as gonio relight does
  scenes       choose settings that --scene named
  view         exposure, an eye that adapts, luminance in false colour, cd/m² under the cursor, before and now side by side
  energy       W and kWh a year by --watts, hours a year

docs/share.md tells how the light is kept and how exact it is.";

#[derive(Args, Debug)]
pub(crate) struct ShareOptions {
    /// An EXR file that was rendered with --light-groups, or a USD stage, which is rendered to an EXR file beside the page first.
    #[arg(value_name = "STAGE_OR_EXR")]
    pub(crate) picture: PathBuf,
    /// The page to write; it takes its name when it is complete.
    #[arg(long, short = 'o', value_name = "FILE.html")]
    pub(crate) output: PathBuf,
    /// The page's title; without it the picture's file name without its ending.
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
    /// Settings to choose on the page, factors or per cent, with colour temperatures in K that tint; groups that are not named stay at 100 %. May be given several times.
    #[arg(long, value_name = "NAME:GROUP=VALUE[@KELVIN],...")]
    pub(crate) scene: Vec<String>,
    /// Power of a group at 100 %, W; may be given several times.
    #[arg(long, value_name = "GROUP=W")]
    pub(crate) watts: Vec<String>,
    /// Hours a year that the light burns, unless the page's reader says others.
    #[arg(long, value_name = "HOURS", default_value_t = 2500.0, value_parser = positive::<f64>)]
    pub(crate) hours: f64,
    /// Stops by which the picture is brightened, unless the page's reader says others.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f32>)]
    pub(crate) exposure: f32,
    /// The page's language.
    #[arg(long, default_value = "en", value_parser = PossibleValuesParser::new(Language::CODES.map(|(code, _)| code)))]
    pub(crate) language: String,
    /// Size that the page must not exceed, millions of bytes: light is kept in coarser steps and then with fewer pixels, which is told.
    #[arg(long = "max-size", value_name = "MB", default_value_t = 15.0, value_parser = positive::<f64>)]
    pub(crate) max_size: f64,
    /// The camera of a stage, by name or path.
    #[arg(long, short = 'c', alias = "cam", value_name = "CAMERA")]
    pub(crate) camera: Option<String>,
    /// Width of a stage's picture in pixels; without it what the stage says.
    #[arg(long = "image-width", short = 'w', alias = "imageWidth", value_name = "WIDTH", value_parser = count::<u32>(16..=16384))]
    pub(crate) image_width: Option<u32>,
    /// Samples a pixel of a stage's picture; without it what the stage says.
    #[arg(long, short = 'p', alias = "pixel-samples", value_name = "COUNT", value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: Option<u32>,
}
