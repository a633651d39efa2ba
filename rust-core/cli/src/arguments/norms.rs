//! What `gonio emergency`, `gonio sports` and `gonio zones` take.

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

/// The end of `gonio sports --help`.
pub(super) const SPORTS_EXAMPLES: &str = "Examples:
  gonio sports stadium.usda --plan pitch.toml
  gonio sports stadium.usda --plan pitch.toml --json > pitch.json
  gonio verdict required.toml pitch.json -o sheet.html

A plan:
  groups = [\"Floodlights\"]     # or lights = [\"/Stadium/Mast1\"]; all lights without both
  maintenance_factor = 0.8
  reflectance = 0.25            # of the ground, for the glare's background
  [[field]]
  name = \"Pitch\"
  corner = [0, 0, 0]
  along = [105, 0, 0]
  across = [0, 68, 0]           # points by EN 12193, or points = [21, 13]
  glare = true                  # GR at all its points, 1.5 m high
  [[camera]]
  name = \"Main\"
  position = [52, -40, 15]      # or facing = [0, -1, 0]; height = 1.5
  [[observer]]
  name = \"Keeper\"
  position = [0, 34, 1.5]";

/// The end of `gonio zones --help`.
pub(super) const ZONES_EXAMPLES: &str = "Examples:
  gonio zones office.usda --plan rooms.toml
  gonio zones office.usda --plan rooms.toml --json > rooms.json
  gonio verdict required.toml rooms.json -o sheet.html

A plan:
  groups = [\"Ceiling\"]         # or lights = [\"/Office/Lamps\"]; all lights without both
  maintenance_factor = 0.8
  [[room]]
  name = \"Office\"
  floor = [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]]   # or surface = \"Office/Floor\"
  height = 2.8                  # walls and ceiling; eye_height = 1.2 of cylindrical illuminance
  [[task]]
  name = \"Desk\"
  outline = [[2, 1, 0.75], [3.6, 1, 0.75], [3.6, 1.8, 0.75], [2, 1.8, 0.75]]
  surround = 0.5";

#[derive(Args, Debug)]
pub(crate) struct ZonesOptions {
    /// The plan: rooms and task areas, in metres of the stage's world, and which lights shine; a TOML file.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) plan: PathBuf,
    #[command(flatten)]
    pub(crate) norm: NormArguments,
}

#[derive(Args, Debug)]
pub(crate) struct EmergencyOptions {
    /// The plan: escape routes, open areas and places, in metres of the stage's world, and which lights shine; a TOML file.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) plan: PathBuf,
    #[command(flatten)]
    pub(crate) norm: NormArguments,
}

#[derive(Args, Debug)]
pub(crate) struct SportsOptions {
    /// The plan: fields, cameras and observers, in metres of the stage's world, and which lights shine; a TOML file.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) plan: PathBuf,
    #[command(flatten)]
    pub(crate) norm: NormArguments,
}

/// What all take beside their plans.
#[derive(Args, Debug)]
pub(crate) struct NormArguments {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
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
