//! What `gonio render` takes for checkpoints, and `gonio merge` for joining them.

use super::OutputArguments;
use super::number::finite;
use clap::Args;
use std::path::PathBuf;

/// Renders that are interrupted, and parts of renders.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Checkpoints")]
pub(crate) struct CheckpointArguments {
    /// Keep the sums so far in this file, from time to time and at the end; '####' or '$F4' stand for the frame number.
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) keeping: KeepingArguments,
    /// Render a part of the samples, from the first to the one before the last number; 'gonio merge' joins the checkpoints of the parts.
    #[arg(long, value_name = "FIRST:END")]
    pub(crate) samples: Option<String>,
    /// Render one of so many parts with about equal work, as in 3/8; 'gonio merge' joins their checkpoints.
    #[arg(long, value_name = "NUMBER/COUNT", conflicts_with = "samples")]
    pub(crate) part: Option<String>,
}

/// When checkpoints are written and read.
#[derive(Args, Clone, Debug)]
pub(crate) struct KeepingArguments {
    /// Seconds between checkpoints; where writing one takes long, at least twenty times as long as that.
    #[arg(long = "checkpoint-every", value_name = "SECONDS", default_value_t = 60.0, requires = "checkpoint", value_parser = finite::<f64>)]
    pub(crate) checkpoint_every: f64,
    /// Go on with the checkpoint where there is one, to the same bits as without the interruption.
    #[arg(long, requires = "checkpoint")]
    pub(crate) resume: bool,
}

/// Tracings of a year that are interrupted, and parts of them.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Checkpoints")]
pub(crate) struct RoundArguments {
    /// Keep finished rounds in this file, from time to time and at the end. With --resume they are there again for another schedule or other figures.
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) keeping: KeepingArguments,
    /// Trace one of up to 16 parts into the checkpoint, as in 3/4, and calculate nothing; --merge joins them.
    #[arg(long, value_name = "NUMBER/COUNT", requires = "checkpoint")]
    pub(crate) part: Option<String>,
    /// Take the rounds of these checkpoints, in any order, and trace nothing. The other words are those of the parts.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["checkpoint", "part"])]
    pub(crate) merge: Vec<PathBuf>,
}

#[derive(Args, Debug)]
pub(crate) struct MergeArguments {
    /// The checkpoints of the parts, in any order.
    #[arg(required = true)]
    pub(crate) parts: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) files: OutputArguments,
    /// Write nothing but errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}
