//! What `gonio info` takes.

use super::StageArguments;
use super::number::finite;
use clap::Args;

#[derive(Args, Debug)]
pub(crate) struct InfoOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The frame to look at.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    /// Say what a prim has become and why.
    #[arg(long, value_name = "PRIMPATH")]
    pub(crate) explain: Option<String>,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
}
