//! Every stage at every SIMD level: ratios to the scalar level, measured in one interleaved run.
//!
//! A stage is a file in `stages` that gives `Case`s: batches of work that run at any level. `measure` times short slots of all levels in turn,
//! so that what disturbs the machine disturbs them alike, and `report` keeps the ratios of slots that stood side by side.

mod kernel;
mod measure;
mod numbers;
mod paper;
mod plot;
mod rays;
mod report;
mod scenes;
mod stage;
mod stages;
mod text;

pub use paper::paper;
pub use plot::plot;
pub use report::{Breakdown, Figure, LanesAlive, LevelBreakdown, Machine, Report, Row, Share, Spread};
pub use stage::Stage;
pub use text::heading;

use gonio::error::Result;
use gonio::threads::available_threads;
use kernel::Case;
use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

/// What is measured, and for how long.
#[derive(Clone, Debug)]
pub struct Options {
    /// The stages, in any order; none means [`Stage::ALL`].
    pub stages: Vec<Stage>,
    /// Seconds for each row, warming up apart; 0 runs everything once.
    pub seconds: f64,
    /// Worker threads of whole renders; 0 means one a core. Other stages run on one.
    pub threads: u32,
    /// A scene bundle whose render is measured instead of the generated scenes'.
    pub scene: Option<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self { stages: Vec::new(), seconds: 0.5, threads: 1, scene: None }
    }
}

impl Options {
    /// Worker threads of whole renders.
    fn workers(&self) -> u32 {
        if self.threads == 0 { available_threads() as u32 } else { self.threads }
    }
}

/// Measures the stages asked for; `on_row` gets each row as soon as it is there.
///
/// Fails where a bundle cannot be read or a scene cannot be rendered, and with [`gonio::Error::Cancelled`] soon after `cancel` is raised.
pub fn run(options: &Options, cancel: &AtomicBool, mut on_row: impl FnMut(&Row)) -> Result<Report> {
    let mut report = Report::new(options);
    let asked = |stage: &Stage| options.stages.contains(stage);
    let stages = Stage::ALL.into_iter().filter(|stage| options.stages.is_empty() || asked(stage));
    for stage in stages.chain(Stage::PAPER.into_iter().filter(asked)) {
        for mut case in stages::cases(stage, options, cancel)? {
            let rows = measured(stage, &mut case, options.seconds, cancel)?;
            rows.iter().for_each(&mut on_row);
            report.rows.extend(rows);
            report.renders.extend(case.kernel.breakdown());
        }
    }
    Ok(report)
}

/// Writes the paper's three scenes by its renderer into a folder, PNG files of 384 × 384 pixels; their paths.
///
/// Fails where a file cannot be written, and with [`gonio::Error::Cancelled`] soon after `cancel` is raised.
pub fn paper_pictures(folder: &Path, threads: u32, cancel: &AtomicBool) -> Result<Vec<PathBuf>> {
    stages::paper::write(folder, threads, cancel)
}

/// The rows of a case: over the scalar level and, where there is such a version, over the standard library's functions.
fn measured(stage: Stage, case: &mut Case, seconds: f64, cancel: &AtomicBool) -> Result<Vec<Row>> {
    let variants = measure::variants(case.kernel.has_standard());
    let slots = measure::interleaved(case.kernel.as_mut(), &variants, seconds, cancel)?;
    let baselines = if case.kernel.has_standard() { 0..2 } else { 0..1 };
    Ok(baselines.map(|baseline| report::row(stage, case, &variants, baseline, &slots)).collect())
}
