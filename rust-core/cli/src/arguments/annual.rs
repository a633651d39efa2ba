//! What `gonio annual` and `gonio annual-metrics` take.

use super::checkpoint::RoundArguments;
use super::farm::YearFarmArguments;
use super::measure::GridArguments;
use super::number::{count, finite, mebibytes};
use super::stage::StageArguments;
use super::texture::TextureArguments;
use super::work::WorkArguments;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// The end of `gonio annual --help`.
pub(super) const ANNUAL_EXAMPLES: &str = "Examples:
  gonio annual office.usda --weather mannheim.epw --grid /Office/Floor --height 0.8 --margin 0.5
  gonio annual office.usda --weather mannheim.epw --grid /Office/Floor --height 0.8 --blinds 0.05 -o out
  gonio annual office.usda --weather mannheim.epw --grid /Office/Floor --closed-variant '/Office{blinds=closed}' --json
  gonio annual office.usda --weather oslo.epw --grid /Office/Floor --group south=/Office/South --group west=/Office/West --blinds 0.05
  gonio annual office.usda --weather oslo.epw --grid /Office/Floor --schedule 7-19 --metrics sda,ase
  gonio annual office.usda --weather oslo.epw --grid /Office/Floor --checkpoint office.rounds --resume
  gonio annual office.usda --weather oslo.epw --grid /Office/Floor -p 65536 --dask tcp://farm:8786
  gonio annual office.usda --weather oslo.epw --grid /Office/Floor --lighting-power 7 --lighting-target 500

The stage's lamps are dark and its sky and sun give way to the weather's. docs/annual.md takes you from a weather file to sDA in five minutes.";

/// The end of `gonio annual-glare --help`.
pub(super) const ANNUAL_GLARE_EXAMPLES: &str = "Examples:
  gonio annual-glare office.usda --weather mannheim.epw --eye 1.8,1.5,1.2 --facing 0,-1,0
  gonio annual-glare office.usda --weather mannheim.epw --eye 1.8,1.5,1.2 --directions 8 --json
  gonio annual-glare office.usda --weather mannheim.epw --grid /Office/Floor --spacing 1 --margin 0.5 --directions 4 -o out
  gonio annual-glare office.usda --weather mannheim.epw --eye 1.8,1.5,1.2 --surfaces --closed-variant '/Office{blinds=closed}' --blinds-floor /Office/Floor

Sources of glare are the sun and patches of the sky above 2000 cd/m², seen straight or through thin panes; what light scatters from counts at the eye alone,
unless --surfaces are asked for.
Blinds that direct sun closes: --closed-variant; others are as the stage has them: --variant chooses.";

/// The end of `gonio annual-metrics --help`.
pub(super) const ANNUAL_METRICS_EXAMPLES: &str = "Examples:
  gonio annual-metrics --weather mannheim.epw --coefficients office.mtx
  gonio annual-metrics --weather mannheim.epw --coefficients office.mtx --sun-coefficients suns.mtx --json
  gonio annual-metrics --weather mannheim.wea --coefficients office.npy --schedule 9-17 -o out
  gonio annual-metrics --weather mannheim.epw --groups --coefficients south.mtx west.mtx --sun-coefficients south_sun.mtx west_sun.mtx --blinds 0.02

A matrix has a row for each point and a column for each patch of the sky, the ground first, as rfluxmtx and rcontrib write it, or is a NumPy array.
docs/annual.md tells how such matrices are made and what is calculated of them.";

/// The year, and what of it counts.
#[derive(Args, Clone, Debug)]
pub(crate) struct YearArguments {
    /// The year: an EPW or WEA file with every hour of it.
    #[arg(long, value_name = "FILE.epw|FILE.wea")]
    pub(crate) weather: PathBuf,
    /// Hours of use of every day, on the weather file's clock, or a file of a 0 or 1 for each hour of the year.
    #[arg(long, value_name = "FROM-TO|FILE", default_value = "8-18")]
    pub(crate) schedule: String,
    /// How luminance is spread over the sky: perez (by the weather), or cie1 to cie16 with the weather's light.
    #[arg(long, value_name = "MODEL", default_value = "perez")]
    pub(crate) sky: String,
    /// Where the sun stands: at its true place, by each record's own year, or where Radiance's formulas have it, up to 1° off, to compare with that.
    /// annual-metrics takes 'radiance' for coefficients of suns, whose columns are those of 'gendaymtx -D'.
    #[arg(long, value_enum)]
    pub(crate) sun_position: Option<SunPositionArgument>,
    /// Albedo of the ground, 0 to 1.
    #[arg(long, value_name = "ALBEDO", default_value_t = 0.2, value_parser = finite::<f64>)]
    pub(crate) ground: f64,
    /// Where true north lies: degrees clockwise of +Y (of -Z where Y is up), seen from above.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) north: f64,
    /// Dew point of the whole year in °C; without it the weather file's, 11 in WEA files, which have none.
    #[arg(long, value_name = "CELSIUS", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) dew_point: Option<f64>,
    /// Memory of the hours that are calculated together, beside the matrices: 256M, 1G, or MiB.
    #[arg(long, value_name = "SIZE", default_value = "256M", value_parser = mebibytes)]
    pub(crate) memory: u64,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Write to a folder: each grid's series, points × hours in lx as .npy, all light and direct, a CSV table of the points, plots as SVG, and year.json with what --json prints, which 'gonio report --annual' reads.
    #[arg(long, short = 'o', value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

/// Whose formulas tell where the sun stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SunPositionArgument {
    /// At its true place, refraction included, in the middle of the part of each hour in which it is up.
    True,
    /// Where 'gendaymtx' has it, in the middle of each hour.
    Radiance,
}

/// The lamps of the room, whose energy beside daylight is asked for.
#[derive(Args, Clone, Debug)]
pub(crate) struct LightingArguments {
    /// Installed power of the electric light over the area, W/m²: tells its energy over the year beside daylight (LENI), by these options.
    #[arg(long, value_name = "W/M2", value_parser = finite::<f64>)]
    pub(crate) lighting_power: Option<f64>,
    /// What the lamps give at full power, and what is wanted.
    #[arg(long, value_name = "LX", default_value_t = 500.0, requires = "lighting_power", value_parser = finite::<f64>)]
    pub(crate) lighting_target: f64,
    /// How they follow daylight.
    #[arg(long, value_enum, default_value_t = ControlArgument::Dimming, requires = "lighting_power")]
    pub(crate) lighting_control: ControlArgument,
    /// Share of their power that dimmed lamps take at least, 0 to 1.
    #[arg(long, value_name = "SHARE", default_value_t = 0.1, requires = "lighting_power", value_parser = finite::<f64>)]
    pub(crate) lighting_least: f64,
    /// Which daylight the control sees.
    #[arg(long, value_enum, default_value_t = SensorArgument::Mean, requires = "lighting_power")]
    pub(crate) lighting_sensor: SensorArgument,
    /// Share of the used hours in which somebody is there and light is wanted, 0 to 1.
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, requires = "lighting_power", value_parser = finite::<f64>)]
    pub(crate) lighting_presence: f64,
    /// What controls and emergency lamps take besides, kWh/m² in a year.
    #[arg(long, value_name = "KWH/M2", default_value_t = 0.0, requires = "lighting_power", value_parser = finite::<f64>)]
    pub(crate) lighting_standby: f64,
}

/// How lamps follow daylight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ControlArgument {
    /// They give what daylight lacks.
    Dimming,
    /// They are off where daylight alone is enough.
    Switching,
}

/// Which daylight the control of lamps sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SensorArgument {
    /// That of the darkest point: what is wanted is there everywhere.
    Least,
    /// The mean of all points.
    Mean,
    /// Each point's own, by lamps of its own.
    Points,
}

/// A figure that is written out in lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MetricArgument {
    /// Spatial daylight autonomy, 300 lx in half of the used hours (LM-83).
    Sda,
    /// Annual sunlight exposure, 1000 lx of direct sun in more than 250 used hours (LM-83).
    Ase,
    /// Mean illuminance of the used hours.
    Mean,
    /// Useful daylight illuminance.
    Udi,
    /// Median daylight factor.
    DaylightFactor,
    /// Daylight provision by both methods of EN 17037.
    En17037,
}

/// Windows with blinds, or with glass that is switched.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Blinds")]
pub(crate) struct FacadeArguments {
    /// Windows whose blinds are operated together: a name and the prim through which their light comes, with all below it. May be given several times; the
    /// same name twice has both prims. One trace tells the light of all groups apart, by the first that it goes through, seen from the point.
    #[arg(long, value_name = "NAME=PRIM")]
    pub(crate) group: Vec<String>,
    /// Share of light that closed blinds let through, of all groups or of one. They close while more than 2 % of a grid's points have 1000 lx of direct sun
    /// (LM-83-12); of several groups those that leave most light.
    #[arg(long, value_name = "SHARE|NAME=SHARE")]
    pub(crate) blinds: Vec<String>,
    /// The stage's variant with closed blinds, '/Prim{set=variant}', of all groups or of one, 'NAME=/Prim{set=variant}': traced too, as many times as groups
    /// have other ones. May be given several times.
    #[arg(long, value_name = "SELECTION|NAME=SELECTION")]
    pub(crate) closed_variant: Vec<String>,
    /// When blinds are closed, in place of direct sun closing them: hours of every day, or a file of a 0 or 1 for each hour of the year; of all groups or of one.
    #[arg(long, value_name = "FROM-TO|FILE|NAME=…")]
    pub(crate) closed_hours: Vec<String>,
}

#[derive(Args, Debug)]
pub(crate) struct AnnualOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    #[command(flatten)]
    pub(crate) year: YearArguments,
    #[command(flatten)]
    pub(crate) grids: GridArguments,
    #[command(flatten)]
    pub(crate) lighting: LightingArguments,
    /// The figures that lines tell, separated by commas; --json and -o have all of them.
    #[arg(long, value_enum, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) metrics: Vec<MetricArgument>,
    #[command(flatten)]
    pub(crate) facades: FacadeArguments,
    /// Reinhart's division of the sky, 1 (Tregenza's 145 patches) to 6. The sun's direct light comes from its place at any.
    #[arg(long, short = 'm', value_name = "FACTOR", default_value_t = 2, value_parser = count::<u32>(1..=6))]
    pub(crate) factor: u32,
    /// Paths a point.
    #[arg(long, short = 'p', value_name = "COUNT", default_value_t = 8192, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: u32,
    /// Limit of the bounces; without one all count that matter.
    #[arg(long = "max-bounces", value_name = "COUNT", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) max_bounces: Option<u32>,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    #[command(flatten)]
    pub(crate) rounds: RoundArguments,
    #[command(flatten)]
    pub(crate) farm: YearFarmArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}

#[derive(Args, Debug)]
pub(crate) struct AnnualGlareOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    #[command(flatten)]
    pub(crate) year: YearArguments,
    #[command(flatten)]
    pub(crate) grids: GridArguments,
    /// An eye at this point of the world, in metres; may be given several times. Grids have eyes at their points, 1.2 m above the surface unless --height says.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) eye: Vec<String>,
    /// Where all eyes look; may be given several times. Without it they look around.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) facing: Vec<String>,
    #[command(flatten)]
    pub(crate) facades: FacadeArguments,
    /// The floor on which direct sun closes blinds, by points 0.76 m above it, 0.5 m apart, 0.3 m from its edges (LM-83); may be given several times. Without it
    /// that of --grid, else the stage's own grids.
    #[arg(long, value_name = "PRIMPATH", help_heading = "Blinds")]
    pub(crate) blinds_floor: Vec<String>,
    /// Bright surfaces, such as sunlit walls and blinds, are sources of glare too: luminances of 577 directions before each eye are traced besides. It takes some 20
    /// times as long, and 45 MB an eye for each state of the blinds.
    #[arg(long)]
    pub(crate) surfaces: bool,
    /// So many level directions around, the first one +Y (-Z where Y is up); 4 where nothing is said.
    #[arg(long, value_name = "COUNT", conflicts_with = "facing", value_parser = count::<u32>(1..=64))]
    pub(crate) directions: Option<u32>,
    /// Reinhart's division of the sky, 1 (Tregenza's 145 patches) to 6. The sun stands at its place at any.
    #[arg(long, short = 'm', value_name = "FACTOR", default_value_t = 4, value_parser = count::<u32>(1..=6))]
    pub(crate) factor: u32,
    /// Paths an eye.
    #[arg(long, short = 'p', value_name = "COUNT", default_value_t = 8192, value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: u32,
    /// Limit of the bounces; without one all count that matter.
    #[arg(long = "max-bounces", value_name = "COUNT", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) max_bounces: Option<u32>,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}

#[derive(Args, Debug)]
pub(crate) struct AnnualMetricsOptions {
    #[command(flatten)]
    pub(crate) year: YearArguments,
    #[command(flatten)]
    pub(crate) lighting: LightingArguments,
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
    /// Worker threads; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 0, value_parser = count::<u32>(0..=1024))]
    pub(crate) threads: u32,
}
