//! What `gonio view-out` takes.

use super::measure::GridArguments;
use super::number::finite;
use super::stage::StageArguments;
use super::texture::TextureArguments;
use super::work::WorkArguments;
use clap::Args;
use std::path::PathBuf;

/// The end of `gonio view-out --help`.
pub(super) const VIEW_OUT_EXAMPLES: &str = "Examples:
  gonio view-out office.usda --grid /Office/Floor --spacing 0.5 --margin 0.5
  gonio view-out office.usda --grid /Office/Floor --ground /Site/Lawn --openings /Office/Window --json
  gonio view-out office.usda --at 2,3,1.2 --horizon 3
  gonio view-out model.ifc --raise 0.45 -o out

A ray is a view where it leaves by a pane behind which the sky is seen past everything else, or by an open hole. docs/view-out.md has the rules.";

#[derive(Args, Debug)]
pub(crate) struct ViewOutOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    #[command(flatten)]
    pub(crate) grids: GridArguments,
    /// An eye at this point of the world, in metres, and nothing that the stage asks for besides; may be given several times. Eyes over the grids of --grid are 1.2 m above them, where --height says nothing else.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) at: Vec<String>,
    /// Metres by which eyes are above the stage's own grids and sensors: 0.45 over work planes 0.75 m above the floor.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) raise: f64,
    /// This prim and all below it are ground; may be given several times. Without it what is met below the horizon and slopes by less than 30° is.
    #[arg(long, value_name = "PRIMPATH")]
    pub(crate) ground: Vec<String>,
    /// A view leads out through this prim and those below it alone; may be given several times. It has to let see through.
    #[arg(long, value_name = "PRIMPATH")]
    pub(crate) openings: Vec<String>,
    /// Degrees above and below the horizon that are looked at.
    #[arg(long, value_name = "DEGREES", default_value_t = 60.0, value_parser = finite::<f64>)]
    pub(crate) field: f64,
    /// Degrees from ray to ray.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.5, value_parser = finite::<f64>)]
    pub(crate) step: f64,
    /// Metres behind an opening within which things are the building's own, as reveals, fins and balconies, and no view.
    #[arg(long, value_name = "METRES", default_value_t = 1.0, value_parser = finite::<f64>)]
    pub(crate) nearest: f64,
    /// Degrees above and below the horizon within which rays that meet nothing see landscape. Without it landscape is what is modelled.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, value_parser = finite::<f64>)]
    pub(crate) horizon: f64,
    /// Write a CSV table of the points to a folder, and of grids plans of sight angle, outside distance and level.
    #[arg(long, short = 'o', value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// For machines: sight angle, distances, layers and levels of every point, and of grids together.
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
