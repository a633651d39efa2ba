//! What `gonio bench` takes.

use super::number::count;
use clap::Args;
use gonio_bench::Stage;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct BenchOptions {
    /// Only these stages, separated by commas: generation, traversal, triangle, texture, graph, bsdf, light, light-paths, media, function, tone, render.
    #[arg(long, value_name = "STAGES", value_delimiter = ',', value_parser = stage)]
    pub(crate) stage: Vec<Stage>,
    /// Seconds for each row of the table.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.5, value_parser = seconds)]
    pub(crate) seconds: f64,
    /// Worker threads of whole renders; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 1, value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) threads: u32,
    /// Render this scene bundle instead of the benchmark's own scenes.
    #[arg(long, value_name = "BUNDLE")]
    pub(crate) scene: Option<PathBuf>,
    /// The tables of the paper that gonio descends from, as Markdown beside its figures; instead of stages.
    #[arg(long, conflicts_with_all = ["stage", "scene"])]
    pub(crate) paper: bool,
    /// Only write the paper's three scenes by its renderer into this folder, as PNG files of 384 x 384 pixels.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["stage", "scene", "paper", "json", "plot"])]
    pub(crate) pictures: Option<PathBuf>,
    /// For machines: everything as JSON, once all is measured.
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a bar chart.
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) plot: Option<PathBuf>,
}

fn stage(name: &str) -> Result<Stage, String> {
    Stage::by_name(name).ok_or_else(Stage::expected)
}

fn seconds(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|s| (0.0..=86_400.0).contains(s)).ok_or_else(|| "expected a number from 0 to 86400".into())
}
