//! What `gonio view` takes.

use super::number::{count, finite};
use super::{DaylightArguments, ScaleArguments, StageArguments, TextureArguments, WorkArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// The end of `gonio view --help`.
pub(super) const VIEW_EXAMPLES: &str = "\
Examples:
  gonio view office.usda
  gonio view office.usda --camera Desk --show illuminance --max 1000
  gonio view office.usda --screenshot window.png --after 64        (no display needed)

Mouse: left turns, middle moves, right and the wheel go nearer, with and without Alt. F shows everything, Ctrl+S saves the picture;
Help > Keys in the window lists all. docs/view.md says more.";

#[derive(Args, Debug)]
pub(crate) struct ViewOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// Camera to begin with, by name or path; without it the stage's own choice.
    #[arg(long, short = 'c', alias = "cam", value_name = "CAMERA")]
    pub(crate) camera: Option<String>,
    /// Frame to begin with; without it the stage's first.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    /// Width and height of the picture in the window at first; without it the stage's, as far as the screen has room.
    #[arg(long, num_args = 2, value_names = ["WIDTH", "HEIGHT"], value_parser = clap::value_parser!(u32).range(16..=16384))]
    pub(crate) res: Option<Vec<u32>>,
    /// Samples a pixel after which the picture rests.
    #[arg(long, short = 'p', value_name = "COUNT", default_value_t = 1024, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: u32,
    /// What is shown at first: the picture, or luminance (cd/m²) or illuminance (lx) in false colour.
    #[arg(long, value_enum, default_value_t = ShowArgument::Picture)]
    pub(crate) show: ShowArgument,
    #[command(flatten)]
    pub(crate) scale: ScaleArguments,
    /// Stops by which the picture is brightened.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f32>)]
    pub(crate) exposure: f32,
    /// How radiance becomes display values: 'photographic', 'local', 'none', or 'ev100=12'. Without it 'photographic', and 'none' for stages that are lit from the camera.
    #[arg(long, value_name = "OPERATOR")]
    pub(crate) tonemap: Option<String>,
    /// No light at the camera for stages without lights.
    #[arg(long = "disable-camera-light")]
    pub(crate) disable_camera_light: bool,
    /// Write what the window shows to a PNG file, and end; works without a display.
    #[arg(long, value_name = "FILE.png")]
    pub(crate) screenshot: Option<PathBuf>,
    /// Samples a pixel that the screenshot waits for, at most those of --spp.
    #[arg(long, value_name = "COUNT", default_value_t = 16, requires = "screenshot", value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) after: u32,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    #[command(flatten)]
    pub(crate) daylight: DaylightArguments,
}

impl ViewOptions {
    /// The files that are read.
    pub(crate) fn inputs(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        [&mut self.stage.stage].into_iter().chain(&mut self.stage.session_layer).chain(&mut self.daylight.weather)
    }
}

/// What the window shows of a picture.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ShowArgument {
    /// Its colours, tone mapped.
    Picture,
    /// Luminance in false colour.
    Luminance,
    /// Illuminance in false colour.
    Illuminance,
}
