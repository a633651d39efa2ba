//! What `gonio bsdf` takes.

use super::number::{count, finite};
use super::{WorkArguments, goniometer::AxisName};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// The end of `gonio bsdf --help`.
pub(super) const BSDF_EXAMPLES: &str = "Examples:
  gonio bsdf gold.binary                        what the file holds, and what is wrong with it
  gonio bsdf gold.binary --lobes gold.svg       lobes in the plane of incidence
  gonio bsdf blind.xml -o blind.gbsdf --text    as a table to read and edit
  gonio bsdf gold.binary --fit --material gold.usda
                                                the measurement, and the nearest OpenPBR surface for renderers that take none

Samples:
  gonio bsdf --sample blind.usda --window -0.5,0 0.5,0.06 --repeat 30 -o blind.xml
                                                one slat and the gap to the next, thirty times more on every side
  gonio bsdf --sample prism.usda --front y --up z --basis half --colour --error 1% -o prism.xml --map prism.svg
  gonio bsdf --sample stage.usda --prim /Curtain -o curtain.xml --material curtain.usda

A sample is what a stage holds: meshes with materials, as they are rendered. Light falls on the window, from the front and from the back, evenly \
from each patch of directions; it is followed through the sample and counted by the patch that it leaves to. The window takes in what repeats; let \
the sample go on around it, or repeat it, so that light which goes sideways finds what it would find: what leaves beside the sample is counted \
nowhere and told as lost. Without --window all of the sample is the window, which is right for thin sheets alone. Repeated parts that touch should \
be open there: two walls at one place are two walls. The lights of the stage are left out.";

#[derive(Args, Debug)]
pub(crate) struct BsdfOptions {
    /// The measured material.
    #[arg(required_unless_present = "sample")]
    pub(crate) file: Option<PathBuf>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the lobes of light at 0°, 30°, 60° and 75° in the plane of incidence, four decades of 1/sr.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) lobes: Option<PathBuf>,
    /// Draw the same lobes over whole hemispheres, as colours.
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub(crate) map: Option<PathBuf>,
    /// Write it as .gbsdf: tables as they are, everything else evaluated on a grid of angles; how far that is from the file is told. Matrices and
    /// tensor trees as .xml, which Radiance and WINDOW read.
    #[arg(long, short = 'o', value_name = "FILE.gbsdf|FILE.xml")]
    pub(crate) output: Option<PathBuf>,
    /// The grid to write: polar angles from 0° to 90°, and azimuths of a turn; for tables, too, if given.
    #[arg(long, num_args = 2, value_names = ["THETA", "PHI"], value_parser = clap::value_parser!(u32).range(2..=720), requires = "output")]
    pub(crate) grid: Option<Vec<u32>>,
    /// Write numbers as text instead of binary.
    #[arg(long, requires = "output")]
    pub(crate) text: bool,
    /// Fit an OpenPBR surface to the front's reflection: colour, metalness, roughness, anisotropy, index, and the residual.
    #[arg(long)]
    pub(crate) fit: bool,
    /// Write a USD material: the measurement itself for gonio, by a path to this file, and the fitted surface for all other renderers.
    #[arg(long, value_name = "FILE.usda")]
    pub(crate) material: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) sample: SampleArguments,
}

/// A made-up sample that is measured.
#[derive(Args, Debug)]
#[command(next_help_heading = "Samples")]
pub(crate) struct SampleArguments {
    /// Measure a made-up sample in the place of a file: a USD stage with a prismatic sheet, a blind, a textile.
    #[arg(long, value_name = "STAGE")]
    pub(crate) sample: Option<PathBuf>,
    /// The sample is this prim and all below it.
    #[arg(long, value_name = "PRIMPATH", requires = "sample")]
    pub(crate) prim: Option<String>,
    /// The frame to measure.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, requires = "sample", value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    /// The axis of the stage that the front looks along: z of the material. In a window the front is the room's side.
    #[arg(long, value_enum, default_value_t = AxisName::Z, allow_hyphen_values = true, requires = "sample")]
    pub(crate) front: AxisName,
    /// The axis of the stage that is y of the material; x then goes to the right for who looks at the front.
    #[arg(long, value_enum, default_value_t = AxisName::Y, allow_hyphen_values = true, requires = "sample")]
    pub(crate) up: AxisName,
    /// The part that light falls on: least and greatest x and y along the material's axes from the stage's origin, in metres.
    #[arg(long, num_args = 2, value_names = ["X,Y", "X,Y"], allow_hyphen_values = true, requires = "sample")]
    pub(crate) window: Option<Vec<String>>,
    /// Repeat the sample so many times on every side, by the window's size.
    #[arg(long, value_name = "COUNT", default_value_t = 0, requires = "sample", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) repeat: u32,
    /// The patches of directions.
    #[arg(long, value_enum, default_value_t = BasisName::Full, requires = "sample")]
    pub(crate) basis: BasisName,
    /// The side that light comes from; what is missing of transmission follows from the other side.
    #[arg(long, value_enum, default_value_t = SidesName::Both, requires = "sample")]
    pub(crate) sides: SidesName,
    /// Keep colours, not luminance alone.
    #[arg(long, requires = "sample")]
    pub(crate) colour: bool,
    /// Stop each patch at this standard error of its matrix values, in the root of their mean square: 3%, 0.03; 0 traces all rays.
    #[arg(long, value_name = "SHARE", default_value = "3%", requires = "sample")]
    pub(crate) error: String,
    /// Most rays from each patch.
    #[arg(long, value_name = "COUNT", default_value_t = 1 << 20, requires = "sample", value_parser = count::<u64>(1..=u64::MAX))]
    pub(crate) rays: u64,
    /// Stop after this many seconds.
    #[arg(long = "time-limit", value_name = "SECONDS", requires = "sample", value_parser = finite::<f64>)]
    pub(crate) time_limit: Option<f64>,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q', requires = "sample")]
    pub(crate) quiet: bool,
}

/// The patches of directions.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum BasisName {
    /// 145 patches
    Full,
    /// 73 patches
    Half,
    /// 41 patches
    Quarter,
}

impl BasisName {
    /// Its name in files.
    pub(crate) fn in_files(self) -> &'static str {
        match self {
            Self::Full => "LBNL/Klems Full",
            Self::Half => "LBNL/Klems Half",
            Self::Quarter => "LBNL/Klems Quarter",
        }
    }
}

/// The sides that light comes from.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SidesName {
    /// The front and the back
    Both,
    /// The front alone
    Front,
    /// The back alone
    Back,
}

impl SidesName {
    /// Whether light comes from the front, and from the back.
    pub(crate) fn wanted(self) -> [bool; 2] {
        match self {
            Self::Both => [true, true],
            Self::Front => [true, false],
            Self::Back => [false, true],
        }
    }
}
