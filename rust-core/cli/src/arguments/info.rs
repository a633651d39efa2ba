//! What `gonio info` takes.

use super::StageArguments;
use clap::Args;

#[derive(Args, Debug)]
pub(crate) struct InfoOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The frame to look at.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true)]
    pub(crate) frame: Option<f64>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
}
