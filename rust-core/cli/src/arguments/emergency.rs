//! What `gonio emergency` takes.

use super::number::count;
use super::stage::StageArguments;
use super::texture::TextureArguments;
use super::work::WorkArguments;
use clap::Args;
use std::path::PathBuf;

/// The end of `gonio emergency --help`.
pub(super) const EMERGENCY_EXAMPLES: &str = "Examples:
  gonio emergency floor.usda --plan escape.toml
  gonio emergency floor.usda --plan escape.toml --json > escape.json
  gonio verdict required.toml escape.json -o sheet.html

A plan:
  groups = [\"Emergency\"]       # or lights = [\"/Floor/Exit1\"]; all lights without both
  flux = 0.9                    # least flux over the rated time
  maintenance_factor = 0.8
  [[route]]
  name = \"Corridor\"
  line = [[0, 1, 0], [12, 1, 0], [12, 6, 0]]
  width = 2
  [[area]]
  name = \"Hall\"
  outline = [[0, 8, 0], [20, 8, 0], [20, 20, 0], [0, 20, 0]]
  [[place]]
  name = \"First aid\"
  position = [3, 0.05, 1.5]
  facing = [0, 1, 0]";

#[derive(Args, Debug)]
pub(crate) struct EmergencyOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The plan: escape routes, open areas and places, in metres of the stage's world, and which lights shine; a TOML file.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) plan: PathBuf,
    /// For machines, and for 'gonio verdict'.
    #[arg(long)]
    pub(crate) json: bool,
    /// Samples a point.
    #[arg(long, short = 'p', value_name = "COUNT", default_value_t = 1024, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: u32,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}
