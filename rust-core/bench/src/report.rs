//! What was measured, as a table for people and as data for machines.

use super::{
    Options,
    kernel::Case,
    measure::{Slots, Variant},
    stage::Stage,
};
use gonio::threads::available_threads;
use serde::Serialize;

/// All figures of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Where it ran.
    pub machine: Machine,
    /// Seconds for each row.
    pub seconds: f64,
    /// Worker threads of whole renders.
    pub threads: u32,
    /// One row a kernel and baseline.
    pub rows: Vec<Row>,
    /// Where the time of whole renders went.
    pub renders: Vec<Breakdown>,
}

/// The machine of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// The processor's name, where the system tells.
    pub processor: Option<String>,
    /// Threads it runs at once.
    pub threads: usize,
    /// Mean number of threads that wanted to run over the minute before, where the system tells; more than 0 is company.
    pub load: Option<f64>,
    /// gonio's version.
    pub version: &'static str,
}

/// One kernel over one baseline.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The stage's name.
    pub stage: &'static str,
    /// What is done.
    pub name: String,
    /// What is counted.
    pub unit: &'static str,
    /// What the ratios are taken over: the scalar level, or the standard library's functions.
    pub baseline: &'static str,
    /// Median nanoseconds of processor time that the baseline takes for one unit.
    pub baseline_ns: f64,
    /// The same by the clock.
    pub baseline_clock_ns: f64,
    /// What the baseline computed, see [`Figure::outcome`].
    pub baseline_outcome: f64,
    /// Share of the outcome by which the levels may differ.
    pub tolerance: f64,
    /// Rounds measured.
    pub rounds: usize,
    /// The levels.
    pub levels: Vec<Figure>,
}

/// One level of a row.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// The level's name.
    pub level: &'static str,
    /// Lanes in a register.
    pub lanes: usize,
    /// Median nanoseconds of processor time a unit.
    pub ns: f64,
    /// The same by the clock.
    pub clock_ns: f64,
    /// The baseline's time over this one's, round by round.
    pub ratio: Spread,
    /// A number that the work gives, to tell that all levels do the same.
    pub outcome: f64,
}

/// A median and the quartiles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Half of the values are below.
    pub median: f64,
    /// A quarter is below.
    pub low: f64,
    /// A quarter is above.
    pub high: f64,
}

/// Where the time of a whole render went, and how full its registers were.
#[derive(Clone, Debug, Serialize)]
pub struct Breakdown {
    /// The scene.
    pub scene: String,
    /// Its triangles.
    pub triangles: u64,
    /// Its lights.
    pub lights: u64,
    /// The levels, the scalar one first.
    pub levels: Vec<LevelBreakdown>,
}

/// One level of a [`Breakdown`].
#[derive(Clone, Debug, Serialize)]
pub struct LevelBreakdown {
    /// The level's name.
    pub level: &'static str,
    /// Million rays a second of processor time, shadow rays among them.
    pub mrays: f64,
    /// Camera rays a pixel.
    pub camera_rays: f64,
    /// Shares of the workers' time by the clock, which sum to 1.
    pub time: Vec<Share>,
    /// Lanes of use, bounce by bounce.
    pub lanes: Vec<LanesAlive>,
}

/// A stage's share.
#[derive(Clone, Debug, Serialize)]
pub struct Share {
    /// The stage.
    pub stage: &'static str,
    /// 0 to 1.
    pub share: f64,
}

/// Lanes of use at a bounce.
#[derive(Clone, Debug, Serialize)]
pub struct LanesAlive {
    /// Surfaces met before.
    pub bounce: usize,
    /// Lanes shaded at that bounce over those shaded at the first.
    pub work: f64,
    /// Share of lanes of use by stage.
    pub alive: Vec<Share>,
}

impl Spread {
    /// Of values in any order; NaN without any.
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let last = values.len().saturating_sub(1) as f64;
        let at = |share: f64| {
            let place = last * share;
            let low = values.get(place as usize).copied().unwrap_or(f64::NAN);
            let high = values.get(place.ceil() as usize).copied().unwrap_or(f64::NAN);
            low + (high - low) * place.fract()
        };
        Self { median: at(0.5), low: at(0.25), high: at(0.75) }
    }
}

impl Report {
    pub(super) fn new(options: &Options) -> Self {
        Self { machine: Machine::here(), seconds: options.seconds, threads: options.workers(), rows: Vec::new(), renders: Vec::new() }
    }
}

impl Machine {
    /// The one that this runs on.
    pub(super) fn here() -> Self {
        let file = |path: &str| std::fs::read_to_string(path).ok();
        let name = |text: String| Some(text.lines().find(|line| line.starts_with("model name"))?.split_once(':')?.1.trim().to_owned());
        let load = |text: String| text.split_whitespace().next()?.parse().ok();
        Self {
            processor: file("/proc/cpuinfo").and_then(name),
            threads: available_threads(),
            load: file("/proc/loadavg").and_then(load),
            version: env!("CARGO_PKG_VERSION"),
        }
    }
}

/// The row of a case over the variant numbered `baseline`.
pub(super) fn row(stage: Stage, case: &Case, variants: &[Variant], baseline: usize, slots: &Slots) -> Row {
    let median = |rounds: &[Vec<f64>], variant: usize| {
        let seconds = rounds.iter().map(|round| round[variant]).collect();
        Spread::of(seconds).median * 1e9 / case.count.max(1) as f64
    };
    let figure = |variant: usize| Figure {
        level: variants[variant].name(),
        lanes: variants[variant].lanes(),
        ns: median(&slots.seconds, variant),
        clock_ns: median(&slots.clock, variant),
        ratio: Spread::of(slots.seconds.iter().map(|round| round[baseline] / round[variant]).collect()),
        outcome: slots.outcomes[variant].value,
    };
    Row {
        stage: stage.name(),
        name: case.name.clone(),
        unit: case.unit,
        baseline: variants[baseline].name(),
        baseline_ns: median(&slots.seconds, baseline),
        baseline_clock_ns: median(&slots.clock, baseline),
        baseline_outcome: slots.outcomes[baseline].value,
        tolerance: slots.outcomes[baseline].tolerance,
        rounds: slots.seconds.len(),
        levels: (0..variants.len())
            .filter(|variant| matches!(variants[*variant], Variant::Lanes(e) if e.lanes() > 1))
            .map(figure)
            .collect(),
    }
}
