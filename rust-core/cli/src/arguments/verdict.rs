//! What `gonio verdict` takes.

use clap::{Args, builder::PossibleValuesParser};
use gonio_page::Language;
use std::path::PathBuf;

/// The end of `gonio verdict --help`.
pub(super) const VERDICT_EXAMPLES: &str = "Examples:
  gonio measure office.usda --grid /Office/Desk --height 0.75 --json > desk.json
  gonio verdict office.toml desk.json
  gonio verdict office.toml desk.json eyes.json year.json -o sheet.html
  gonio verdict office.toml desk.json -o sheet.pdf --language de

A file of requirements:
  title = \"Open office, second floor\"
  [[require]]
  area = \"Desk\"               # a grid, a meter, a road, a footpath: its name, or the end of its prim's path
  quantity = \"mean\"           # minimum, maximum, uniformity, diversity, ugr, daylight_factor, cylindrical, sda_300_50, l_av, ti, ...
  at_least = 500              # or at_most
  label = \"Em, EN 12464-1\"    # free words
  maintenance_factor = 0.8

Exit status:
  0  all requirements are met
  1  one is not met or not measured; or an error, told in one line
  3  none of these, but one is within the error: more samples are needed to tell

docs/verdict.md tells all keys and what the verdicts mean.";

#[derive(Args, Debug)]
pub(crate) struct VerdictOptions {
    /// What is required: a TOML file.
    #[arg(value_name = "REQUIREMENTS.toml")]
    pub(crate) requirements: PathBuf,
    /// What was measured: JSON of 'gonio measure', 'gonio annual', 'gonio view-out', 'gonio road', 'gonio emergency', 'gonio sports' and 'gonio zones', each with --json.
    #[arg(value_name = "MEASURED.json", required = true, num_args = 1..)]
    pub(crate) measured: Vec<PathBuf>,
    /// Write the sheet: a page that holds everything itself, or a PDF by Chromium or Chrome where the machine has one.
    #[arg(long, short = 'o', value_name = "FILE.html|FILE.pdf")]
    pub(crate) output: Option<PathBuf>,
    /// The sheet's language; the table and --json stay in English.
    #[arg(long, default_value = "en", value_parser = PossibleValuesParser::new(Language::CODES.map(|(code, _)| code)))]
    pub(crate) language: String,
    /// The sheet's date; without it today's.
    #[arg(long, value_name = "TEXT")]
    pub(crate) date: Option<String>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
}
