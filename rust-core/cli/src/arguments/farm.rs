//! What `gonio render` and `gonio annual` take for work on many machines.

use super::number::count;
use clap::Args;

/// Renders spread over a Dask cluster.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Many machines")]
pub(crate) struct FarmArguments {
    /// Spread the render over the workers of a Dask cluster (pip install distributed): its scheduler's address, as in tcp://farm:8786, or the path of its scheduler file.
    #[arg(long, value_name = "ADDRESS", conflicts_with_all = ["list_cameras", "checkpoint", "samples", "part", "time_limit", "threads"])]
    pub(crate) dask: Option<String>,
    /// Parts that each frame is cut into; without it as many as give every worker four, over all frames.
    #[arg(long = "dask-parts", value_name = "COUNT", requires = "dask", value_parser = count::<u32>(1..=100_000))]
    pub(crate) dask_parts: Option<u32>,
    /// Send the scene and its images to the workers, once for each frame; without it they read the stage and its files under the same paths as this machine.
    #[arg(long = "dask-send", requires = "dask")]
    pub(crate) dask_send: bool,
}

/// A year's tracing spread over a Dask cluster.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Many machines")]
pub(crate) struct YearFarmArguments {
    /// Spread the tracing over the workers of a Dask cluster (pip install distributed): its scheduler's address, as in tcp://farm:8786, or the path of its
    /// scheduler file. The scene and its images are sent.
    #[arg(long, value_name = "ADDRESS", conflicts_with_all = ["checkpoint", "part", "merge", "max_bounces"])]
    pub(crate) dask: Option<String>,
    /// Parts that the tracing is cut into; without it four for every worker, and 16 at most.
    #[arg(long = "dask-parts", value_name = "COUNT", requires = "dask", value_parser = count::<u32>(1..=16))]
    pub(crate) dask_parts: Option<u32>,
}
