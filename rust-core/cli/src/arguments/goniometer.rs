//! What `gonio goniometer` takes.

use super::number::{count, finite};
use super::{StageArguments, SymmetryName, WorkArguments};
use clap::{Args, ValueEnum};
use gonio::goniometer::MOST_RAYS;
use gonio_formats::photometry::is_date;
use std::path::PathBuf;

/// The end of `gonio goniometer --help`.
pub(super) const GONIOMETER_EXAMPLES: &str = "The luminaire's axes are those of its prim: gamma 0 looks along -z, C0 along +x, C90 along +y. A light that \
is given the written file in the prim's place (gonio:photometry) shines as the luminaire does. --down -y is for luminaires that hang along -y.

Examples:
  gonio goniometer downlight.usda --luminaire /Downlight -o downlight.ldt -o downlight.ies --polar downlight.svg
  gonio goniometer office.usda --luminaire /Office/Lamp1 --c-step 15 --gammas 0:30:1,35:180:5 --error 0.5% -o lamp.ldt
  gonio goniometer lens.usda --luminaire /Lens --rays-file led.tm25ray@/Lens/Chip --csv colours.csv
  gonio goniometer downlight.usda --luminaire /Downlight --name 'Downlight 150' --manufacturer ACME --watts 12 -o downlight.gldf
  gonio goniometer wallwasher.usda --luminaire /Washer --screen 0.5,2,2,64,64 --screen-csv screen.csv --json";

#[derive(Args, Debug)]
pub(crate) struct GoniometerOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The luminaire: this prim and all below it; the rest of the stage is left out.
    #[arg(long, short = 'l', value_name = "PRIMPATH")]
    pub(crate) luminaire: String,
    /// Write the luminaire as EULUMDAT, LM-63-2019, TM-33 or GLDF; may be given several times. Its luminous opening is where light leaves: the mouth of an open
    /// reflector, the sides that shine; of several parts one with their luminous area. GLDF holds its meshes, its lamps' colour and their spectrum too.
    #[arg(long, short = 'o', value_name = "FILE.ldt|FILE.ies|FILE.xml|FILE.gldf")]
    pub(crate) output: Vec<PathBuf>,
    /// The frame to measure.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    /// Degrees from C plane to C plane; 360 is divided by it.
    #[arg(long = "c-step", value_name = "DEGREES", default_value_t = 15.0, value_parser = finite::<f64>)]
    pub(crate) c_step: f64,
    /// Degrees from γ to γ, from 0 to 180; 180 is divided by it. Steps that have 90 among them keep light below the horizon apart from light above it.
    #[arg(long = "g-step", value_name = "DEGREES", default_value_t = 5.0, conflicts_with = "gammas", value_parser = finite::<f64>)]
    pub(crate) g_step: f64,
    /// The γ in degrees in its place: numbers and ranges FIRST:LAST:STEP, separated by commas.
    #[arg(long, value_name = "LIST")]
    pub(crate) gammas: Option<String>,
    /// Which planes are alike: found by the errors, or forced; their intensities are averaged, and the measurement ends by the averages' error.
    #[arg(long, value_enum, default_value_t = SymmetryChoice::Auto)]
    pub(crate) symmetry: SymmetryChoice,
    /// Stop at this standard error of the peak's intensity (with the files' symmetry) and of the flux: 1%, 0.01; 0 traces all rays.
    #[arg(long, value_name = "SHARE", default_value = "1%")]
    pub(crate) error: String,
    /// Most rays: 500000, 2e9, 200M.
    #[arg(long, value_name = "COUNT", default_value = "200M", value_parser = count::<u64>(1..=MOST_RAYS))]
    pub(crate) rays: u64,
    /// Stop after this many seconds.
    #[arg(long = "time-limit", value_name = "SECONDS", value_parser = finite::<f64>)]
    pub(crate) time_limit: Option<f64>,
    /// A source that is known by its rays, in the axes of a prim or of the luminaire: TM-25, Zemax and LightTools files; may be given several times.
    #[arg(long = "rays-file", value_name = "FILE[@PRIMPATH]")]
    pub(crate) rays_file: Vec<String>,
    /// Flux in lm of the ray files together, for those that tell none or another one.
    #[arg(long = "rays-flux", value_name = "LUMENS", requires = "rays_file", value_parser = finite::<f64>)]
    pub(crate) rays_flux: Option<f64>,
    /// Where γ = 0 looks in the luminaire's own axes.
    #[arg(long, value_enum, default_value_t = AxisName::NegativeZ, allow_hyphen_values = true)]
    pub(crate) down: AxisName,
    /// Where C0 looks in the luminaire's own axes.
    #[arg(long, value_enum, default_value_t = AxisName::X, allow_hyphen_values = true)]
    pub(crate) c0: AxisName,
    /// Measure illuminance on a rectangle across the axis too: metres below the luminaire's origin, width along C0, height along C90, and
    /// columns and rows (32, 32 without them).
    #[arg(long, value_name = "DISTANCE,WIDTH,HEIGHT[,COLUMNS,ROWS]")]
    pub(crate) screen: Option<String>,
    /// Write the screen's points with illuminances and standard errors.
    #[arg(long = "screen-csv", value_name = "FILE.csv", requires = "screen")]
    pub(crate) screen_csv: Option<PathBuf>,
    /// Write every direction with its intensity, standard error, tristimulus values, chromaticity and colour temperature.
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) csv: Option<PathBuf>,
    /// Draw the polar diagram, in cd/klm.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) polar: Option<PathBuf>,
    /// The luminaire's name in the files; without it the prim's.
    #[arg(long, value_name = "TEXT")]
    pub(crate) name: Option<String>,
    /// Its maker in the files.
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub(crate) manufacturer: String,
    /// The day in the files; GLDF files without one are of 1980-01-01, so that the same luminaire makes the same file.
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = day)]
    pub(crate) date: Option<String>,
    /// Its connected power in the files.
    #[arg(long, value_name = "WATTS", value_parser = finite::<f64>)]
    pub(crate) watts: Option<f64>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}

/// A day of the calendar.
fn day(text: &str) -> Result<String, String> {
    if is_date(text) { Ok(text.to_owned()) } else { Err("expected a day as 2026-03-31".into()) }
}

/// The symmetry of the files.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SymmetryChoice {
    /// The highest that the standard errors bear out
    Auto,
    /// All planes on their own
    None,
    /// The same all around
    Rotational,
    /// About the plane C0–C180
    C0,
    /// About the plane C90–C270
    C90,
    /// About both
    Quadrants,
}

impl SymmetryChoice {
    /// The symmetry by name, unless it is to be found.
    pub(crate) fn forced(self) -> Option<SymmetryName> {
        Some(match self {
            Self::Auto => return None,
            Self::None => SymmetryName::None,
            Self::Rotational => SymmetryName::Rotational,
            Self::C0 => SymmetryName::C0,
            Self::C90 => SymmetryName::C90,
            Self::Quadrants => SymmetryName::Quadrants,
        })
    }
}

/// An axis of the luminaire.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum AxisName {
    /// Along x
    X,
    /// Along y
    Y,
    /// Along z
    Z,
    /// Against x
    #[value(name = "-x")]
    NegativeX,
    /// Against y
    #[value(name = "-y")]
    NegativeY,
    /// Against z
    #[value(name = "-z")]
    NegativeZ,
}

impl AxisName {
    /// The unit vector.
    pub(crate) fn vector(self) -> [f64; 3] {
        match self {
            Self::X => [1.0, 0.0, 0.0],
            Self::Y => [0.0, 1.0, 0.0],
            Self::Z => [0.0, 0.0, 1.0],
            Self::NegativeX => [-1.0, 0.0, 0.0],
            Self::NegativeY => [0.0, -1.0, 0.0],
            Self::NegativeZ => [0.0, 0.0, -1.0],
        }
    }
}
