//! What `gonio dim` takes.

use super::measure::MeasuringArguments;
use super::number::finite;
use clap::Args;
use std::path::PathBuf;

/// The end of `gonio dim --help`.
pub(super) const DIM_EXAMPLES: &str = "Targets, NAME being a prim, the last part of its path, or a point as --at has it:
  NAME.mean>=500      the grid's mean, or a meter's reading, is 500 lx at least; NAME>=500 is the same
  NAME.mean<=800      at most
  NAME.mean=500+-25   between 475 and 525
  NAME.min>=200       no point gets less
  NAME.max<=1000      no point gets more
  NAME.uo>=0.6        the least point has 0.6 of the mean at least
  NAME.cct=4000+-100  the light there has a colour temperature of 3900 to 4100 K; >= and <= do as well
Glare, where the stage's own meters and grids ask for ugr, is checked once the levels are known: NAME.max<=19.

Examples:
  gonio dim office.usda --grid /Office/Floor --height 0.75 --target 'Floor.mean>=500' --target 'Floor.uo>=0.6'
  gonio dim office.usda --grid /Office/Floor --target 'Floor.mean>=500' --watts Window=120 --watts Wall=160 --min-level 0.1 -o dimmed.usda
  gonio dim office.usda --at 2,3,0.75 --target '2,3,0.75=500+-25' --fixed Board=1 --near equal

docs/dimming.md tells what is solved and what the verdicts mean.";

#[derive(Args, Debug)]
pub(crate) struct DimOptions {
    #[command(flatten)]
    pub(crate) measuring: MeasuringArguments,
    /// What is to be reached, as 'NAME.mean>=500'; several are to be reached together.
    #[arg(long, short = 't', value_name = "TARGET", required = true)]
    pub(crate) target: Vec<String>,
    /// The power of a whole group at level 1; without it as its luminaires' files state, else by its flux, at 100 lm/W.
    #[arg(long, value_name = "GROUP=W")]
    pub(crate) watts: Vec<String>,
    /// Keep a group at this level, from 0 to 1.
    #[arg(long, value_name = "GROUP=LEVEL")]
    pub(crate) fixed: Vec<String>,
    /// The least level of all groups that are not fixed; none is switched off then.
    #[arg(long = "min-level", value_name = "LEVEL", default_value_t = 0.0, value_parser = level)]
    pub(crate) min_level: f64,
    /// Rather than the least power, levels that stray least from this one, or 'equal' for levels as alike as may be.
    #[arg(long, value_name = "GROUP=LEVEL|equal")]
    pub(crate) near: Vec<String>,
    /// Keep so many standard errors away from each limit; with 2 a target that can be met is met beyond doubt.
    #[arg(long, value_name = "COUNT", default_value_t = 0.0, allow_hyphen_values = true, value_parser = errors)]
    pub(crate) errors: f64,
    /// Write a layer over the stage that dims its lights so.
    #[arg(long, short = 'o', value_name = "FILE.usda")]
    pub(crate) output: Option<PathBuf>,
}

/// Reads a level.
fn level(text: &str) -> Result<f64, String> {
    finite::<f64>(text).ok().filter(|level| (0.0..=1.0).contains(level)).ok_or_else(|| format!("'{text}' was found, expected 0 to 1"))
}

/// Reads a number of standard errors.
fn errors(text: &str) -> Result<f64, String> {
    let count = finite::<f64>(text).ok().filter(|count| *count >= 0.0);
    count.ok_or_else(|| format!("'{text}' was found, expected a number of zero or more"))
}
